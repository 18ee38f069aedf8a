// The plots: each with its file of SVG and of CSV and its rows as a table.
import { h, themeColour } from './dom.js';
import { vega } from './lazy.js';
import { accuracyRows, accuracySpec, passRows, passSpec, pathRows, pathSpec } from './plot_specs.js';
import { csvOf, save } from './save.js';
import { stateGraph } from './states.js';

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
        line: { color: muted },
        range: { category: [1, 2, 3, 4, 5, 6, 7, 8].map((i) => themeColour(`--series-${i}`)) },
    };
}

/// One plot with its buttons.
function plot(id, title, hint) {
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
    return {
        node,
        async show(newRows, spec) {
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
            const drawn = await drawPlot(spec(rows, ['exact', 'edge', 'wrong'].map((verdict) => themeColour(`--${verdict}`))), pageConfig(), box);
            if (mine !== turn) return drawn.finalize();
            view = drawn;
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

/// The section of all plots.
/// @param change  takes what is new of the state
export function plotSection(report, change) {
    const { cells, run } = report;
    const accuracy = plot('accuracy', 'Accuracy against time', 'Up is less exact, right is slower: the median of the host\u2019s time by that without shadows. On the dashed line nothing else is both faster and more exact.');
    const path = plot('path', 'Time along the camera path', 'The host\u2019s time of each frame by that of the same frame without shadows.');
    const passes = plot('passes', 'Passes of each method', 'As the OpenGL calls were counted, in the last frame that the filters leave.');
    const states = run.states?.length ? plot('states', 'States of the mask', 'Each value that the chip\u2019s own arithmetic reaches, and what leads to the next.') : null;
    const chip = h('select', { id: 'plot-chip', onchange: () => change({ chip: chip.value }) });
    const scene = h('select', { id: 'plot-scene', onchange: () => change({ path: scene.value }) });
    const graph = h('select', { id: 'plot-mask', onchange: () => showStates() },
        (run.states ?? []).map((state, i) => h('option', { value: i }, `${state.profile}, ${state.method}`)));
    const node = h('section.plots', { 'aria-labelledby': 'plots-title' },
        h('div.section-head', {}, h('h2', { id: 'plots-title' }, 'Plots'),
            h('div.row', {}, h('label.field', {}, 'Chip ', chip), h('label.field', {}, 'Scene of the path ', scene))),
        h('div.plot-grid', {}, accuracy.node, path.node, passes.node, states ? states.node : null));
    const about = h('p.muted');
    states?.node.querySelector('figcaption').append(h('label.field', {}, 'Chip and method ', graph), about);
    const showStates = () => {
        if (!states) return;
        const state = run.states[graph.value];
        about.textContent = state.title ?? '';
        states.showGraph(state.edges.map(({ from, to, label }) => ({ profile: state.profile, method: state.method, from, to, label })), stateGraph(state));
    };
    let last = null;
    const draw = () => {
        if (!last) return;
        const { shown, keep } = last;
        accuracy.show(accuracyRows(shown, chip.value), accuracySpec);
        path.show(pathRows(cells, keep, chip.value, scene.value), pathSpec);
        passes.show(passRows(shown, chip.value), passSpec);
        showStates();
    };
    let width = 0;
    new ResizeObserver(() => {
        if (Math.abs(node.clientWidth - width) < 8) return;
        width = node.clientWidth;
        draw();
    }).observe(node);
    return {
        node,
        draw,
        /// @param shown  of table(), as the filters leave it
        update(shown, keep, scenes, state) {
            const drawn = (profile) => shown.rows.filter((row) => (shown.entry(row, profile)?.rank ?? 9) < 3).length;
            const best = [...shown.profiles].sort((a, b) => drawn(b) - drawn(a))[0] ?? '';
            fillSelect(chip, shown.profiles, shown.profiles.includes(state.chip) ? state.chip : best);
            fillSelect(scene, scenes, scenes.includes(state.path) ? state.path : scenes[0]);
            last = { shown, keep };
            draw();
        },
    };
}

function fillSelect(select, values, value) {
    select.replaceChildren(...values.map((v) => h('option', { value: v }, v)));
    select.value = value ?? '';
}
