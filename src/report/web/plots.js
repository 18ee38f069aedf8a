// The plots: each with its file of SVG and of CSV and its rows as a table; methods can be marked in all of them.
import { h, roving, themeColour } from './dom.js';
import { vega } from './lazy.js';
import { accuracyLabels, accuracyRows, accuracySpec, passRows, passSpec, pathLabels, pathRows, pathSpec } from './plot_specs.js';
import { isDrawn } from './run.js';
import { csvOf, save } from './save.js';
import { stateGraph } from './states.js';
import { sentenceOf } from './table.js';

const paperWidth = 470;  // of a plot, pixels: two beside each other on an A4 page on its side

/// The page's colours and letters for Vega-Lite.
function pageConfig() {
    const ink = themeColour('--ink'), muted = themeColour('--muted'), line = themeColour('--line');
    const font = getComputedStyle(document.body).fontFamily;
    return {
        background: null,
        font,
        view: { stroke: line },
        axis: { labelColor: muted, titleColor: ink, gridColor: line, domainColor: muted, tickColor: muted, titleFontWeight: 'normal', labelFontSize: 12, titleFontSize: 12 },
        legend: { labelColor: ink, titleColor: ink, labelFontSize: 12, symbolStrokeWidth: 2, titleFontWeight: 'normal' },
        text: { color: ink, fontSize: 12 },
        title: { color: ink, font, fontSize: 12, fontWeight: 'normal', anchor: 'start', offset: 10 },
        line: { color: muted },
        rule: { color: muted },
        range: { category: [1, 2, 3, 4, 5, 6, 7, 8].map((i) => themeColour(`--series-${i}`)) },
    };
}

/// One plot with its buttons.
/// @param over  takes the method under the pointer, null where there is none; may be left out
function plot(id, title, hint, over) {
    const box = h('div.plot-box');
    const rowsBox = h('div.rows');
    const rowsDetails = h('details', {}, h('summary', {}, 'Rows of the plot'), rowsBox);
    let view = null, rows = [], turn = 0, makeSvg = null;
    const node = h('figure.plot', { id: `plot-${id}` },
        h('figcaption', {}, h('h3', {}, title), h('p.muted', {}, hint)), box,
        h('div.row', {},
            h('button', { type: 'button', 'data-do': 'svg', 'aria-label': `${title}: save as SVG`, onclick: async () => save(`gnomon-${id}.svg`, 'image/svg+xml', makeSvg ? makeSvg() : await view.toSVG()) }, 'SVG'),
            h('button', { type: 'button', 'data-do': 'csv', 'aria-label': `${title}: save as CSV`, onclick: () => save(`gnomon-${id}.csv`, 'text/csv', csvOf(rows)) }, 'CSV')),
        rowsDetails);
    const fillRows = () => {
        if (!rowsDetails.open) return;
        const keys = Object.keys(rows[0] ?? {});
        rowsBox.replaceChildren(h('table.plain', {}, h('thead', {}, h('tr', {}, keys.map((key) => h('th', { scope: 'col' }, key.replaceAll('_', ' '))))),
            h('tbody', {}, rows.slice(0, 500).map((row) => h('tr', {}, keys.map((key) => h('td', {}, typeof row[key] === 'number' ? String(Math.round(row[key] * 1e4) / 1e4) : String(row[key]))))))));
    };
    rowsDetails.addEventListener('toggle', fillRows);
    const buttons = node.querySelectorAll('[data-do]');
    const ready = (is) => buttons.forEach((button) => (button.disabled = !is));
    let lit = [];
    return {
        node,
        /// Marks methods; none: all stand out.
        light(methods) {
            lit = methods;
            view?.signal('lit', lit).runAsync();
        },
        /// @param about     lines above the plot: of what it is, in its file too
        /// @param specOf    (rows, colours, width) to a specification
        /// @param labelsOf  (rows, scales and size) to rows of its labels
        async show(newRows, about, specOf, isOnPaper, labelsOf) {
            rows = newRows, makeSvg = null;
            const mine = ++turn;
            fillRows();
            ready(false);
            view?.finalize();
            view = null;
            delete node.dataset.drawn;
            if (!rows.length) return box.replaceChildren(h('p.muted', {}, 'Nothing that the filters leave was drawn on this chip.'));
            box.replaceChildren();
            const { drawPlot } = await vega();
            if (mine !== turn) return;
            const width = isOnPaper ? paperWidth : Math.max(220, box.clientWidth - 8);
            const colours = ['exact', 'edge', 'wrong'].map((verdict) => themeColour(`--${verdict}`));
            const spec = { title: { text: about, limit: width }, ...specOf(rows, colours, width) };
            const drawn = await drawPlot(spec, pageConfig(), box, width, labelsOf && ((scales) => labelsOf(rows, scales)));
            if (mine !== turn) return drawn.finalize();
            view = drawn.signal('lit', lit);
            for (const [event, isOver] of [['mouseover', true], ['mouseout', false]])
                view.addEventListener(event, (_, item) => item?.datum?.method && over(isOver ? item.datum.method : null));
            view.runAsync();
            node.dataset.drawn = rows.length;
            ready(true);
        },
        showGraph(newRows, graph) {
            rows = newRows;
            makeSvg = () => `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(graph)}`;
            fillRows();
            box.replaceChildren(h('div.graph', { tabIndex: 0, role: 'group', 'aria-label': title }, graph));
            node.dataset.drawn = rows.length;
            ready(true);
        },
    };
}

