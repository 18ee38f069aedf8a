// Two runs: only what changed, by the cause of the change.
import { h, plural } from './dom.js';

const most = 200;  // lines of a group before the reader asks for more

/// @param open  shows a cell, by its id
/// @param has   whether the run has a cell of that id
export function compareSection(compare, command, open, has) {
    const total = compare.changes.reduce((sum, change) => sum + change.cells.length, 0);
    return h('section.compare', { 'aria-labelledby': 'compare-title' },
        h('h2', { id: 'compare-title' }, 'What changed'),
        h('p', {}, 'From ', h('code', {}, compare.old.command), ` (${compare.old.program}) to `, h('code', {}, command), ': ',
            total ? `${plural(total, 'cell')} in ${plural(compare.changes.length, 'group')}.` : 'nothing.'),
        compare.changes.map((change) => group(change, open, has)));
}

function group(change, open, has) {
    const box = h('div');
    const node = h('details', {}, h('summary', {}, h('b', {}, change.cause), ` \u00b7 ${plural(change.cells.length, 'cell')}`), box);
    node.addEventListener('toggle', () => {
        if (node.open && !box.childElementCount) box.append(lines(change.cells, open, has));
    });
    return node;
}

const text = (value) => (value === undefined || value === null ? 'none' : typeof value === 'object' ? JSON.stringify(value) : String(value));

/// What differs between two objects, key by key; nested ones with a dot.
export function differences(before, after, head = '') {
    const keys = [...new Set([...Object.keys(before ?? {}), ...Object.keys(after ?? {})])];
    return keys.flatMap((key) => {
        const [a, b] = [before?.[key], after?.[key]];
        const plain = (v) => v && typeof v === 'object' && !Array.isArray(v);
        if (plain(a) && plain(b)) return differences(a, b, `${head}${key}.`);
        return JSON.stringify(a) === JSON.stringify(b) ? [] : [{ key: head + key, before: a, after: b }];
    });
}

function lines(cells, open, has) {
    const body = h('tbody');
    const more = h('button', { type: 'button', onclick: () => add() }, 'More');
    const add = () => {
        const from = body.childElementCount;
        for (const { cell, old: before, new: after } of cells.slice(from, from + most)) {
            const what = before && after ? differences(before, after).map((d) => h('li', {}, h('span.muted', {}, `${d.key.replaceAll('_', ' ')}: `), `${text(d.before)} \u2192 ${text(d.after)}`))
                : h('li', {}, before ? 'is no more' : 'is new');
            body.append(h('tr', {}, h('td', {}, has(cell) ? h('a', { href: `#cell=${cell}`, onclick: (event) => (event.preventDefault(), open(cell)) }, cell) : cell), h('td', {}, h('ul.changes', {}, what))));
        }
        more.hidden = body.childElementCount >= cells.length;
    };
    add();
    return h('div.scroll', {}, h('table.plain', {}, h('thead', {}, h('tr', {}, h('th', { scope: 'col' }, 'cell'), h('th', { scope: 'col' }, 'change'))), body), more);
}
