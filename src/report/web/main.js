// The report's page: reads the data that stands in it and puts the parts together.
import { cellDialog } from './cell.js';
import { compareSection } from './compare.js';
import { blockText, bytesOfBase64, inflate } from './decode.js';
import { counted, h, plural, symbolOf } from './dom.js';
import { factsSection } from './facts.js';
import { filterBar } from './filters.js';
import { Pictures } from './pictures.js';
import { plotSection } from './plots.js';
import { Cells, table, verdicts } from './run.js';
import { csvOf, save } from './save.js';
import { entryKeeper, hashOf, initialState, keeper, stateOf } from './state.js';
import { answerTable, figureNames } from './table.js';

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

function summary(cells) {
    const counts = Object.fromEntries(verdicts.map((verdict) => [verdict, 0]));
    for (let cell = 0; cell < cells.count; ++cell) ++counts[cells.get('verdict', cell)];
    return h('p.summary', {}, verdicts.filter((verdict) => counts[verdict]).map((verdict) => h(`span.badge.${verdict}`, {}, symbolOf(verdict), `${counted(counts[verdict])} ${verdict}`)));
}

const legend = () => h('details.legend', {}, h('summary', {}, 'How to read it'),
    h('dl', {}, [
        ['exact', 'every pixel that can be judged is lit or in shadow as exact ray tracing says'],
        ['edge', 'wrong pixels, all within one mask pixel of the true boundary of a shadow'],
        ['wrong', 'wrong pixels away from the boundaries: a leak or a hole'],
        ['refused', 'the chip lacks what the method needs; the first lack stands below'],
        ['failed', 'a fault of gnomon or of the driver'],
    ].map(([verdict, meaning]) => h('div', {}, h('dt', {}, symbolOf(verdict), verdict), h('dd', {}, meaning)))),
    h('p', {}, '2/3: scene passes / rectangles over the whole window, as the OpenGL calls were counted. *: the path that gnomon takes on this chip. px: wrong pixels, added over the scenes and frames that the filters leave; the worst verdict counts. ',
        '\u00d72.7: the median of the host\u2019s time of a frame by that of the same frame without shadows. It is no time of the chip.'));

