// What the reader has chosen: filters, order, the cell that is open. All of it stands in the address.

/// Lists to choose from; null: all.
export const lists = ['profile', 'method', 'scene', 'size', 'frame', 'verdict'];
const words = { text: '', sort: '', figure: 'verdict', across: 'profiles', look: 'figures', chip: '', path: '', cell: '' };

export function initialState() {
    return { ...Object.fromEntries(lists.map((name) => [name, null])), ...words };
}

// "/" and "," stay readable in the address.
const encode = (text) => encodeURIComponent(text).replaceAll('%2F', '/').replaceAll('%3A', ':');

/// The part of the address behind "#"; what is as it was at first is left out.
export function hashOf(state) {
    const parts = [];
    if (state.cell) parts.push(`cell=${encode(state.cell)}`);
    for (const name of lists) if (state[name]) parts.push(`${name}=${[...state[name]].map(encode).join(',')}`);
    for (const [name, usual] of Object.entries(words))
        if (name !== 'cell' && state[name] !== usual) parts.push(`${name}=${encode(state[name])}`);
    return parts.length ? `#${parts.join('&')}` : '';
}

const decode = (text) => {
    try {
        return decodeURIComponent(text);
    } catch {
        return text;
    }
};

/// Inverse of hashOf(); what it doesn't know is left out.
export function stateOf(hash) {
    const state = initialState();
    for (const part of hash.replace(/^#/, '').split('&')) {
        const [name, value] = [part.slice(0, part.indexOf('=')), part.slice(part.indexOf('=') + 1)];
        if (lists.includes(name)) state[name] = new Set(value.split(',').filter(Boolean).map(decode));
        else if (name in words) state[name] = decode(value);
    }
    return state;
}

/// Whether a cell is left by the lists (not by verdict and text, which are about a chip's whole entry).
export function keeper(cells, state) {
    const tests = [];
    for (const name of ['profile', 'method', 'scene', 'frame'])
        if (state[name]) tests.push((cell) => state[name].has(String(cells.get(name, cell))));
    if (state.size) tests.push((cell) => state.size.has(cells.size(cell)));
    return (cell) => tests.every((test) => test(cell));
}

/// Whether an entry of the table is left by verdict and text: each word must stand somewhere in what is known of it.
export function entryKeeper(state, factsOf) {
    const wanted = state.text.toLowerCase().split(/\s+/).filter(Boolean);
    return (entry) => {
        if (state.verdict && !state.verdict.has(entry.verdict)) return false;
        if (!wanted.length) return true;
        const facts = factsOf(entry);
        return wanted.every((word) => facts.includes(word));
    };
}
