// One cell, opened: verdict, pictures, film strip, plan, figures, what the chip lacks, the command.
import { cellKeys } from './cell_keys.js';
import { cellPictures, drawnOtherwise, hasPictures } from './cell_pictures.js';
import { changeList } from './compare.js';
import { counted, h, plural, roving, say, symbolOf } from './dom.js';
import { isDrawn, ratioText, rowOf } from './run.js';
import { copy } from './save.js';
import { explanation, numberText, planCommand, renderCommand } from './words.js';

/// @param report  {run, cells, pictures}
/// @param acts    {changes: of changedCells(), go(cell), look(what is new of how it is looked at), link(): the cell's part of an
///                address, closed(), home(cell): where the focus goes if nothing else had it}
export function cellDialog(report, acts) {
    const dialog = h('dialog.cell', { 'aria-labelledby': 'cell-title' });
    let back = null, shown = -1, hash = '';
    const empty = () => {
        const cell = shown;
        shown = -1;
        dialog.close();
        dialog.replaceChildren();
        (back?.isConnected && back !== document.body ? back : acts.home(cell)).focus();
    };
    dialog.addEventListener('close', () => {
        if (shown < 0) return;
        empty();
        acts.closed();
    });
    dialog.addEventListener('click', (event) => {
        if (event.target === dialog) dialog.close();
    });
    cellKeys(dialog);
    document.body.append(dialog);
    const look = (news) => {
        acts.look(news);
        hash = acts.link();
        dialog.querySelector('[data-link]').dataset.copy = address();
    };
    const address = () => location.href.split('#')[0] + acts.link();
    return {
        /// @param cell   -1 closes
        /// @param state  of the page
        show(cell, state) {
            if (cell < 0) return shown < 0 ? undefined : empty();
            const link = acts.link();
            if (cell === shown && hash === link) return;
            const wasOpen = shown >= 0;
            shown = cell, hash = link;
            if (!wasOpen) back = document.activeElement;
            const hadFocus = document.activeElement?.closest('.path') ? 'path' : document.activeElement?.dataset?.do;
            const scroll = dialog.scrollTop;
            dialog.replaceChildren(...content(report, cell, state, { ...acts, look, address, close: () => dialog.close() }));
            if (!wasOpen) dialog.showModal();
            dialog.scrollTop = wasOpen ? scroll : 0;
            const focus = wasOpen && hadFocus === 'path' ? dialog.querySelector('.path [aria-current=true]')
                : (wasOpen && hadFocus && dialog.querySelector(`[data-do="${hadFocus}"]`)) || dialog.querySelector('h2');
            focus.focus();
        },
    };
}

function content(report, cell, state, { changes, go, look, address, close }) {
    const { cells, run } = report;
    const verdict = cells.get('verdict', cell);
    const profile = run.profiles.find((p) => p.id === cells.get('profile', cell));
    const mates = matesOf(cells, cell);
    const at = mates.indexOf(cell);
    const step = (by, label, name) => h('button', {
        type: 'button', 'aria-label': label, 'data-do': name, disabled: at + by < 0 || at + by >= mates.length, onclick: () => go(mates[at + by]),
    }, by < 0 ? '\u25c0' : '\u25b6');
    const link = copyButton('Copy link', address);
    link.dataset.link = '';
    const change = changes.get(cell), text = cells.get('plan', cell);
    return [
        h('header.cell-head', {},
            h('div', {},
                h('h2', { id: 'cell-title', tabIndex: -1 }, symbolOf(verdict), ` ${rowOf(cells, cell)} on ${profile?.name ?? cells.get('profile', cell)}`),
                h('p.muted', {}, `${cells.get('scene', cell)}, frame ${cells.get('frame', cell)}, ${cells.size(cell).replace('x', '\u00d7')}`)),
            h('div.row', {}, step(-1, 'Frame before', 'before'), step(1, 'Next frame', 'next'), link,
                h('button', { type: 'button', 'data-do': 'close', onclick: close }, 'Close'))),
        h('p.problem', { role: 'alert', hidden: true }),
        h('div.cell-body', {},
            h('div.said', {},
                h('section.verdict', {}, h(`p.badge.${verdict}`, {}, symbolOf(verdict), verdict), explanation(cells, cell).map((sentence) => h('p', {}, sentence)),
                    drawnOtherwise(report, cell),
                    (cells.get('warnings', cell) ?? []).map((warning) => h('p.muted', {}, `Warned before it was drawn: ${warning}.`))),
                change ? h('section', {}, h('h3', {}, 'Changed since the old run'), changeList(change)) : null,
                missing(cells, cell, profile),
                causes(report, cell),
                path(report, cell, mates, go)),
            h('div.pictured', {}, cellPictures(report, cell, mates, state, go, look),
                text ? h('details.plan', { open: true }, h('summary', {}, h('h3', {}, 'Plan, and why each pass is there')), h('pre', { tabIndex: 0 }, text)) : null),
            h('div.rest', {}, figures(cells, cell),
                verdict === 'refused' ? h('section', {}, h('h3', {}, 'Why it is refused'), h('p', {}, 'This lists its passes and what the chip lacks for them:'), command(planCommand(cells, cell, run.methods)))
                    : h('section', {}, h('h3', {}, 'Draw it again'), command(renderCommand(cells, cell, run.methods))))),
    ];
}