function start(report) {
    performance.mark('gnomon-data');
    const { run, cells } = report;
    let state = initialState();
    const profiles = new Map(run.profiles.map((profile) => [profile.id, profile]));
    const methods = new Map(run.methods.map((method) => [method.id, method]));
    const methodOf = (row) => methods.get(row) ?? methods.get(row.split(' ')[0]);
    const aboutMethod = (row) => {
        const m = methodOf(row);
        return m ? [m.store, m.arithmetic, m.count].filter((word) => word && word !== '-').join(' ') : '';
    };
    const factsOf = (entry) => [entry.row, entry.profile, profiles.get(entry.profile)?.name, profiles.get(entry.profile)?.kind, aboutMethod(entry.row),
        ...entry.missing.keys(), ...entry.causes.keys(), entry.error].filter(Boolean).join('\n').toLowerCase();

    const choices = Object.fromEntries(['profile', 'method', 'scene', 'frame'].map((name) => [name, cells.distinct(name).map(String)]));
    choices.frame.sort((a, b) => a - b);
    choices.size = [...new Set(Array.from({ length: cells.count }, (_, cell) => cells.size(cell)))];

    const change = (news) => {
        Object.assign(state, news);
        history.replaceState(null, '', hashOf(state) || location.pathname + location.search);
        render(news);
    };
    const bar = filterBar(choices, state, change);
    const box = h('div.answer-box');
    const select = (label, name, options) => {
        const node = h('select', { id: name, onchange: () => change({ [name]: node.value }) }, Object.entries(options).map(([value, text]) => h('option', { value }, text)));
        return { name, node, label: h('label.field', {}, `${label} `, node) };
    };
    const tools = [
        select('Across', 'across', { profiles: 'chips', methods: 'methods' }),
        select('Columns sort by', 'figure', figureNames),
        select('Show', 'look', { figures: 'figures', symbols: 'symbols' }),
    ];
    let shown = null;
    const csv = h('button', { type: 'button', id: 'table-csv', 'aria-label': 'The table: save as CSV', onclick: () => save('gnomon-table.csv', 'text/csv', csvOf(tableRows(shown))) }, 'CSV');
    const plots = plotSection(report, change);
    const dialog = cellDialog(report, (cell) => {
        if (cell < 0) return change({ cell: '' });
        // The first cell is a step of the browser's history, so that "back" closes it.
        const next = { ...state, cell: cells.id(cell) };
        history[state.cell ? 'replaceState' : 'pushState'](null, '', hashOf(next));
        state = next;
        dialog.show(cell);
    });
    const openId = (id) => {
        const cell = cells.find(id);
        if (cell >= 0) go(cell);
    };
    const go = (cell) => {
        history.pushState(null, '', hashOf({ ...state, cell: cells.id(cell) }));
        state.cell = cells.id(cell);
        dialog.show(cell);
    };

    /// @param news  what changed of the state; null: all of it
    function render(news) {
        const only = (...names) => news && Object.keys(news).every((name) => names.includes(name));
        if (!only('cell')) {
            const keep = keeper(cells, state);
            if (!only('chip', 'path')) {
                shown = leftOver(table(cells, keep), entryKeeper(state, factsOf));
                showTable(news);
                bar.update(state, { rows: shown.rows.length, profiles: shown.profiles.length, cells: shown.count, all: cells.count });
                for (const tool of tools) tool.node.value = state[tool.name];
            }
            if (!only('sort', 'figure', 'across', 'look')) {
                const scenes = choices.scene.filter((scene) => !state.scene || state.scene.has(scene));
                later(() => plots.update(shown, keep, scenes, state));
            }
        }
        const cell = state.cell ? cells.find(state.cell) : -1;
        problem(state.cell && cell < 0 ? `The run has no cell ${state.cell}.` : '');
        dialog.show(cell);
    }
    function showTable(news) {
        const column = box.contains(document.activeElement) ? document.activeElement.dataset.column : undefined;
        const scroll = [box.scrollLeft, box.scrollTop];
        if (!shown.rows.length) {
            box.replaceChildren(h('p.muted', {}, 'The filters leave nothing.'));
        } else {
            box.replaceChildren(answerTable(shown, state, {
                change,
                open: (entry) => go(entry.worst),
            }, { profile: (id) => [profiles.get(id)?.name ?? '', profiles.get(id)?.year].filter(Boolean).join(', '), method: aboutMethod }));
        }
        // Only where there is something to restore: it lays out the whole table at once.
        if (scroll[0] || scroll[1]) [box.scrollLeft, box.scrollTop] = scroll;
        // The heading that was pressed keeps the focus.
        if (news && column !== undefined) [...box.querySelectorAll('.head')].find((head) => head.dataset.column === column)?.focus();
    }

    document.getElementById('title').textContent = run.compare ? 'What changed between two runs' : 'Shadow methods on old graphics chips';
    document.getElementById('about').replaceChildren(h('code', {}, run.command), ` \u00b7 ${run.program} \u00b7 ${plural(cells.count, 'cell')}`);
    document.title = `${run.command} \u00b7 gnomon report`;
    document.getElementById('tools').append(themeButton(() => plots.draw()));
    const main = document.getElementById('main');
    const changes = run.compare ? compareSection(run.compare, run.command, openId, (id) => cells.find(id) >= 0) : null;
    main.append(...[
        changes,
        h('section', { 'aria-labelledby': 'answer-title' },
            h('div.section-head', {}, h('h2', { id: 'answer-title' }, 'Which method works on which chip'), summary(cells)),
            folded(bar.node, h('div.row.tools', {}, tools.map((tool) => tool.label), csv)), bar.shown,
            h('div', { id: 'answer', tabIndex: -1 }, box), legend()),
        plots.node,
        factsSection(run, choices.profile),
    ].filter(Boolean));

    const fromAddress = () => {
        state = { ...stateOf(location.hash) };
        render(null);
    };
    window.addEventListener('hashchange', fromAddress);
    window.addEventListener('popstate', fromAddress);
    fromAddress();
    performance.mark('gnomon-table');
    document.documentElement.dataset.ready = Math.round(performance.now());
}

/// The last of the tasks that were put off; the table is there before the plots.
let waiting = 0;
function later(task) {
    clearTimeout(waiting);
    waiting = setTimeout(task, 60);
}

/// The shown table as rows for CSV.
const tableRows = (shown) => shown.all().map((e) => ({
    profile: e.profile, method: e.row, verdict: e.verdict, chosen: e.chosen, cells: e.cells.length,
    scene_passes: e.passes.scene, volume_passes: e.passes.volume, rectangles: e.passes.rectangle, copies: e.passes.copy,
    wrong_edge: e.edge, wrong_interior: e.interior, tied: e.tied, pixels: e.pixels, time_ratio: e.ratio,
    causes: [...e.causes].map(([cause, pixels]) => `${cause}: ${pixels}`).join('; '), missing: [...e.missing].map(([what, source]) => `${what} [${source}]`).join('; '), error: e.error,
}));

/// Shows what is wrong; nothing if nothing is.
function problem(text) {
    const node = document.getElementById('problem');
    node.hidden = !text;
    node.textContent = text;
}

readReport().then(start).catch((error) => problem(`The report can\u2019t be shown: ${error.message}.`));
