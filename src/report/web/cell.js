// One cell, opened: verdict, pictures, film strip, plan, figures, what the chip lacks, the command.
import { counted, h, plural, roving, say, symbolOf } from './dom.js';
import { ratioText, rowOf } from './run.js';
import { copy } from './save.js';
import { filmStrip } from './strip.js';
import { viewer } from './viewer.js';
import { explanation, renderCommand } from './words.js';

const labels = { image: 'image', mask: 'mask', truth: 'truth', causes: 'causes', difference: 'difference' };
/// What the reader chose in one cell holds in the next.
const kept = { pair: ['mask', 'truth'], divider: 0.5 };

/// @param report  {run, cells, pictures}
/// @param go      opens another cell, by its index; -1 closes
export function cellDialog(report, go) {
    const dialog = h('dialog.cell', { 'aria-labelledby': 'cell-title' });
    let back = null, shown = -1;
    dialog.addEventListener('close', () => {
        if (shown >= 0) go(-1);
    });
    dialog.addEventListener('click', (event) => {
        if (event.target === dialog) dialog.close();
    });
    document.body.append(dialog);
    return {
        /// @param cell  -1 closes
        show(cell) {
            if (cell === shown) return;
            const wasOpen = shown >= 0;
            shown = cell;
            if (cell < 0) {
                dialog.close();
                dialog.replaceChildren();
                if (back?.isConnected) back.focus();
                return;
            }
            if (!wasOpen) back = document.activeElement;
            const hadFocus = document.activeElement?.closest('.path') ? 'path' : document.activeElement?.dataset?.do;
            const scroll = dialog.scrollTop;
            dialog.replaceChildren(...content(report, cell, go, () => dialog.close()));
            if (!wasOpen) dialog.showModal();
            dialog.scrollTop = wasOpen ? scroll : 0;
            const focus = wasOpen && hadFocus === 'path' ? dialog.querySelector('.path [aria-current=true]')
                : wasOpen && hadFocus ? dialog.querySelector(`[data-do="${hadFocus}"]`) : dialog.querySelector('h2');
            focus?.focus();
        },
    };
}

function content(report, cell, go, close) {
    const { cells, run } = report;
    const verdict = cells.get('verdict', cell);
    const profile = run.profiles.find((p) => p.id === cells.get('profile', cell));
    const mates = matesOf(cells, cell);
    const at = mates.indexOf(cell);
    const step = (by, label, name) => h('button', {
        type: 'button', 'aria-label': label, 'data-do': name, disabled: at + by < 0 || at + by >= mates.length, onclick: () => go(mates[at + by]),
    }, by < 0 ? '\u25c0' : '\u25b6');
    return [
        h('header.cell-head', {},
            h('div', {},
                h('h2', { id: 'cell-title', tabIndex: -1 }, symbolOf(verdict), ` ${rowOf(cells, cell)} on ${profile?.name ?? cells.get('profile', cell)}`),
                h('p.muted', {}, `${cells.get('scene', cell)}, frame ${cells.get('frame', cell)}, ${cells.size(cell).replace('x', '\u00d7')}`)),
            h('div.row', {}, step(-1, 'Frame before', 'before'), step(1, 'Next frame', 'next'),
                copyButton('Copy link', () => `${location.href.split('#')[0]}#cell=${cells.id(cell)}`),
                h('button', { type: 'button', 'data-do': 'close', onclick: close }, 'Close'))),
        h('div.cell-body', {},
            h('div.said', {},
                h('section.verdict', {}, h(`p.badge.${verdict}`, {}, symbolOf(verdict), verdict), explanation(cells, cell).map((sentence) => h('p', {}, sentence)),
                    (cells.get('warnings', cell) ?? []).map((warning) => h('p.muted', {}, `Warned before it was drawn: ${warning}.`))),
                path(cells, cell, mates, go),
                missing(cells, cell, profile),
                causes(report, cell)),
            h('div.pictured', {}, pictures(report, cell, mates, go), plan(cells, cell)),
            h('div.rest', {}, figures(cells, cell),
                h('section', {}, h('h3', {}, 'Draw it again'), command(renderCommand(cells, cell, run.methods))))),
    ];
}

/// All cells of the same method on the same chip, in the run's order.
function matesOf(cells, cell) {
    const row = rowOf(cells, cell), profile = cells.get('profile', cell);
    const same = (other) => cells.get('profile', other) === profile && rowOf(cells, other) === row;
    return Array.from({ length: cells.count }, (_, i) => i).filter(same);
}

