// The bar above the table: what is shown of the run.
import { h, plural, say, symbolOf } from './dom.js';
import { filterWords } from './filter_words.js';
import { verdicts } from './run.js';
import { filters } from './state.js';

const titles = { profile: 'Chips', method: 'Methods', scene: 'Scenes', size: 'Sizes', frame: 'Frames' };

/// @param choices   all values of each list, as text
/// @param compares  whether there are cells that changed
/// @param change    takes what is new of the state
export function filterBar(choices, compares, change) {
    const text = h('input', {
        type: 'search', id: 'text', placeholder: 'stencil, max, clamps \u2026', autocomplete: 'off',
        oninput: () => change({ text: text.value }, 'type'),
    });
    const changed = !compares ? null : h('button.toggle', {
        type: 'button', id: 'changed', onclick: () => change({ changed: changed.getAttribute('aria-pressed') === 'true' ? 'all' : '' }),
    }, '\u0394 changed only');
    const toggles = verdicts.map((verdict) =>
        h('button.toggle', {
            type: 'button', 'data-verdict': verdict,
            onclick: () => change({ verdict: toggled(bar.state.verdict, verdict) }),
        }, symbolOf(verdict), verdict));
    const picks = Object.keys(titles)
        .filter((name) => choices[name].length > 1)
        .map((name) => pick(name, choices[name], change));
    const reset = h('button', {
        type: 'button', id: 'reset',
        onclick: () => change({ ...Object.fromEntries(filters.map((name) => [name, null])), text: '', changed: compares ? 'all' : '' }),
    }, 'Show all');
    const shown = h('p.shown', { id: 'shown' }), only = h('p.only');
    const node = h('form.filters', { role: 'search', 'aria-label': 'Filter', onsubmit: (event) => event.preventDefault() },
        changed, picks.map((p) => p.node),
        h('fieldset.verdicts', {}, h('legend', {}, 'Verdict'), toggles),
        h('label.field', { htmlFor: 'text' }, 'Words', text),
        reset);
    const bar = {
        node,
        shown: [shown, only],
        state: null,
        /// Shows a state, and how much of the run it leaves.
        update(next, changedOnly, left) {
            bar.state = next;
            for (const p of picks) p.update(next[p.name]);
            for (const toggle of toggles)
                toggle.setAttribute('aria-pressed', String(next.verdict?.has(toggle.dataset.verdict) ?? false));
            changed?.setAttribute('aria-pressed', String(changedOnly));
            if (text.value !== next.text) text.value = next.text;
            const said = `${plural(left.rows, 'method')} on ${plural(left.profiles, 'chip')}: ` +
                `${plural(left.cells, 'cell')} of ${plural(left.all, 'cell').replace(/ cells?$/, '')}` +
                (next.verdict ? `, in entries whose worst verdict is ${[...next.verdict].join(' or ')}` : '');
            only.textContent = filterWords(next, changedOnly);
            if (shown.textContent && shown.textContent !== said) say(said);
            shown.textContent = said;
        },
    };
    return bar;
}

/// A set with `value` put in or taken out; null once it is empty.
function toggled(set, value) {
    const next = new Set(set ?? []);
    if (!next.delete(value)) next.add(value);
    return next.size ? next : null;
}

/// A list of boxes behind a button.
function pick(name, values, change) {
    const boxes = values.map((value) => h('input', { type: 'checkbox', value, onchange: () => changed() }));
    const changed = () => {
        const chosen = boxes.filter((box) => box.checked).map((box) => box.value);
        change({ [name]: chosen.length === boxes.length ? null : new Set(chosen) });
    };
    const setAll = (checked) => {
        for (const box of boxes) box.checked = checked;
        changed();
    };
    const count = h('span.count');
    const summary = h('summary', {}, titles[name], ' ', count);
    const node = h('details.pick', { 'data-list': name }, summary,
        h('fieldset.panel', {}, h('legend.unseen', {}, titles[name]),
            h('div.row', {},
                h('button', { type: 'button', onclick: () => setAll(true) }, 'All'),
                h('button', { type: 'button', onclick: () => setAll(false) }, 'None')),
            boxes.map((box) => h('label', {}, box, box.value))));
    node.addEventListener('keydown', (event) => {
        if (event.key !== 'Escape' || !node.open) return;
        node.open = false;
        summary.focus();
        event.stopPropagation();
    });
    node.addEventListener('focusout', (event) => {
        if (event.relatedTarget && !node.contains(event.relatedTarget)) node.open = false;
    });
    document.addEventListener('pointerdown', (event) => {
        if (!node.contains(event.target)) node.open = false;
    });
    return {
        name,
        node,
        update(set) {
            for (const box of boxes) box.checked = !set || set.has(box.value);
            const on = boxes.filter((box) => box.checked).length;
            count.textContent = on === boxes.length ? String(on) : `${on} of ${boxes.length}`;
            node.classList.toggle('narrowed', on !== boxes.length);
        },
    };
}
