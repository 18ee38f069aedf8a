// A run: its cells as columns, and the cells of one method on one chip put together.

/// Verdicts from the best to the worst, as the terminal's table has them.
export const verdicts = ['exact', 'edge', 'wrong', 'refused', 'failed'];

/// A column of values, one per cell.
class Column {
    constructor({ dictionary, values }) {
        this.dictionary = dictionary ?? null;
        this.values = values;
    }
    get(cell) {
        return this.dictionary ? this.dictionary[this.values[cell]] : this.values[cell];
    }
}

/// The columns of a run's cells.
export class Cells {
    constructor({ count, columns }) {
        this.count = count;
        this.columns = new Map(Object.entries(columns).map(([name, column]) => [name, new Column(column)]));
        this.byId = null;
    }
    has(name) {
        return this.columns.has(name);
    }
    /// A cell's value; undefined where the run has no such column, null where the cell has none.
    get(name, cell) {
        return this.columns.get(name)?.get(cell);
    }
    number(name, cell) {
        return this.get(name, cell) ?? 0;
    }
    size(cell) {
        return `${this.get('width', cell)}x${this.get('height', cell)}`;
    }
    /// As the command line names it; the second of a name (of another shade, say) ends in "~2".
    id(cell) {
        if (!this.ids) this.nameAll();
        return this.ids[cell];
    }
    /// All cells of a name, those with "~2" too.
    named(plain) {
        const all = [];
        for (let id = plain, again = 2; this.find(id) >= 0; ++again) all.push(this.find(id)), id = `${plain}~${again}`;
        return all;
    }
    /// @return  the cell, or -1
    find(id) {
        if (!this.ids) this.nameAll();
        return this.byId.get(id) ?? -1;
    }
    nameAll() {
        this.ids = [];
        this.byId = new Map();
        for (let cell = 0; cell < this.count; ++cell) {
            const plain = ['profile', 'method', 'scene'].map((name) => this.get(name, cell)).join('/') +
                `/${this.size(cell)}/${this.get('frame', cell)}`;
            let id = plain;
            for (let again = 2; this.byId.has(id); ++again) id = `${plain}~${again}`;
            this.ids.push(id);
            this.byId.set(id, cell);
        }
    }
    /// All distinct values in the order in which they come first.
    distinct(name) {
        const column = this.columns.get(name);
        if (!column) return [];
        const seen = [...new Set(column.values)];
        return column.dictionary ? seen.map((code) => column.dictionary[code]) : seen;
    }
    wrong(cell) {
        return this.number('wrong.edge', cell) + this.number('wrong.interior', cell);
    }
    /// The host's time of the frame by its time of the same frame without shadows; NaN where nothing was drawn.
    ratio(cell) {
        const shadowed = this.number('cpu_ms', cell), plain = this.number('unshadowed_ms', cell);
        return shadowed > 0 && plain > 0 ? shadowed / plain : NaN;
    }
}

