// The answer: methods by chips. A grid with one stop of the tabulator, in which the arrow keys walk.
import { counted, h, plural, symbolOf } from './dom.js';
import { splitSort } from './address.js';
import { isDrawn, rangeText, ratioText } from './run.js';

/// What a row or column can be sorted by; less is better, and comes first.
const figures = {
    verdict: (e) => [e.rank, e.wrong, most(e.passes.scene) + most(e.passes.rectangle)],
    wrong: (e) => [isDrawn(e.verdict) ? e.wrong : Infinity, e.rank],
    passes: (e) => [isDrawn(e.verdict) ? most(e.passes.scene) : Infinity, most(e.passes.rectangle), e.rank],
    ratio: (e) => [Number.isNaN(e.ratio) ? Infinity : e.ratio, e.rank],
};
const most = (range) => range?.[1] ?? Infinity;
export const figureNames = { verdict: 'verdict', wrong: 'wrong pixels', passes: 'passes', ratio: 'time ratio' };

function compareLists(a, b) {
    for (let i = 0; i < a.length; ++i) if (a[i] !== b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

/// The ids of the lines (rows of the shown table), in the state's order: "tnt:down" sorts by the column tnt, worst first.
export function sortedLines(lines, entryAt, state) {
    const { column: by, way } = splitSort(state.sort);
    if (!way) return lines;
    const turn = way === 'down' ? -1 : 1;
    const keyOf = (line) => {
        const entry = entryAt(line, by);
        return entry ? figures[state.figure](entry) : null;
    };
    const keyed = lines.map((line, at) => ({ line, at, key: by ? keyOf(line) : [line] }));
    keyed.sort((a, b) => {
        // What isn't there comes last, whichever way.
        if (!a.key || !b.key) return a.key ? -1 : b.key ? 1 : a.at - b.at;
        return turn * compareLists(a.key, b.key) || a.at - b.at;
    });
    return keyed.map((k) => k.line);
}

/// What the next press on a column's heading sorts by: best first, worst first, as it was.
function nextSort(sort, column) {
    const { column: by, way } = splitSort(sort);
    if (by !== column || !way) return `${column}:up`;
    return way === 'up' ? `${column}:down` : '';
}

/// The sentence that a reader of the screen says of an entry.
export function sentenceOf(entry) {
    const head = `${entry.row} on ${entry.profile}: ${entry.verdict}`;
    const changed = entry.changed ? `, ${plural(entry.changed, 'cell')} changed` : '';
    if (entry.verdict === 'refused') return `${head} for want of ${[...entry.missing.keys()].join('; ')}${changed}`;
    if (entry.verdict === 'failed') return `${head}: ${entry.error}${changed}`;
    const ratio = ratioText(entry.ratio);
    return `${head}, ${plural(entry.wrong, 'wrong pixel')}, ${passWords(entry.passes.scene, 'scene pass', 'scene passes')}, ` +
        passWords(entry.passes.rectangle, 'rectangle', 'rectangles') + (ratio ? `, ${ratio.slice(1)} times the frame without shadows` : '') +
        (entry.chosen ? ', the path that gnomon takes on this chip' : '') + changed;
}

/// "1 to 13 scene passes"
const passWords = (range, one, many) => `${rangeText(range, ' to ')} ${most(range) === 1 ? one : many}`;

function entryButton(entry, open) {
    const { verdict } = entry;
    const sentence = sentenceOf(entry);
    const first = [symbolOf(verdict), h('b', {}, verdict), entry.changed ? h('span.delta', {}, '\u0394') : null];
    let second = [];
    if (verdict === 'refused') {
        const [what] = entry.missing.keys();
        second = [h('span.what', {}, what ?? ''), entry.missing.size > 1 ? h('span', {}, `+${entry.missing.size - 1}`) : null];
    } else if (verdict !== 'failed') {
        first.push(h('span.passes', {}, `${rangeText(entry.passes.scene)}/${rangeText(entry.passes.rectangle)}`, entry.chosen ? h('b.chosen', {}, '*') : null));
        second = [h('span', {}, entry.wrong ? [counted(entry.wrong), h('span.unit', {}, ' px')] : null), h('span', {}, ratioText(entry.ratio))];
    }
    return h(`button.entry.${verdict}`, {
        type: 'button', tabIndex: -1, 'aria-label': sentence, title: sentence, 'data-row': entry.row, 'data-profile': entry.profile, onclick: () => open(entry),
    }, h('span.line', {}, first), h('span.line.figures', {}, second));
}

/// @param shown    of table(), with only the rows and profiles that are left
/// @param actions  {change(what is new of the state), open(entry)}
/// @param about    {profile(id), method(row)}: what stands below a name
export function answerTable(shown, state, actions, about) {
    const turned = state.across === 'methods';
    const [columns, unsorted] = turned ? [shown.rows, shown.profiles] : [shown.profiles, shown.rows];
    const entryAt = (line, column) => (turned ? shown.entry(column, line) : shown.entry(line, column));
    const lines = sortedLines(unsorted, entryAt, state);
    const { column: by, way } = splitSort(state.sort);
    const heading = (column, label, below) => {
        const sorted = way && by === column ? { up: 'ascending', down: 'descending' }[way] : 'none';
        return h('th', { scope: 'col', role: 'columnheader', 'aria-sort': sorted },
            h('button.head', { type: 'button', tabIndex: -1, 'data-column': column, onclick: () => actions.change({ sort: nextSort(state.sort, column) }) },
                h('span.name', {}, label), below ? h('span.below', {}, below) : null,
                h('span.arrow', { 'aria-hidden': 'true' }, { ascending: '\u25b2', descending: '\u25bc', none: '' }[sorted])));
    };
    const aboutLine = turned ? about.profile : about.method, aboutColumn = turned ? about.profile && about.method : about.profile;
    const table = h(`table.answer.${state.look}`, { role: 'grid', 'aria-label': turned ? 'Chips by methods' : 'Methods by chips', style: `--columns: ${columns.length}` },
        h('thead', {}, h('tr', {}, heading('', turned ? 'chip' : 'method', ''),
            columns.map((column) => heading(column, column, aboutColumn(column))))),
        h('tbody', {}, lines.map((line) => h('tr', {},
            h('th', { scope: 'row', role: 'rowheader' }, h('span.name', {}, line), h('span.below', {}, aboutLine(line))),
            columns.map((column) => {
                const entry = entryAt(line, column);
                return h('td', { role: 'gridcell' }, entry ? entryButton(entry, actions.open) : null);
            })))));
    walk(table);
    return table;
}

/// Arrow keys, Home, End, with Ctrl to the first and last row, PageUp and PageDown.
function walk(table) {
    const rows = [...table.rows];
    const at = (row, column) => rows[row]?.cells[column]?.querySelector('button');
    /// The button of a row that is nearest to a column.
    const nearest = (row, column) => {
        for (let off = 0; off < rows[0].cells.length; ++off) {
            const button = at(row, column - off) ?? at(row, column + off);
            if (button) return button;
        }
        return null;
    };
    const stop = (button) => {
        for (const other of table.querySelectorAll('button[tabindex="0"]')) other.tabIndex = -1;
        button.tabIndex = 0;
    };
    table.addEventListener('focusin', (event) => stop(event.target));
    table.addEventListener('keydown', (event) => {
        const cell = event.target.closest('td, th');
        if (!cell || event.altKey || event.metaKey) return;
        const row = cell.parentNode.rowIndex, column = cell.cellIndex;
        const width = rows[0].cells.length, height = rows.length;
        const far = event.ctrlKey;
        const moves = {
            ArrowLeft: [row, column - 1, 0, -1], ArrowRight: [row, column + 1, 0, 1],
            ArrowUp: [row - 1, column, -1, 0], ArrowDown: [row + 1, column, 1, 0],
            Home: [far ? 0 : row, 0, 0, 1], End: [far ? height - 1 : row, width - 1, 0, -1],
            PageUp: [Math.max(0, row - 8), column, 1, 0], PageDown: [Math.min(height - 1, row + 8), column, -1, 0],
        };
        if (!moves[event.key] || (far && !['Home', 'End'].includes(event.key))) return;
        event.preventDefault();
        // Over what holds no button (the names of lines, a pair that wasn't drawn) to the next that does.
        const [r0, c0, dr, dc] = moves[event.key];
        const inside = (r, c) => r >= 0 && r < height && c >= 0 && c < width && (r !== row || c !== column);
        for (let r = r0, c = c0; inside(r, c); r += dr, c += dc) if (at(r, c)) return at(r, c).focus();
        // Only the heading of the names' column is a button: up and down go on beside it.
        for (let r = r0; dr && inside(r, column) && r !== row; r += dr) if (nearest(r, column)) return nearest(r, column).focus();
    });
    const first = table.tBodies[0].querySelector('button') ?? table.querySelector('button');
    if (first) stop(first);
}

/// The shown table as rows for CSV; what was not measured is empty.
export const tableRows = (shown) => shown.all().map((e) => {
    const measured = (value) => (e.drawn ? value : null);
    const both = (name, range) => ({ [`${name}_min`]: range?.[0], [`${name}_max`]: range?.[1] });
    return {
        profile: e.profile, method: e.row, verdict: e.verdict, chosen: e.chosen, cells: e.cells.length, changed: e.changed,
        ...both('scene_passes', e.passes.scene), ...both('volume_passes', e.passes.volume), ...both('rectangles', e.passes.rectangle), ...both('copies', e.passes.copy),
        wrong_edge: measured(e.edge), wrong_interior: measured(e.interior), tied: measured(e.tied), pixels: measured(e.pixels), time_ratio: e.ratio,
        causes: [...e.causes].map(([cause, pixels]) => `${cause}: ${pixels}`).join('; '), missing: [...e.missing].map(([what, source]) => `${what} [${source}]`).join('; '), error: e.error,
    };
});