/// The methods of the plots, each a button that marks its point, line and bar. A pointer or the focus on it marks it for
/// the while, and says its figures.
/// @param light   takes the methods to be marked
/// @param change  takes those that stay marked, a set or null
function methodMarks(light, change) {
    const box = h('div.method-marks', { role: 'group', 'aria-label': 'Methods to be marked in the plots' });
    const said = h('p.mark-said.muted');
    let marked = new Set();
    const hint = 'A pointer on a method, here or in a plot, or the focus on its name marks it in all plots and shows its figures; a press on the name keeps it marked.';
    const rest = () => (light([...marked]), (said.textContent = hint));
    const on = (entry) => (light([entry.row]), (said.textContent = sentenceOf(entry)));
    let known = [];
    roving(box, 'button');
    return {
        node: h('div.plot-names', {}, box, said),
        /// What the pointer is over in a plot; null: nothing.
        point(method) {
            const entry = known.find(({ row }) => row === method);
            if (entry) on(entry);
            else rest();
        },
        /// @param entries  of the chosen chip
        show(entries, mark) {
            marked = mark ?? new Set(), known = entries;
            const focused = box.contains(document.activeElement) ? document.activeElement.dataset.method : null;
            box.replaceChildren(...entries.map((entry) => {
                const toggled = () => {
                    const next = new Set(marked);
                    if (!next.delete(entry.row)) next.add(entry.row);
                    change(next.size ? next : null);
                };
                return h('button', {
                    type: 'button', tabIndex: -1, 'data-method': entry.row, 'aria-label': sentenceOf(entry), 'aria-pressed': String(marked.has(entry.row)),
                    onmouseenter: () => on(entry), onfocus: () => on(entry), onmouseleave: rest, onblur: rest, onclick: toggled,
                }, entry.row);
            }));
            const stop = [...box.children].find((node) => node.dataset.method === focused) ?? box.firstElementChild;
            if (stop) stop.tabIndex = 0;
            if (focused && stop) stop.focus();
            else rest();
        },
    };
}

