// The plots as Vega-Lite's specifications, and the rows that they are drawn from.
import { placeLabels, spreadLabels, widthOf } from './labels.js';
import { isDrawn, rowOf } from './run.js';

/// Rows of "accuracy against time": of each method drawn on a chip, and whether it is on the frontier, where nothing is
/// both as fast and as accurate.
/// @param scenes  over which they are put together
export function accuracyRows(shown, profile, scenes) {
    const rows = shown.rows.map((row) => shown.entry(row, profile)).filter((entry) => entry && isDrawn(entry.verdict) && !Number.isNaN(entry.ratio))
        .map((entry) => ({
            profile, scenes: scenes.join('; '), method: entry.row, verdict: entry.verdict, time_ratio: entry.ratio, wrong_pixels: entry.wrong,
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
/// @param storeOf  where a method's count lives, by the method's id
export function pathRows(cells, keep, profile, scene, storeOf) {
    const rows = [];
    for (let cell = 0; cell < cells.count; ++cell) {
        if (cells.get('profile', cell) !== profile || cells.get('scene', cell) !== scene || !keep(cell)) continue;
        const ratio = cells.ratio(cell);
        if (Number.isNaN(ratio) || !isDrawn(cells.get('verdict', cell))) continue;
        rows.push({
            profile, scene, method: rowOf(cells, cell), store: storeOf(cells.get('method', cell)), frame: cells.get('frame', cell), time_ratio: ratio, size: cells.size(cell),
            cpu_ms: cells.get('cpu_ms', cell), unshadowed_ms: cells.get('unshadowed_ms', cell),
        });
    }
    return rows.sort((a, b) => a.frame - b.frame);
}

/// Rows of "passes per method" on one chip: the fewest and the most over scenes and frames.
export function passRows(shown, profile, scenes) {
    return shown.rows.map((row) => shown.entry(row, profile)).filter((entry) => entry && isDrawn(entry.verdict))
        .flatMap((entry) => Object.entries(entry.passes).map(([kind, [fewest, most]]) => ({ profile, scenes: scenes.join('; '), method: entry.row, kind, fewest, most })));
}

const timeAxis = 'time ratio';

/// Where the count may live, in the order of their colours: a store has one colour, whatever is left out.
const stores = ['stencil', 'alpha', 'screen', 'counter', 'depth-map', 'none', 'by frame'];
const colourOfStore = { domain: stores };

// What is marked stands out: the others fade.
const isLit = 'length(lit) == 0 || indexof(lit, datum.method) >= 0';
const params = [{ name: 'lit', value: [] }];
const fading = (full = 1) => ({ condition: { test: isLit, value: full }, value: 0.13 });

/// Names that are placed once the scales are known, and the lines that lead to those farther off.
function labelLayers(colour) {
    const data = { name: 'labels', values: [] };
    const at = (field) => ({ field, type: 'quantitative', scale: null });
    return [
        { data, mark: { type: 'rule', strokeWidth: 0.8 }, encoding: { x: at('x'), y: at('y'), x2: { field: 'near' }, y2: { field: 'middle' }, opacity: fading(0.6) } },
        { data, mark: { type: 'text', align: 'left', baseline: 'middle' }, encoding: { x: at('left'), y: at('middle'), text: { field: 'method' }, opacity: fading(), ...colour } },
    ];
}

/// Where a leading line meets a name: its nearer end.
const withNear = (label, wide) => ({ ...label, near: label.x <= label.left ? label.left : Math.min(label.x, label.left + wide) });

/// @param colours  of exact, edge, wrong
export function accuracySpec(rows, colours) {
    const x = { field: 'time_ratio', type: 'quantitative', title: timeAxis, scale: { type: 'log', nice: false, padding: 24 }, axis: { format: '.3~r', tickCount: 6 } };
    const y = { field: 'wrong_percent', type: 'quantitative', title: 'wrong pixels, percent', scale: { type: 'symlog', constant: 0.01, nice: false, padding: 16 }, axis: { values: [0, 0.01, 0.1, 1, 10, 100], format: '~r' } };
    const tooltip = ['method', 'verdict', 'time_ratio', 'wrong_pixels', 'wrong_percent'].map((field) => ({ field }));
    const scale = { domain: ['exact', 'edge', 'wrong'] };
    return {
        description: 'Wrong pixels against time, one point a method; the frontier is joined by a line.',
        params,
        data: { values: rows },
        height: Math.max(320, 14 * rows.length),
        layer: [
            { data: { values: rows.filter((row) => row.frontier) }, mark: { type: 'line', interpolate: 'step-after', strokeDash: [5, 3], opacity: 0.8 }, encoding: { x, y } },
            {
                mark: { type: 'point', size: 80, strokeWidth: 1.8, filled: false },
                encoding: {
                    x, y, tooltip, opacity: fading(),
                    shape: { field: 'verdict', type: 'nominal', title: 'verdict', scale: { ...scale, range: ['circle', 'diamond', 'square'] } },
                    color: { field: 'verdict', type: 'nominal', scale: { ...scale, range: colours } },
                },
            },
            ...labelLayers({}),
        ],
    };
}

/// The names of accuracySpec()'s points.
export function accuracyLabels(rows, { x, y, width, height }) {
    // Those of the frontier first: they get the nearest places.
    const points = [...rows].sort((a, b) => b.frontier - a.frontier).map((row) => ({ name: row.method, x: x(row.time_ratio), y: y(row.wrong_percent) }));
    return placeLabels(points, { width, height }, stepsOf(points.slice(0, rows.filter((row) => row.frontier).length))).map(({ name, ...label }) => ({ method: name, ...withNear(label, widthOf(name)) }));
}

/// The frontier as upright and level pieces, a little wider than they are drawn.
const stepsOf = (points) => points.slice(1).flatMap((to, i) => [
    { left: points[i].x, right: to.x, top: points[i].y - 2, bottom: points[i].y + 2 },
    { left: to.x - 2, right: to.x + 2, top: Math.min(points[i].y, to.y), bottom: Math.max(points[i].y, to.y) },
]);

const dashes = [[1, 0], [6, 3], [2, 2], [8, 3, 2, 3]];

export function pathSpec(rows, colours, width) {
    const frames = [...new Set(rows.map((row) => row.frame))], methods = [...new Set(rows.map((row) => row.method))];
    const seen = new Set(rows.map((row) => row.store));
    const [first, last] = [frames[0], frames.at(-1)];
    // Room for the names at the right.
    const share = Math.min(0.68, (30 + Math.max(...methods.map(widthOf))) / Math.max(1, width - 60));
    const turns = methods.map((method) => {
        const { store } = rows.find((row) => row.method === method);
        return dashes[methods.filter((other) => rows.find((row) => row.method === other).store === store).indexOf(method) % dashes.length];
    });
    const x = {
        field: 'frame', type: 'quantitative', title: 'frame', axis: { values: frames, labelOverlap: true, grid: false, format: 'd' },
        scale: { zero: false, nice: false, domain: [first - 0.3, last + 0.3 + ((last - first + 0.6) * share) / (1 - share)] },
    };
    const y = { field: 'time_ratio', type: 'quantitative', title: timeAxis, scale: { type: 'log', nice: false, padding: 10 }, axis: { format: '.3~r', tickCount: 6 } };
    const color = { field: 'store', type: 'nominal', title: 'the count lives in', scale: colourOfStore, legend: { values: stores.filter((store) => seen.has(store)), orient: 'bottom', columns: Math.max(2, Math.floor((width - 60) / 105)), symbolType: 'stroke', symbolSize: 300 } };
    const detail = { field: 'method', type: 'nominal' };
    const tooltip = ['method', 'store', 'frame', 'time_ratio'].map((field) => ({ field }));
    return {
        description: 'Time by that without shadows along the camera path, one line a method, its name at its end; a colour for each store of the count.',
        params,
        data: { values: rows },
        height: Math.max(320, 15 * methods.length),
        layer: [
            {
                mark: { type: 'line' },
                encoding: {
                    x, y, color, detail, opacity: fading(0.9), strokeWidth: { condition: { test: `length(lit) > 0 && (${isLit})`, value: 3 }, value: 1.5 },
                    strokeDash: { field: 'method', type: 'nominal', legend: null, scale: { domain: methods, range: turns } },
                },
            },
            { mark: { type: 'point', filled: true, size: 26 }, encoding: { x, y, color, detail, tooltip, opacity: fading() } },
            ...labelLayers({ color }),
        ],
    };
}

/// The names of pathSpec()'s lines, at their ends.
export function pathLabels(rows, { x, y, height }) {
    const ends = new Map();
    for (const row of rows) ends.set(row.method, row);
    const edge = Math.max(...[...ends.values()].map((row) => x(row.frame)));
    return spreadLabels([...ends.values()].map((row) => ({ name: row.method, store: row.store, x: x(row.frame), y: y(row.time_ratio) })), height)
        .map(({ name, ...label }) => ({ method: name, ...withNear({ ...label, left: edge + 22 }, 0) }));
}

export function passSpec(rows) {
    const kinds = ['scene', 'volume', 'rectangle', 'copy'];
    return {
        description: 'The most passes of each method over scenes and frames, by what they draw.',
        params,
        data: { values: rows },
        height: { step: 17 },
        mark: { type: 'bar', stroke: null },
        encoding: {
            y: { field: 'method', type: 'nominal', title: null, sort: null, axis: { labelLimit: 200 } },
            x: { field: 'most', type: 'quantitative', title: 'passes', axis: { tickMinStep: 1 } },
            color: { field: 'kind', type: 'nominal', title: null, scale: { domain: kinds } },
            order: { field: 'order', type: 'quantitative' },
            opacity: fading(),
            tooltip: ['method', 'kind', 'fewest', 'most'].map((field) => ({ field })),
        },
        transform: [{ calculate: `indexof(${JSON.stringify(kinds)}, datum.kind)`, as: 'order' }],
    };
}