/// The middle value; of an even number the mean of the two; NaN of none.
export function median(numbers) {
    const sorted = numbers.filter((n) => !Number.isNaN(n)).sort((a, b) => a - b);
    const half = sorted.length >> 1;
    if (sorted.length === 0) return NaN;
    return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

/// What a run may have several of besides chips and methods; it is no part of a method's name.
const besides = ['fidelity', 'dither', 'device'];

/// The row of a cell: its method, its shade where it isn't the usual one, and what the run has several of.
export function rowOf(cells, cell) {
    cells.several ??= besides.filter((name) => cells.distinct(name).length > 1);
    const shade = cells.get('shade', cell);
    const words = [cells.get('method', cell), shade === 'attenuated' ? '' : shade, ...cells.several.map((name) => cells.get(name, cell))];
    return words.filter(Boolean).join(' ');
}

/// Of every cell the number of its row and of its chip, made once: a run has some ten thousand cells.
function numbered(cells) {
    if (cells.numbered) return cells.numbered;
    const number = (nameOf) => {
        const names = [], numbers = new Map(), of = new Int32Array(cells.count);
        for (let cell = 0; cell < cells.count; ++cell) {
            const name = nameOf(cell);
            if (!numbers.has(name)) numbers.set(name, names.push(name) - 1);
            of[cell] = numbers.get(name);
        }
        return { names, of };
    };
    return (cells.numbered = { rows: number((cell) => rowOf(cells, cell)), profiles: number((cell) => cells.get('profile', cell)) });
}

/// Puts together the cells for which `keep(cell)` holds: of each row and chip the worst verdict and the sum of wrong
/// pixels over scenes and frames, the fewest and the most passes, the median time ratio.
/// @param changed  cells that another run has otherwise
/// @return         {rows, profiles, all(): their entries}
export function table(cells, keep, changed = new Set()) {
    const { rows, profiles } = numbered(cells);
    const entries = new Array(rows.names.length * profiles.names.length).fill(null);
    for (let cell = 0; cell < cells.count; ++cell) {
        if (!keep(cell)) continue;
        const at = rows.of[cell] * profiles.names.length + profiles.of[cell];
        entries[at] ??= newEntry(rows.names[rows.of[cell]], profiles.names[profiles.of[cell]], cells.get('method', cell));
        addCell(entries[at], cells, cell, changed.has(cell));
    }
    const there = entries.filter(Boolean);
    for (const entry of there) entry.ratio = median(entry.ratios);
    return { rows: rows.names, profiles: profiles.names, all: () => there };
}

const passKinds = ['scene', 'volume', 'rectangle', 'copy'];

function newEntry(row, profile, method) {
    return {
        row, profile, method, rank: 0, verdict: 'exact', chosen: false, edge: 0, interior: 0, wrong: 0, pixels: 0, tied: 0,
        passes: Object.fromEntries(passKinds.map((kind) => [kind, null])), ratios: [], ratio: NaN, missing: new Map(), causes: new Map(),
        error: '', cells: [], drawn: 0, changed: 0, worst: -1, weight: [],
    };
}

/// Whether there is anything measured: nothing is of a cell that was refused or failed.
export const isDrawn = (verdict) => !['refused', 'failed'].includes(verdict);

function addCell(entry, cells, cell, isChanged) {
    const rank = verdicts.indexOf(cells.get('verdict', cell));
    const wrong = cells.wrong(cell);
    // The cell that opens first: one that changed; of these the worst; of these one with pictures; of these the one with
    // most wrong pixels.
    const weight = [isChanged ? 1 : 0, rank, (cells.get('drawing', cell) ?? -1) >= 0 ? 1 : 0, wrong];
    const first = weight.findIndex((value, i) => value !== entry.weight[i]);
    if (entry.worst < 0 || (first >= 0 && weight[first] > entry.weight[first])) entry.worst = cell, entry.weight = weight;
    entry.rank = Math.max(entry.rank, rank);
    entry.verdict = verdicts[entry.rank];
    entry.chosen ||= Boolean(cells.get('chosen', cell));
    entry.edge += cells.number('wrong.edge', cell);
    entry.interior += cells.number('wrong.interior', cell);
    entry.wrong += wrong;
    entry.pixels += cells.number('pixels', cell);
    entry.tied += cells.number('tied.truth', cell) + cells.number('tied.count', cell);
    if (isDrawn(verdicts[rank])) {
        ++entry.drawn;
        entry.ratios.push(cells.ratio(cell));
        for (const kind of passKinds) widen(entry.passes, kind, cells.number(`passes.${kind}`, cell));
    }
    if (isChanged) ++entry.changed;
    for (const { what, source } of cells.get('missing', cell) ?? []) entry.missing.set(what, source);
    for (const [cause, pixels] of Object.entries(cells.get('causes', cell) ?? {}))
        entry.causes.set(cause, (entry.causes.get(cause) ?? 0) + pixels);
    entry.error = cells.get('error', cell) || entry.error;
    entry.cells.push(cell);
}

function widen(ranges, kind, value) {
    const range = (ranges[kind] ??= [value, value]);
    if (value < range[0]) range[0] = value;
    if (value > range[1]) range[1] = value;
}

/// The fewest and the most as "1–13", or as one number where they are the same; empty where nothing was drawn.
export const rangeText = (range, to = '\u2013') => (!range ? '' : range[0] === range[1] ? String(range[0]) : `${range[0]}${to}${range[1]}`);

/// "×2.7"; empty where nothing was drawn.
export const ratioText = (ratio) => (Number.isNaN(ratio) ? '' : `\u00d7${ratio < 10 ? ratio.toFixed(1) : Math.round(ratio)}`);

/// Of the cells `there` (all of them have what `cell` has not) the same scene's nearest frame; else another scene's.
/// @return  {mate: -1 where there is none, isSame: whether it is of the same scene}
export function nearestMate(cells, cell, there) {
    const frame = cells.get('frame', cell);
    const same = there.filter((mate) => cells.get('scene', mate) === cells.get('scene', cell));
    const distance = (mate) => Math.abs(cells.get('frame', mate) - frame) + (cells.size(mate) === cells.size(cell) ? 0 : 0.5);
    const nearest = (list) => list.reduce((best, mate) => (best < 0 || distance(mate) < distance(best) ? mate : best), -1);
    return { mate: nearest(same.length ? same : there), isSame: same.length > 0 };
}
