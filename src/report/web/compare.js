// Two runs: only what changed, by the cause of the change.
import { changeWords } from './change_words.js';
import { counted, h, plural, symbolOf } from './dom.js';
import { verdicts } from './run.js';

const most = 200;  // lines of a group before the reader asks for more

/// The cells of a run that another has otherwise, each with its change {cell, old, new}.
export function changedCells(compare, cells) {
    const changed = new Map();
    for (const { cells: list } of compare?.changes ?? [])
        for (const change of list) if (change.new) for (const cell of cells.named(change.cell)) changed.set(cell, change);
    return changed;
}

/// Changes by the kind of their cause, and within by the cause in words; a cause of one word is its own kind.
/// @return  [{heading, number of cells, groups: [{words, cells}]}]
export function changeKinds(compare) {
    const kinds = new Map();
    for (const { cause, cells } of compare.changes) {
        const [kind] = cause.split(': '), words = causeWords(cause, cells[0], kind);
        if (!kinds.has(kind)) kinds.set(kind, new Map());
        kinds.get(kind).set(words, [...(kinds.get(kind).get(words) ?? []), ...cells]);
    }
    return [...kinds].map(([kind, groups]) => ({
        heading: headings[kind] ?? `${kind[0].toUpperCase()}${kind.slice(1)}`,
        number: [...groups.values()].reduce((sum, cells) => sum + cells.length, 0),
        groups: [...groups].map(([words, cells]) => ({ words, cells })),
    }));
}

const headings = { limits: 'What chips lack', passes: 'Passes: scene / volume / rectangle / copy' };

/// "verdict: exact -> edge" under its heading: "exact → edge". Of lists of lacks, which all cells of a group share, what
/// came and what went.
function causeWords(cause, first, kind) {
    if (kind === 'limits') return changeWords({ old: { missing: first.old.missing }, new: { missing: first.new.missing } }).map(({ what, text }) => `${what}: ${text}`).join('; ');
    return (cause === kind ? cause : cause.slice(kind.length + 2)).replaceAll(' -> ', ' \u2192 ');
}

/// "12 cells changed since the old run: ..."
export function changesInWords(compare) {
    const kinds = changeKinds(compare), total = kinds.reduce((sum, kind) => sum + kind.number, 0);
    if (!total) return 'No cell changed since the old run.';
    const of = ({ heading, number }) => `${counted(number)} in \u201c${heading.split(':')[0].toLowerCase()}\u201d`;
    return `${plural(total, 'cell')} changed since the old run: ${kinds.map(of).join(', ')}.`;
}

/// Which runs are compared: a command that both have is named once, a gnomon only where its version is known.
function bothRuns({ old }, run) {
    const code = (command) => h('code', {}, command);
    const version = /\d/.test(old.program) ? ` (${old.program})` : '';
    return old.command === run.command ? [`The old run${version} and the new one are both of `, code(run.command)]
        : ['From the old run, ', code(old.command), `${version}, to the new one, `, code(run.command)];
}

/// What a cell was that only the old run has; empty if there is none of that name.
export function onlyOldCell(compare, name) {
    const change = (compare?.changes ?? []).flatMap(({ cells }) => cells).find(({ cell, new: after }) => cell === name && !after);
    const verdict = change?.old?.verdict;
    return change ? `The cell ${name} stands only in the old run${verdict ? `, where it was ${verdict}` : ''}: the new run has none of that name.` : '';
}

/// @param go  shows a cell, by its index
export function compareSection(run, cells, go) {
    const { compare } = run;
    return h('section.compare', { 'aria-labelledby': 'compare-title' },
        h('h2', { id: 'compare-title' }, 'What changed'),
        h('p', {}, bothRuns(compare, run), compare.changes.length ? '.' : ': nothing changed.'),
        changeKinds(compare).map(({ heading, number, groups }) => [
            h('h3', {}, heading, h('span.muted', {}, ` \u00b7 ${plural(number, 'cell')}`)),
            groups.map((group) => groupDetails(group, cells, go)),
        ]));
}

function groupDetails({ words, cells: list }, cells, go) {
    const box = h('div');
    const marked = words.split(' \u2192 ').flatMap((side, at) => [at ? ' \u2192 ' : null, verdicts.includes(side) ? [symbolOf(side), ' '] : null, side]);
    const node = h('details', {}, h('summary', {}, h('b', {}, marked), ` \u00b7 ${plural(list.length, 'cell')}`), box);
    node.addEventListener('toggle', () => {
        if (node.open && !box.childElementCount) box.append(lines(list, cells, go));
    });
    return node;
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
