// The plots as Vega-Lite's specifications, and the rows that they are drawn from.
import { rowOf } from './run.js';

/// Rows of "accuracy against time": of each method drawn on a chip, and whether it is on the frontier, where nothing is
/// both as fast and as accurate.
export function accuracyRows(shown, profile) {
    const rows = shown.rows.map((row) => shown.entry(row, profile)).filter((entry) => entry && entry.rank < 3 && !Number.isNaN(entry.ratio))
        .map((entry) => ({
            method: entry.row, verdict: entry.verdict, time_ratio: entry.ratio, wrong_pixels: entry.wrong,
            wrong_percent: entry.pixels ? (100 * entry.wrong) / entry.pixels : 0, frontier: false,
        }));
    rows.sort((a, b) => a.time_ratio - b.time_ratio || a.wrong_percent - b.wrong_percent);
    let best = Infinity;
    for (const row of rows) {
        if (row.wrong_percent >= best) continue;
        row.frontier = true;
        best = row.wrong_percent;
    }
    return rows;
}

/// Rows of "time along the camera path" of one chip and scene.
export function pathRows(cells, keep, profile, scene) {
    const rows = [];
    for (let cell = 0; cell < cells.count; ++cell) {
        if (cells.get('profile', cell) !== profile || cells.get('scene', cell) !== scene || !keep(cell)) continue;
        const ratio = cells.ratio(cell);
        if (Number.isNaN(ratio) || ['refused', 'failed'].includes(cells.get('verdict', cell))) continue;
        rows.push({
            method: rowOf(cells, cell), frame: cells.get('frame', cell), time_ratio: ratio, size: cells.size(cell),
            cpu_ms: cells.get('cpu_ms', cell), unshadowed_ms: cells.get('unshadowed_ms', cell),
        });
    }
    return rows.sort((a, b) => a.frame - b.frame);
}

/// Rows of "passes per method" on one chip.
export function passRows(shown, profile) {
    return shown.rows.map((row) => shown.entry(row, profile)).filter((entry) => entry && entry.rank < 3)
        .flatMap((entry) => Object.entries(entry.passes).map(([kind, passes]) => ({ method: entry.row, kind, passes })));
}

const timeAxis = 'time ratio';

/// @param colours  of exact, edge, wrong
export function accuracySpec(rows, colours) {
    const x = { field: 'time_ratio', type: 'quantitative', title: timeAxis, scale: { type: 'log', nice: false, padding: 24 }, axis: { format: '~r', tickCount: 6 } };
    const y = { field: 'wrong_percent', type: 'quantitative', title: 'wrong pixels, percent', scale: { type: 'symlog', constant: 0.01, nice: false, padding: 16 }, axis: { values: [0, 0.01, 0.1, 1, 10, 100], format: '~r' } };
    const frontier = { values: rows.filter((row) => row.frontier) };
    const tooltip = ['method', 'verdict', 'time_ratio', 'wrong_pixels', 'wrong_percent'].map((field) => ({ field }));
    return {
        description: 'Wrong pixels against time, one point a method; the frontier is joined by a line.',
        data: { values: rows },
        height: 320,
        layer: [
            { data: frontier, mark: { type: 'line', interpolate: 'step-after', strokeDash: [5, 3], opacity: 0.8 }, encoding: { x, y } },
            {
                mark: { type: 'point', size: 80, strokeWidth: 1.8, filled: false },
                encoding: {
                    x, y, tooltip,
                    shape: { field: 'verdict', type: 'nominal', title: 'verdict', scale: { domain: ['exact', 'edge', 'wrong'], range: ['circle', 'diamond', 'square'] } },
                    color: { field: 'verdict', type: 'nominal', scale: { domain: ['exact', 'edge', 'wrong'], range: colours } },
                },
            },
            { data: frontier, mark: { type: 'text', align: 'left', dx: 7, dy: -8 }, encoding: { x, y, text: { field: 'method' } } },
        ],
    };
}

export function pathSpec(rows) {
    const methods = [...new Set(rows.map((row) => row.method))];
    const dashes = [[1, 0], [6, 3], [2, 2]];
    const legend = { title: null, symbolType: 'stroke', symbolSize: 300 };
    return {
        description: 'Time by that without shadows along the camera path, one line a method.',
        data: { values: rows },
        height: Math.max(320, 17 * methods.length),
        mark: { type: 'line', strokeWidth: 1.6 },
        encoding: {
            x: { field: 'frame', type: 'quantitative', title: 'frame', scale: { zero: false, nice: false, padding: 8 }, axis: { tickMinStep: 1, grid: false } },
            y: { field: 'time_ratio', type: 'quantitative', title: timeAxis, scale: { type: 'log', nice: false, padding: 8 }, axis: { format: '~r', tickCount: 6 } },
            // Eight colours come round: the dashes tell their turns apart.
            color: { field: 'method', type: 'nominal', scale: { domain: methods }, legend },
            strokeDash: { field: 'method', type: 'nominal', scale: { domain: methods, range: methods.map((_, i) => dashes[Math.floor(i / 8) % 3]) }, legend },
            tooltip: ['method', 'frame', 'time_ratio'].map((field) => ({ field })),
        },
    };
}

export function passSpec(rows) {
    const kinds = ['scene', 'volume', 'rectangle', 'copy'];
    return {
        description: 'Passes of each method, by what they draw.',
        data: { values: rows },
        height: { step: 17 },
        mark: { type: 'bar', stroke: null },
        encoding: {
            y: { field: 'method', type: 'nominal', title: null, sort: null, axis: { labelLimit: 200 } },
            x: { field: 'passes', type: 'quantitative', title: 'passes', axis: { tickMinStep: 1 } },
            color: { field: 'kind', type: 'nominal', title: null, scale: { domain: kinds } },
            order: { field: 'order', type: 'quantitative' },
            tooltip: ['method', 'kind', 'passes'].map((field) => ({ field })),
        },
        transform: [{ calculate: `indexof(${JSON.stringify(kinds)}, datum.kind)`, as: 'order' }],
    };
}
