// The report's page: reads the data that stands in it and puts the parts together.
import { mendView, readAddress, splitSort } from './address.js';
import { cellDialog } from './cell.js';
import { changedCells, changesInWords, compareSection, onlyOldCell } from './compare.js';
import { blockText, bytesOfBase64, inflate } from './decode.js';
import { h } from './dom.js';
import { factsSection } from './facts.js';
import { filterBar } from './filters.js';
import { legend } from './legend.js';
import { onPaper, slices } from './paper.js';
import { Pictures } from './pictures.js';
import { plotSection } from './plots.js';
import { Cells, rowOf, table, verdicts } from './run.js';
import { csvOf, save } from './save.js';
import { changedNames, entryKeeper, filters, hashOf, initialState, keeper, views } from './state.js';
import { steps } from './steps.js';
import { answerTable, figureNames, tableRows } from './table.js';
import { answerOf, runInWords, verdictCounts } from './title.js';

const acrossNames = { profiles: 'chips', methods: 'methods' };
const lookNames = { figures: 'figures', symbols: 'symbols' };

/// Reads the blocks.
/// @throws Error  if there are none, or one can't be read
async function readReport() {
    performance.mark('gnomon-script');
    const head = blockText('gnomon-head'), text = blockText('gnomon-run');
    if (!head || !text) throw new Error('this page holds no run');
    const { format, run: { length }, chunks } = JSON.parse(head);
    if (format !== 1) throw new Error(`this page can\u2019t read data of format ${format}`);
    const run = JSON.parse(new TextDecoder().decode(await inflate(bytesOfBase64(text), length)));
    let block = null;
    const bytes = () => (block ??= bytesOfBase64(blockText('gnomon-pictures') ?? ''));
    return { run, cells: new Cells(run.cells), pictures: new Pictures(chunks, run.pictures ?? [], bytes) };
}

/// Only the rows and chips of which something is left.
function leftOver(whole, keep) {
    const left = new Map();
    for (const entry of whole.all()) if (keep(entry)) left.set(`${entry.row}\n${entry.profile}`, entry);
    const rows = new Set(), profiles = new Set();
    for (const entry of left.values()) rows.add(entry.row), profiles.add(entry.profile);
    return {
        rows: whole.rows.filter((row) => rows.has(row)),
        profiles: whole.profiles.filter((profile) => profiles.has(profile)),
        entry: (row, profile) => left.get(`${row}\n${profile}`) ?? null,
        all: () => [...left.values()],
        count: [...left.values()].reduce((sum, entry) => sum + entry.cells.length, 0),
    };
}

function themeButton(redraw) {
    const root = document.documentElement;
    const names = { '': 'Theme: system', light: 'Theme: light', dark: 'Theme: dark' };
    const button = h('button', {
        type: 'button', id: 'theme',
        onclick: () => {
            const order = Object.keys(names);
            const next = order[(order.indexOf(root.dataset.theme ?? '') + 1) % order.length];
            if (next) root.dataset.theme = next;
            else delete root.dataset.theme;
            button.textContent = names[next];
            redraw();
        },
    }, names['']);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
    return button;
}

/// What narrow windows show on request only.
function folded(...children) {
    const wide = matchMedia('(min-width: 561px)');
    const node = h('details.fold', { open: wide.matches }, h('summary', {}, 'Filter and order'), children);
    wide.addEventListener('change', () => (node.open = wide.matches));
    return node;
}

