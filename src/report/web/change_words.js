// What differs between two runs' answers for a cell, in words.

/// What differs between two objects, key by key; nested ones with a dot.
export function differences(before, after, head = '') {
    const keys = [...new Set([...Object.keys(before ?? {}), ...Object.keys(after ?? {})])];
    return keys.flatMap((key) => {
        const [a, b] = [before?.[key], after?.[key]];
        const plain = (v) => v && typeof v === 'object' && !Array.isArray(v);
        if ((plain(a) || plain(b)) && (plain(a) || isNone(a)) && (plain(b) || isNone(b))) return differences(a, b, `${head}${key}.`);
        return JSON.stringify(a) === JSON.stringify(b) ? [] : [{ key: head + key, before: a, after: b }];
    });
}

const isNone = (value) => value === undefined || value === null || value === '';

const names = {
    'wrong.edge': 'wrong pixels at the boundaries', 'wrong.interior': 'wrong pixels away from the boundaries', unpredicted: 'unpredicted pixels',
    'tied.truth': 'pixels in which truth is tied', 'tied.count': 'pixels in which the count is tied', 'passes.scene': 'scene passes', 'passes.volume': 'volume passes',
    'passes.rectangle': 'rectangles', 'passes.copy': 'copies', chosen: 'the path that gnomon takes',
};
const nameOf = (key) => names[key] ?? (key.startsWith('causes.') ? `wrong pixels, ${key.slice(7)}` : key.replaceAll('_', ' ').replace('.', ', '));

const textOf = (value) => (isNone(value) ? 'none' : value === true ? 'yes' : value === false ? 'no' : Array.isArray(value) ? value.join(', ') || 'none' : String(value));

/// What came and what went of two lists of texts.
function listWords(before, after, now, noMore) {
    const [a, b] = [before ?? [], after ?? []];
    return [
        ...b.filter((text) => !a.includes(text)).map((text) => ({ what: now, text })),
        ...a.filter((text) => !b.includes(text)).map((text) => ({ what: noMore, text })),
    ];
}

/// Of what a chip lacks; a lack that only another source names is said so.
function missingWords(before, after) {
    const whats = (list) => (list ?? []).map(({ what }) => what);
    const sourceOf = (list, what) => (list ?? []).find((one) => one.what === what)?.source || 'none';
    const sourced = whats(before).filter((what) => whats(after).includes(what) && sourceOf(before, what) !== sourceOf(after, what));
    return [
        ...listWords(whats(before), whats(after), 'lacks now', 'lacks no more'),
        ...sourced.map((what) => ({ what: `source of \u201c${what}\u201d`, text: `${sourceOf(before, what)} \u2192 ${sourceOf(after, what)}` })),
    ];
}

/// @param change  {old, new}: what differs of a cell on either side; null where a run has no such cell
/// @return        [{what, text}]
export function changeWords({ old: before, new: after }) {
    if (!before || !after) return [{ what: '', text: before ? 'is no more' : 'is new' }];
    return differences(before, after).flatMap(({ key, before: a, after: b }) => {
        if (key === 'missing') return missingWords(a, b);
        if (key === 'warnings') return listWords(a, b, 'warns now', 'warns no more');
        if (key === 'digest') return [{ what: '', text: 'another image or mask' }];
        return [{ what: nameOf(key), text: `${textOf(a)} \u2192 ${textOf(b)}` }];
    });
}
