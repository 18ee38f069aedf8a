// The pictures of an opened cell and its film strip, or where the report keeps some.
import { pixelOf } from './address.js';
import { h } from './dom.js';
import { isDrawn, nearestMate, rowOf } from './run.js';
import { filmStrip } from './strip.js';
import { viewer } from './viewer.js';

const labels = { image: 'image', mask: 'mask', truth: 'truth', causes: 'causes', difference: 'difference' };

const drawingOf = ({ cells, run }, cell) => run.drawings[cells.get('drawing', cell) ?? -1] ?? null;
export const hasPictures = (report, cell) => Object.keys(drawingOf(report, cell)?.pictures ?? {}).length > 0;
const hasStrip = (report, cell) => drawingOf(report, cell)?.strip?.length > 0;

/// What came otherwise when a cell was drawn again for the report; null if nothing did.
export function drawnOtherwise(report, cell) {
    const drawing = drawingOf(report, cell);
    if (drawing?.error) return h('p.otherwise', {}, `Not drawn again: ${drawing.error}`);
    return drawing?.differs?.length ? h('p.otherwise', {}, `Drawn again now, otherwise than in the run: ${drawing.differs.join(', ')}.`) : null;
}

/// @param mates  the cells of the same method and chip
/// @param state  how the cell is looked at, as views in state.js has it
/// @param look   takes what is new of that
export function cellPictures(report, cell, mates, state, go, look) {
    if (!hasPictures(report, cell)) {
        if (!isDrawn(report.cells.get('verdict', cell))) return null;
        const why = drawingOf(report, cell)?.error ? 'There are no pictures of this frame.' : 'The report keeps no pictures of this frame.';
        return h('section', {}, h('h3', {}, 'Pictures'), elsewhere(report, cell, mates.filter((mate) => hasPictures(report, mate)), go, why));
    }
    const { run } = report, drawing = drawingOf(report, cell);
    const get = (picture) => report.pictures.get(picture);
    const box = h('div', {}, h('p.muted', {}, 'Unpacking the pictures \u2026'));
    const failed = (error) => box.replaceChildren(h('p', { role: 'alert' }, `The pictures can\u2019t be read: ${error.message}`));
    Promise.all(Object.entries(drawing.pictures).map(async ([id, picture]) => ({ id, label: labels[id] ?? id, picture: await get(picture) })))
        .then((views) => {
            const view = viewer(views, run.causes, {
                label: 'Pictures of the cell', pair: state.pair.split(','), divider: state.divider / 100, zoom: Number(state.zoom), pixel: pixelOf(state.pixel),
                keep: ({ pair, divider, zoom, pixel }) => look({ pair: pair.join(','), divider: String(Math.round(100 * divider)), zoom, pixel }),
            });
            box.replaceChildren(view.node);
            view.draw();
        }).catch(failed);
    const strip = hasStrip(report, cell) ? filmStrip(drawing.strip, run.causes, get, state, look) : null;
    return [h('section', {}, h('div.pictures-head', {}, h('h3', {}, 'Pictures'),
        strip && h('button', { type: 'button', 'data-do': 'to-strip', onclick: () => strip.querySelector('.film').focus() }, 'To the film strip \u2193')), box,
        h('p.muted.keys', {}, 'Keys in a picture: arrows walk over pixels (with Shift by ten), + and \u2212 zoom, 0 fits, [ and ] move the divider, b blinks, s swaps. A click keeps its pixel in the address. From the cell\u2019s heading the left and right arrow go to the frame before and after, and b, s, +, \u2212 and 0 act on these pictures.')),
    h('section.film-section', {}, h('h3', {}, 'Film strip: the buffers after every pass'),
        strip ?? stripElsewhere(report, cell, mates, go))];
}

function elsewhere({ cells }, cell, there, go, why) {
    const { mate, isSame } = nearestMate(cells, cell, there);
    const of = isSame || mate < 0 ? '' : ` of the scene ${cells.get('scene', mate)}`;
    const none = isSame ? '' : ` It keeps none of the scene ${cells.get('scene', cell)} with this method on this chip${mate < 0 ? ', nor of another' : ''}.`;
    return [h('p', {}, `${why}${none}`), mate < 0 ? null : h('button', { type: 'button', 'data-do': 'elsewhere', onclick: () => go(mate) }, `Show frame ${cells.get('frame', mate)}${of}`)];
}

/// Where a strip is kept, if this cell has none: of this method on this chip, else of this method on another.
function stripElsewhere(report, cell, mates, go) {
    const { cells } = report, why = 'The report keeps no film strip of this frame; the command below writes it.';
    const there = mates.filter((mate) => hasStrip(report, mate));
    if (there.length) return elsewhere(report, cell, there, go, why);
    const row = rowOf(cells, cell), others = [];
    for (let i = 0; i < cells.count; ++i) if (hasStrip(report, i) && rowOf(cells, i) === row) others.push(i);
    const { mate } = nearestMate(cells, cell, others);
    return [h('p', {}, why), mate < 0 ? null
        : h('button', { type: 'button', onclick: () => go(mate) }, `Show that of ${cells.get('profile', mate)}, scene ${cells.get('scene', mate)}, frame ${cells.get('frame', mate)}`)];
}
