// What the reader has chosen: filters, order, what is marked, the cell that is open and how it is looked at. All of it
// stands in the address.

/// Lists to choose from; null: all. Of "mark", null: none.
export const lists = ['profile', 'method', 'scene', 'size', 'frame', 'verdict', 'mark'];

/// Those that filter.
export const filters = lists.filter((name) => name !== 'mark');

/// Single values, as they are at first. "changed" is "only" or "all"; "" is what the page does by itself.
export const words = { text: '', changed: '', sort: '', figure: 'verdict', across: 'profiles', look: 'figures', chip: '', path: '', cell: '' };

/// How an open cell is looked at: the two pictures, the divider in percent, pixels of the screen for one of the picture
/// ("": all of it is seen), the pixel "x,y"; of the film strip pass, buffer, zoom and pixel.
export const views = { pair: 'mask,truth', divider: '50', zoom: '', pixel: '', pass: '1', buffer: '', 'pass-zoom': '', 'pass-pixel': '' };

export function initialState() {
    return { ...Object.fromEntries(lists.map((name) => [name, null])), ...words, ...views };
}

// "/", ":" and "," stay readable in the address.
const encode = (text) => encodeURIComponent(text).replaceAll('%2F', '/').replaceAll('%3A', ':');
const encodeList = (values) => [...values].map(encode).join(',');

/// The part of the address behind "#"; what is as it was at first is left out, and how a cell is looked at while none is open.
export function hashOf(state) {
    const parts = [];
    const put = (name, text) => parts.push(`${name}=${text}`);
    if (state.cell) {
        put('cell', encode(state.cell));
        for (const [name, usual] of Object.entries(views))
            if (state[name] !== usual) put(name, encodeList(state[name].split(',')));
    }
    for (const name of lists) if (state[name]) put(name, encodeList(state[name]));
    for (const [name, usual] of Object.entries(words))
        if (name !== 'cell' && state[name] !== usual) put(name, encode(state[name]));
    return parts.length ? `#${parts.join('&')}` : '';
}

const decode = (text) => {
    try {
        return decodeURIComponent(text);
    } catch {
        return text;
    }
};

/// Inverse of hashOf().
/// @return  {state, unknown: the parts that it can't read, as they stand there}
export function stateOf(hash) {
    const state = initialState(), unknown = [];
    for (const part of hash.replace(/^#/, '').split('&').filter(Boolean)) {
        const at = part.indexOf('=');
        const [name, value] = [part.slice(0, Math.max(0, at)), part.slice(at + 1)];
        if (part === 'cell=') unknown.push(part);
        else if (lists.includes(name)) state[name] = new Set(value.split(',').filter(Boolean).map(decode));
        else if (Object.hasOwn(words, name) || Object.hasOwn(views, name)) state[name] = decode(value);
        else unknown.push(decode(part));
    }
    return { state, unknown };
}

/// The names of what differs between two states.
export function changedNames(before, after) {
    const text = (value) => (value instanceof Set ? JSON.stringify([...value]) : String(value));
    return Object.keys(after).filter((name) => text(before[name]) !== text(after[name]));
}

/// Whether a cell is left by the lists (not by verdict and text, which are about a chip's whole entry).
export function keeper(cells, state) {
    const tests = [];
    for (const name of ['profile', 'method', 'scene', 'frame'])
        if (state[name]) tests.push((cell) => state[name].has(String(cells.get(name, cell))));
    if (state.size) tests.push((cell) => state.size.has(cells.size(cell)));
    return (cell) => tests.every((test) => test(cell));
}

/// Whether an entry of the table is left by verdict, change and text: each word must stand somewhere in what is known of it.
/// @param changedOnly  whether only entries with a cell that changed are left
export function entryKeeper(state, factsOf, changedOnly) {
    const wanted = state.text.toLowerCase().split(/\s+/).filter(Boolean);
    return (entry) => {
        if (state.verdict && !state.verdict.has(entry.verdict)) return false;
        if (changedOnly && !entry.changed) return false;
        if (!wanted.length) return true;
        const facts = factsOf(entry);
        return wanted.every((word) => facts.includes(word));
    };
}