/// The frames of the camera paths, scene by scene.
function path(cells, cell, mates, go) {
    const scenes = new Map();
    for (const mate of mates) {
        const name = `${cells.get('scene', mate)} ${cells.size(mate).replace('x', '\u00d7')}`;
        if (!scenes.has(name)) scenes.set(name, []);
        scenes.get(name).push(mate);
    }
    const box = h('section.path', {}, h('h3', {}, 'Frames of the camera path'), [...scenes].map(([name, list]) =>
        h('div.path-row', { role: 'group', 'aria-label': name }, h('span.path-name', {}, name), h('div.row', {}, list.map((mate) => {
            const verdict = cells.get('verdict', mate), wrong = cells.wrong(mate);
            const label = `frame ${cells.get('frame', mate)}: ${verdict}${wrong ? `, ${plural(wrong, 'wrong pixel')}` : ''}${hasPictures(cells, mate) ? ', with pictures' : ''}`;
            return h(`button.frame-button.${verdict}`, {
                type: 'button', 'aria-label': label, title: label, 'aria-current': mate === cell ? 'true' : 'false', onclick: () => go(mate),
            }, symbolOf(verdict), String(cells.get('frame', mate)), hasPictures(cells, mate) ? h('i.film-mark', { 'aria-hidden': 'true' }) : null);
        })))));
    roving(box, '.frame-button');
    return box;
}

const drawingOf = (cells, cell) => cells.get('drawing', cell) ?? -1;
const hasPictures = (cells, cell) => drawingOf(cells, cell) >= 0;

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

function pictures(report, cell, mates, go) {
    const { cells, run } = report;
    if (!hasPictures(cells, cell)) {
        if (['refused', 'failed'].includes(cells.get('verdict', cell))) return null;
        const other = mates.find((mate) => hasPictures(cells, mate));
        return h('section', {}, h('h3', {}, 'Pictures'), h('p', {}, 'The report keeps no pictures of this frame. '),
            other === undefined ? null : h('button', { type: 'button', onclick: () => go(other) }, `Show frame ${cells.get('frame', other)} of ${cells.get('scene', other)}`));
    }
    const drawing = run.drawings[drawingOf(cells, cell)];
    const get = (picture) => report.pictures.get(picture);
    const box = h('div', {}, h('p.muted', {}, 'Unpacking the pictures \u2026'));
    const failed = (error) => box.replaceChildren(h('p', { role: 'alert' }, `The pictures can\u2019t be read: ${error.message}`));
    Promise.all(Object.entries(drawing.pictures).map(async ([id, picture]) => ({ id, label: labels[id] ?? id, picture: await get(picture) })))
        .then((views) => {
            const view = viewer(views, run.causes, { label: 'Pictures of the cell', pair: kept.pair, divider: kept.divider, keep: (chosen) => Object.assign(kept, chosen) });
            box.replaceChildren(view.node);
            view.draw();
        }).catch(failed);
    const strip = h('section', {}, h('h3', {}, 'Film strip: the buffers after every pass'),
        drawing.strip?.length ? filmStrip(drawing.strip, run.causes, get) : stripElsewhere(report, cell, mates, go));
    return [h('section', {}, h('h3', {}, 'Pictures'), box,
        h('p.muted.keys', {}, 'Keys in a picture: arrows walk over pixels (with Shift by ten), + and \u2212 zoom, 0 fits, [ and ] move the divider, b blinks, s swaps.')), strip];
}

/// Where a strip is kept, if this cell has none: of another frame, else on another chip.
function stripElsewhere({ cells, run }, cell, mates, go) {
    const hasStrip = (other) => hasPictures(cells, other) && run.drawings[drawingOf(cells, other)].strip?.length > 0;
    const row = rowOf(cells, cell);
    let other = mates.find(hasStrip);
    for (let i = 0; other === undefined && i < cells.count; ++i) if (hasStrip(i) && rowOf(cells, i) === row) other = i;
    return h('p', {}, 'The report keeps none of this frame; the command below writes it. ', other === undefined ? null
        : h('button', { type: 'button', onclick: () => go(other) }, `Show that of ${cells.get('profile', other)}, ${cells.get('scene', other)}, frame ${cells.get('frame', other)}`));
}

function plan(cells, cell) {
    const text = cells.get('plan', cell);
    return text ? h('details.plan', { open: true }, h('summary', {}, h('h3', {}, 'Plan, and why each pass is there')), h('pre', { tabIndex: 0 }, text)) : null;
}

/// All that the run has of a cell in numbers and words.
function figures(cells, cell) {
    const hidden = new Set(['missing', 'causes', 'warnings', 'plan', 'drawing', 'profile', 'method', 'scene', 'frame', 'width', 'height', 'verdict', 'error']);
    const rows = [];
    for (const name of cells.columns.keys()) {
        const value = cells.get(name, cell);
        if (hidden.has(name) || value === null || value === undefined || value === '') continue;
        rows.push(h('div', {}, h('dt', {}, name.replaceAll('_', ' ').replace('.', ', ')),
            h('dd', {}, typeof value === 'number' && Number.isInteger(value) ? counted(value) : typeof value === 'object' ? JSON.stringify(value) : String(value))));
    }
    const ratio = cells.ratio(cell);
    const time = Number.isNaN(ratio) ? null : h('p', {}, `The frame took the host ${ratioText(ratio)} the time of the same frame without shadows. It is this computer\u2019s time, not the chip\u2019s.`);
    return h('section', {}, h('h3', {}, 'Figures'), time, h('dl.figures-list', {}, rows));
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