/// The section of all plots.
/// @param change  takes what is new of the state
export function plotSection(report, change) {
    const { cells, run } = report;
    const over = (method) => marks.point(method);
    const accuracy = plot('accuracy', 'Accuracy against time', 'Up is less exact, right is slower: the median of the host\u2019s time by that without shadows. On the dashed line nothing else is both faster and more exact.', over);
    const path = plot('path', 'Time along the camera path', 'The host\u2019s time of each frame by that of the same frame without shadows. A colour stands for where the count lives.', over);
    const passes = plot('passes', 'Passes of each method', 'As the OpenGL calls were counted: the most over the scenes and frames that the filters leave; the rows have the fewest too.', over);
    const states = run.states?.length ? plot('states', 'States of the mask', 'Each value that the chip\u2019s own arithmetic reaches, and what leads to the next.') : null;
    const stores = new Map(run.methods.map((method) => [method.id, method.store ?? 'by frame']));
    const chip = h('select', { id: 'plot-chip', onchange: () => change({ chip: chip.value }) });
    const scene = h('select', { id: 'plot-scene', onchange: () => change({ path: scene.value }) });
    const graph = h('select', { id: 'plot-mask', onchange: () => showStates() },
        (run.states ?? []).map((state, i) => h('option', { value: i }, `${state.profile}, ${state.method}`)));
    const marks = methodMarks((methods) => [accuracy, path, passes].forEach((one) => one.light(methods)), (mark) => change({ mark }));
    const node = h('section.plots', { 'aria-labelledby': 'plots-title' },
        h('div.section-head', {}, h('h2', { id: 'plots-title' }, 'Plots'),
            h('div.row', {}, h('label.field', {}, 'Chip ', chip), h('label.field', {}, 'Scene of the path ', scene))),
        marks.node,
        h('div.plot-grid', {}, accuracy.node, path.node, passes.node, states ? states.node : null));
    const about = h('p.muted');
    states?.node.querySelector('figcaption').append(h('label.field', {}, 'Chip and method ', graph), about);
    const showStates = () => {
        if (!states) return;
        const state = run.states[graph.value];
        about.textContent = state.title ?? '';
        states.showGraph(state.edges.map(({ from, to, label }) => ({ profile: state.profile, method: state.method, from, to, label })), stateGraph(state));
    };
    let last = null, onPaper = false;
    const showMarks = () => marks.show(last.shown.rows.map((row) => last.shown.entry(row, chip.value)).filter((entry) => entry && isDrawn(entry.verdict)), last.mark);
    const draw = () => {
        if (!last) return;
        const { shown, keep, scenes } = last;
        showMarks();
        const name = run.profiles.find(({ id }) => id === chip.value)?.name;
        const chipLine = name && name !== chip.value ? `${chip.value}, ${name}` : chip.value;
        const all = [chipLine, scenes.length > 3 ? `${scenes.length} scenes` : `${scenes.length === 1 ? 'scene' : 'scenes'} ${scenes.join(', ')}`];
        accuracy.show(accuracyRows(shown, chip.value, scenes), all, accuracySpec, onPaper, accuracyLabels);
        path.show(pathRows(cells, keep, chip.value, scene.value, (method) => stores.get(method)), [chipLine, `scene ${scene.value}`], pathSpec, onPaper, pathLabels);
        passes.show(passRows(shown, chip.value, scenes), all, passSpec, onPaper);
        showStates();
    };
    let width = 0;
    new ResizeObserver(() => {
        if (matchMedia('print').matches || Math.abs(node.clientWidth - width) < 8) return;
        width = node.clientWidth;
        draw();
    }).observe(node);
    return {
        node,
        draw,
        /// Draws for paper, or for the window again.
        toPaper(is) {
            onPaper = is;
            draw();
        },
        /// Marks methods for good, without drawing anything again.
        mark(methods) {
            if (!last) return;
            last.mark = methods;
            showMarks();
        },
        /// @param shown  of table(), as the filters leave it
        update(shown, keep, scenes, state) {
            const drawn = (profile) => shown.rows.filter((row) => isDrawn(shown.entry(row, profile)?.verdict ?? 'refused')).length;
            const best = [...shown.profiles].sort((a, b) => drawn(b) - drawn(a))[0] ?? '';
            fillSelect(chip, shown.profiles, shown.profiles.includes(state.chip) ? state.chip : best);
            fillSelect(scene, scenes, scenes.includes(state.path) ? state.path : scenes[0]);
            last = { shown, keep, scenes, mark: state.mark };
            draw();
        },
    };
}

function fillSelect(select, values, value) {
    select.replaceChildren(...values.map((v) => h('option', { value: v }, v)));
    select.value = value ?? '';
}