/// All cells of the same method on the same chip, in the run's order.
function matesOf(cells, cell) {
    const row = rowOf(cells, cell), profile = cells.get('profile', cell);
    const same = (other) => cells.get('profile', other) === profile && rowOf(cells, other) === row;
    return Array.from({ length: cells.count }, (_, i) => i).filter(same);
}

/// The frames of the camera paths, scene by scene.
function path(report, cell, mates, go) {
    const { cells } = report;
    const scenes = new Map();
    for (const mate of mates) {
        const name = `${cells.get('scene', mate)} ${cells.size(mate).replace('x', '\u00d7')}`;
        if (!scenes.has(name)) scenes.set(name, []);
        scenes.get(name).push(mate);
    }
    const box = h('section.path', {}, h('h3', {}, 'Frames of the camera path'), [...scenes].map(([name, list]) =>
        h('div.path-row', { role: 'group', 'aria-label': name }, h('span.path-name', {}, name), h('div.row', {}, list.map((mate) => {
            const verdict = cells.get('verdict', mate), wrong = cells.wrong(mate);
            const label = `frame ${cells.get('frame', mate)}: ${verdict}${wrong ? `, ${plural(wrong, 'wrong pixel')}` : ''}${hasPictures(report, mate) ? ', with pictures' : ''}`;
            return h(`button.frame-button.${verdict}`, {
                type: 'button', 'aria-label': label, title: label, 'aria-current': mate === cell ? 'true' : 'false', onclick: () => go(mate),
            }, symbolOf(verdict), String(cells.get('frame', mate)), hasPictures(report, mate) ? h('i.film-mark', { 'aria-hidden': 'true' }) : null);
        })))));
    roving(box, '.frame-button');
    return box;
}

function missing(cells, cell, profile) {
    const list = cells.get('missing', cell) ?? [];
    if (!list.length) return null;
    const known = profile?.limits ?? [];
    return h('section', {}, h('h3', {}, 'What the chip lacks'),
        h('table.plain', {}, h('thead', {}, h('tr', {}, h('th', { scope: 'col' }, 'lacks'), h('th', { scope: 'col' }, 'source'))),
            h('tbody', {}, list.map(({ what, capability, source }) => h('tr', {}, h('td', {}, what),
                h('td', {}, source || known.find((limit) => limit.what === capability)?.source || 'none'))))));
}

function causes(report, cell) {
    const list = Object.entries(report.cells.get('causes', cell) ?? {});
    if (!list.length) return null;
    return h('section', {}, h('h3', {}, 'Why pixels are wrong'),
        h('ul.causes', {}, list.sort((a, b) => b[1] - a[1]).map(([cause, pixels]) => {
            const colour = report.run.causes.find((c) => c.name === cause)?.colour;
            return h('li', {}, h('i.swatch', { style: `background:${colour ?? 'transparent'}`, 'aria-hidden': 'true' }), `${cause}: ${plural(pixels, 'pixel')}`);
        })));
}

const elsewhere = new Set(['missing', 'causes', 'warnings', 'plan', 'drawing', 'profile', 'method', 'scene', 'frame', 'width', 'height', 'verdict', 'error']);
const measured = /^(passes|touched|tied|wrong|nesting)\.|^(chosen|pixels|unpredicted|vertices|clock|cpu_ms|unshadowed_ms|digest)$/;

/// All that the run has of a cell in numbers and words; what was measured only where it was.
function figures(cells, cell) {
    const drawn = isDrawn(cells.get('verdict', cell));
    const rows = [];
    for (const name of cells.columns.keys()) {
        const value = cells.get(name, cell);
        if (elsewhere.has(name) || value === null || value === undefined || value === '' || (!drawn && measured.test(name))) continue;
        rows.push(h('div', {}, h('dt', {}, name.replaceAll('_', ' ').replace('.', ', ')), h('dd', {}, valueText(value))));
    }
    const ratio = cells.ratio(cell);
    const time = !drawn || Number.isNaN(ratio) ? null : h('p', {}, `The frame took the host ${ratioText(ratio)} the time of the same frame without shadows. It is this computer\u2019s time, not the chip\u2019s.`);
    return h('section', {}, h('h3', {}, drawn ? 'Figures' : 'What was asked for'), time, h('dl.figures-list', {}, rows));
}

function valueText(value) {
    if (typeof value === 'number') return Number.isInteger(value) ? counted(value) : numberText(value);
    if (typeof value === 'boolean') return value ? 'yes' : 'no';
    return typeof value === 'object' ? Object.entries(value).map(([key, inner]) => `${key} ${inner}`).join(', ') : String(value);
}

function command(text) {
    return h('div.command', {}, h('code', { tabIndex: 0 }, text), copyButton('Copy command', () => text));
}

function copyButton(label, text) {
    const button = h('button', {
        type: 'button', 'data-do': label, 'data-copy': text(),
        onclick: async () => {
            const done = await copy(text());
            button.textContent = done ? 'Copied' : 'Not allowed';
            say(done ? 'Copied' : 'The browser did not allow it');
            setTimeout(() => (button.textContent = label), 1500);
        },
    }, label);
    return button;
}