function start(report) {
    performance.mark('gnomon-data');
    const { run, cells } = report;
    let state = initialState(), faults = [];
    const profiles = new Map(run.profiles.map((profile) => [profile.id, profile]));
    const methods = new Map(run.methods.map((method) => [method.id, method]));
    const methodOf = (row) => methods.get(row) ?? methods.get(row.split(' ')[0]);
    const aboutMethod = (row) => {
        const m = methodOf(row);
        return m ? [m.store, m.arithmetic, m.count].filter((word) => word && word !== '-').join(' ') : '';
    };
    const factsOf = (entry) => [entry.row, entry.profile, profiles.get(entry.profile)?.name, profiles.get(entry.profile)?.kind, aboutMethod(entry.row),
        ...entry.missing.keys(), ...entry.causes.keys(), entry.error].filter(Boolean).join('\n').toLowerCase();
    const changes = changedCells(run.compare, cells);
    const whole = table(cells, () => true, changes);
    const changedOnly = () => changes.size > 0 && state.changed !== 'all';

    const choices = Object.fromEntries(['profile', 'method', 'scene', 'frame'].map((name) => [name, cells.distinct(name).map(String)]));
    choices.frame.sort((a, b) => a - b);
    choices.size = [...new Set(Array.from({ length: cells.count }, (_, cell) => cells.size(cell)))];
    const known = {
        ...choices, verdict: verdicts, mark: whole.rows, chip: choices.profile, path: choices.scene, figure: Object.keys(figureNames),
        across: Object.keys(acrossNames), look: Object.keys(lookNames), changed: changes.size ? ['only', 'all'] : [],
    };

    const book = steps(() => fromAddress());
    /// @param way  'push': a step of its own; 'type' and 'replace' write over one
    const change = (news, way = 'push') => {
        const names = changedNames(state, { ...state, ...news });
        if (!names.length) return;
        state = { ...state, ...news }, faults = [];
        render(names);
        book[way](hashOf(state));
    };
    const bar = filterBar(choices, changes.size > 0, change);
    const box = h('div.answer-box');
    const select = (label, name, options) => {
        const node = h('select', { id: name, onchange: () => change({ [name]: node.value }) }, Object.entries(options).map(([value, text]) => h('option', { value }, text)));
        return { name, node, label: h('label.field', {}, `${label} `, node) };
    };
    const tools = [select('Across', 'across', acrossNames), select('Columns sort by', 'figure', figureNames), select('Show', 'look', lookNames)];
    let shown = null;
    const csv = h('button', { type: 'button', id: 'table-csv', 'aria-label': 'The table: save as CSV', onclick: () => save('gnomon-table.csv', 'text/csv', csvOf(tableRows(shown))) }, 'CSV');
    const plots = plotSection(report, change);
    const heading = h('h2', { id: 'answer-title', tabIndex: -1 }, 'Which method works on which chip');

    // What the reader chose in one cell holds in the next, where there is such a picture, pixel or pass.
    let kept = {};
    const drawingOf = (cell) => run.drawings[cells.get('drawing', cell) ?? -1] ?? null;
    const viewOf = (whole) => Object.fromEntries(Object.keys(views).map((name) => [name, whole[name]]));
    const sizeOf = (cell) => ({ width: cells.get('width', cell), height: cells.get('height', cell) });
    const dialog = cellDialog(report, {
        changes,
        go: (cell) => go(cell),
        look(news) {
            Object.assign(kept, news);
            state = { ...state, ...news };
            book.replace(hashOf(state));
        },
        link: () => hashOf({ ...initialState(), cell: state.cell, ...viewOf(state) }),
        closed() {
            kept = { pair: kept.pair ?? views.pair, divider: kept.divider ?? views.divider };
            state = { ...state, cell: '' }, faults = [];
            problem(faults);
            if (!book.leave()) book.replace(hashOf(state));
        },
        home: (cell) => entryButtonOf(rowOf(cells, cell), cells.get('profile', cell)) ?? heading,
    });
    function go(cell) {
        const first = !state.cell;
        state = { ...state, ...views, ...kept, cell: cells.id(cell) }, faults = [];
        mendView(state, drawingOf(cell), sizeOf(cell));
        dialog.show(cell, state);
        // The first cell is a step of the browser's history, so that "back" closes it.
        if (first) book.push(hashOf(state), true);
        else book.replace(hashOf(state));
        problem(faults);
    }

    const forTable = [...filters, 'text', 'changed', 'sort', 'figure', 'across', 'look'], forPlots = [...filters, 'text', 'changed', 'chip', 'path'];
    /// @param names  what changed of the state
    function render(names) {
        const any = (list) => names.some((name) => list.includes(name));
        if (any(forTable)) {
            const left = filters.some((name) => name !== 'verdict' && state[name]) ? table(cells, keeper(cells, state), changes) : whole;
            shown = leftOver(left, entryKeeper(state, factsOf, changedOnly()));
            mendSort();
            showTable();
            bar.update(state, changedOnly(), { rows: shown.rows.length, profiles: shown.profiles.length, cells: shown.count, all: cells.count });
            for (const tool of tools) tool.node.value = state[tool.name];
        }
        if (any(forPlots)) {
            const scenes = choices.scene.filter((scene) => !state.scene || state.scene.has(scene));
            const rows = new Set(shown.rows), keep = keeper(cells, state);
            later(() => plots.update(shown, (cell) => keep(cell) && rows.has(rowOf(cells, cell)), scenes, state));
        }
        if (names.includes('mark')) plots.mark(state.mark);
        dialog.show(state.cell ? cells.find(state.cell) : -1, state);
        problem(faults);
    }
    /// An order by a column that the filters leave out is said, and given up.
    function mendSort() {
        const { column } = splitSort(state.sort);
        if (!column || !shown.rows.length || (state.across === 'methods' ? shown.rows : shown.profiles).includes(column)) return;
        faults.push(`The table has no column ${column} to be sorted by: it stands in the order of the run.`);
        state.sort = '';
    }
    const entryButtonOf = (row, profile) => [...box.querySelectorAll('.entry')].find((node) => node.dataset.row === row && node.dataset.profile === profile) ?? null;
    const draw = (part) => answerTable(part, state, { change, open: (entry) => go(entry.worst) },
        { profile: (id) => [profiles.get(id)?.name ?? '', profiles.get(id)?.year].filter(Boolean).join(', '), method: aboutMethod });
    function showTable() {
        const { column, row, profile } = box.contains(document.activeElement) ? document.activeElement.dataset : {};
        const scroll = [box.scrollLeft, box.scrollTop];
        box.replaceChildren(shown.rows.length ? draw(shown) : h('p.muted', {}, 'The filters leave nothing.'));
        // Only where there is something to restore: it lays out the whole table at once.
        if (scroll[0] || scroll[1]) [box.scrollLeft, box.scrollTop] = scroll;
        // What was pressed keeps the focus.
        if (column !== undefined) [...box.querySelectorAll('.head')].find((head) => head.dataset.column === column)?.focus();
        else if (row !== undefined) (entryButtonOf(row, profile) ?? box.querySelector('button[tabindex="0"]') ?? heading).focus();
    }

    document.getElementById('title').textContent = `${run.compare ? 'What changed between two runs. ' : ''}${runInWords(run, cells)}`;
    document.getElementById('about').before(h('p.result', { id: 'result' }, [run.compare ? changesInWords(run.compare) : '', ...answerOf(run, cells, whole)].join(' ').trim()));
    document.getElementById('about').replaceChildren(h('code', {}, run.command), ` \u00b7 ${run.program}`);
    document.title = `${run.command} \u00b7 gnomon report`;
    document.getElementById('tools').append(themeButton(() => plots.draw()));
    const answer = h('div', { id: 'answer', tabIndex: -1 }, box);
    document.querySelector('.skip').addEventListener('click', (event) => (event.preventDefault(), answer.focus()));
    const main = document.getElementById('main');
    main.append(...[
        run.compare ? compareSection(run, cells, go) : null,
        h('section', { 'aria-labelledby': 'answer-title' },
            h('div.section-head', {}, heading, verdictCounts(cells)),
            folded(bar.node, h('div.row.tools', {}, tools.map((tool) => tool.label), csv)), ...bar.shown, legend(changes.size > 0), answer),
        plots.node,
        factsSection(run, choices.profile),
    ].filter(Boolean));
    const sheets = h('div.sheets');
    onPaper(() => {
        sheets.replaceChildren(...slices(shown, state).map(draw));
        box.after(sheets);
        doNow();
        plots.toPaper(true);
    }, () => {
        sheets.remove();
        plots.toPaper(false);
    });

    function fromAddress() {
        const before = state;
        ({ state, faults } = readAddress(location.hash, known));
        const cell = state.cell ? cells.find(state.cell) : -1;
        if (cell >= 0) {
            faults.push(...mendView(state, drawingOf(cell), sizeOf(cell)));
            kept = viewOf(state);
        }
        if (state.cell && cell < 0) faults.push(onlyOldCell(run.compare, state.cell) || `The run has no cell ${state.cell}.`);
        render(shown ? changedNames(before, state) : Object.keys(state));
    }
    fromAddress();
    performance.mark('gnomon-table');
    document.documentElement.dataset.ready = Math.round(performance.now());
}

/// The last of the tasks that were put off; the table is there before the plots.
let waiting = null, timer = 0;
function later(task) {
    clearTimeout(timer);
    waiting = task;
    timer = setTimeout(doNow, 60);
}
function doNow() {
    clearTimeout(timer);
    const task = waiting;
    waiting = null;
    task?.();
}

/// Shows what is wrong, on the page and in the cell that lies over it; nothing if nothing is.
function problem(sentences) {
    const text = sentences.join(' ');
    for (const node of document.querySelectorAll('.problem')) {
        node.hidden = !text;
        if (node.textContent !== text) node.textContent = text;
    }
}

readReport().then(start).catch((error) => problem([`The report can\u2019t be shown: ${error.message}.`]));
