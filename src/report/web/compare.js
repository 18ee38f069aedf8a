// Two runs: only what changed, by the cause of the change.
import { changeWords } from './change_words.js';
import { h, plural, symbolOf } from './dom.js';
import { verdicts } from './run.js';

const most = 200;  // lines of a group before the reader asks for more

/// The cells of a run that another has otherwise, each with its change {cell, old, new}.
export function changedCells(compare, cells) {
    const changed = new Map();
    for (const { cells: list } of compare?.changes ?? [])
        for (const change of list) if (change.new) for (const cell of cells.named(change.cell)) changed.set(cell, change);
    return changed;
}

/// @param go  shows a cell, by its index
export function compareSection(compare, command, cells, go) {
    const total = compare.changes.reduce((sum, change) => sum + change.cells.length, 0);
    const kinds = new Map();
    for (const change of compare.changes) {
        const [kind] = change.cause.split(': ');
        kinds.set(kind, [...(kinds.get(kind) ?? []), change]);
    }
    return h('section.compare', { 'aria-labelledby': 'compare-title' },
        h('h2', { id: 'compare-title' }, 'What changed'),
        h('p', {}, 'From ', h('code', {}, compare.old.command), ` (${compare.old.program}) to `, h('code', {}, command), ': ',
            total ? `${plural(total, 'cell')} in ${plural(compare.changes.length, 'group')}.` : 'nothing.'),
        [...kinds].map(([kind, changes]) => [
            h('h3', {}, `${kind[0].toUpperCase()}${kind.slice(1)}`, h('span.muted', {}, ` \u00b7 ${plural(changes.reduce((sum, change) => sum + change.cells.length, 0), 'cell')}`)),
            changes.map((change) => group(change, kind, cells, go)),
        ]));
}

function group(change, kind, cells, go) {
    const box = h('div');
    const node = h('details', {}, h('summary', {}, h('b', {}, causeWords(change.cause, kind)), ` \u00b7 ${plural(change.cells.length, 'cell')}`), box);
    node.addEventListener('toggle', () => {
        if (node.open && !box.childElementCount) box.append(lines(change.cells, cells, go));
    });
    return node;
}

/// "verdict: exact -> edge" under its heading: "exact → edge", verdicts with their symbols.
function causeWords(cause, kind) {
    const rest = cause === kind ? cause : cause.slice(kind.length + 2);
    return rest.split(' -> ').flatMap((side, at) => [at ? ' \u2192 ' : null, verdicts.includes(side) ? symbolOf(side) : null, at || verdicts.includes(side) ? ` ${side}` : side]);
}

function lines(list, cells, go) {
    const body = h('tbody');
    const more = h('button', { type: 'button', onclick: () => add() }, 'More');
    const add = () => {
        const from = body.childElementCount;
        for (const change of list.slice(from, from + most)) {
            const at = cells.find(change.cell);
            body.append(h('tr', {}, h('td', {}, at < 0 ? change.cell : h('a', { href: `#cell=${change.cell}`, onclick: (event) => (event.preventDefault(), go(at)) }, change.cell)),
                h('td', {}, changeList(change))));
        }
        more.hidden = body.childElementCount >= list.length;
    };
    add();
    return h('div.scroll', {}, h('table.plain', {}, h('thead', {}, h('tr', {}, h('th', { scope: 'col' }, 'cell'), h('th', { scope: 'col' }, 'change'))), body), more);
}

/// What changed of a cell, line by line.
export const changeList = (change) => h('ul.changes', {}, changeWords(change).map(({ what, text }) => h('li', {}, what ? h('span.muted', {}, `${what}: `) : null, text)));
