// What an address may say: each word of it is held against the run, and what isn't there is named and left out.
import { lists, stateOf, views, words } from './state.js';

const titles = { profile: 'chip', method: 'method', scene: 'scene', size: 'size', frame: 'frame', verdict: 'verdict', mark: 'row', chip: 'chip', path: 'scene' };
const ways = ['up', 'down'];

/// Reads an address.
/// @param known  {profile, method, scene, size, frame, verdict, mark, chip, path, figure, across, look, changed: lists of what there is}
/// @return       {state, faults: sentences}
export function readAddress(hash, known) {
    const { state, unknown } = stateOf(hash);
    const faults = unknown.map((part) => `The address says \u201c${part}\u201d, which means nothing here.`);
    for (const name of lists) {
        if (!state[name]) continue;
        const strange = [...state[name]].filter((value) => !known[name].includes(value));
        for (const value of strange) {
            faults.push(`The address asks for ${name}=${value}: the run has no such ${titles[name]}.`);
            state[name].delete(value);
        }
        if (strange.length && !state[name].size) state[name] = null;
    }
    const drop = (name, why) => {
        faults.push(`The address asks for ${name}=${state[name]}: ${why}.`);
        state[name] = words[name] ?? views[name];
    };
    for (const name of ['chip', 'path'])
        if (state[name] && !known[name].includes(state[name])) drop(name, `the run has no such ${titles[name]}`);
    for (const name of ['figure', 'across', 'look'])
        if (!known[name].includes(state[name])) drop(name, `known are ${known[name].join(', ')}`);
    if (state.changed && !known.changed.includes(state.changed))
        drop('changed', known.changed.length ? `known are ${known.changed.join(', ')}` : 'this page compares no runs');
    if (state.sort) {
        const { column, way } = splitSort(state.sort);
        if (!ways.includes(way)) drop('sort', 'it must end in :up or :down');
        else if (column && !known.profile.includes(column) && !known.mark.includes(column)) drop('sort', 'the table has no such column');
    }
    if (!state.cell)
        for (const [name, usual] of Object.entries(views)) if (state[name] !== usual) drop(name, 'it belongs to a cell, and none is named');
    return { state, faults };
}

/// "tnt:down" as {column, way}; empty both where there is no order. The column "" is that of the names.
export function splitSort(sort) {
    const at = sort.lastIndexOf(':');
    return at < 0 ? { column: '', way: '' } : { column: sort.slice(0, at), way: sort.slice(at + 1) };
}

/// Holds how a cell is looked at against what there is of it; what can't be is put back in place.
/// @param drawing  of the run, with its pictures and its strip; null: the report keeps none of the cell
/// @return         sentences
export function mendView(state, drawing, { width, height }) {
    const faults = [];
    const drop = (name, why) => {
        faults.push(`The address asks for ${name}=${state[name]}: ${why}.`);
        state[name] = views[name];
    };
    const asked = (name) => state[name] !== views[name];
    const known = Object.keys(drawing?.pictures ?? {}), strip = drawing?.strip ?? [];
    for (const name of ['pair', 'divider', 'zoom', 'pixel']) if (asked(name) && !known.length) drop(name, 'the report keeps no pictures of this cell');
    for (const name of ['pass', 'buffer', 'pass-zoom', 'pass-pixel']) if (asked(name) && !strip.length) drop(name, 'the report keeps no film strip of this cell');
    if (asked('pair')) {
        const pair = state.pair.split(',');
        const strange = pair.filter((id) => !known.includes(id));
        if (pair.length !== 2 || strange.length) drop('pair', `it takes two of ${known.join(', ')}`);
    }
    if (asked('divider') && !(isNumber(state.divider) && state.divider <= 100)) drop('divider', 'it goes from 0 to 100 percent');
    for (const name of ['zoom', 'pass-zoom']) if (asked(name) && !(isNumber(state[name]) && state[name] > 0 && state[name] <= 128)) drop(name, 'it goes up to 128');
    for (const name of ['pixel', 'pass-pixel']) {
        if (!asked(name)) continue;
        const pixel = pixelOf(state[name]);
        if (!pixel) drop(name, 'a pixel is two whole numbers, x,y');
        else if (pixel.x >= width || pixel.y >= height) drop(name, `the picture has ${width}\u00d7${height} pixels`);
    }
    if (asked('pass') && !strip.some(({ pass }) => String(pass) === state.pass)) drop('pass', `the film strip has passes from ${strip[0].pass} to ${strip.at(-1).pass}, ${strip.length} of them`);
    const buffers = [...new Set(strip.flatMap((pass) => Object.keys(pass.buffers)))];
    if (asked('buffer') && !buffers.includes(state.buffer)) drop('buffer', `the film strip has ${buffers.join(', ')}`);
    return faults;
}

const isNumber = (text) => /^\d+(\.\d+)?$/.test(text);

/// "3,4" as {x, y}; null if it is none.
export function pixelOf(text) {
    const found = /^(\d+),(\d+)$/.exec(text);
    return found ? { x: Number(found[1]), y: Number(found[2]) } : null;
}
