// The chips and the methods of a run, with their sources.
import { h } from './dom.js';

export function factsSection(run, shownProfiles) {
    const chips = run.profiles.filter((profile) => shownProfiles.includes(profile.id));
    return h('section.facts', { 'aria-labelledby': 'facts-title' }, h('h2', { id: 'facts-title' }, 'Chips and methods'),
        h('h3', {}, 'Chips'),
        chips.map((chip) => h('details', {}, h('summary', {}, h('b', {}, chip.id), ` ${[chip.name, chip.kind, chip.year].filter(Boolean).join(', ')}`),
            chip.limits?.length ? h('div.scroll', {}, h('table.plain', {},
                h('thead', {}, h('tr', {}, ['what', 'value', 'source', 'evidence'].map((name) => h('th', { scope: 'col' }, name)))),
                h('tbody', {}, chip.limits.map((limit) => h('tr', {}, [limit.what, limit.value, limit.source, limit.grade].map((value) => h('td', {}, value ?? '')))))))
                : h('p.muted', {}, 'No limits are written down.'))),
        h('h3', {}, 'Methods'),
        h('div.scroll', { tabIndex: 0, role: 'group', 'aria-label': 'Methods' }, h('table.plain', {},
            h('thead', {}, h('tr', {}, ['method', 'store', 'arithmetic', 'count', 'silhouette', 'mask', 'apply', 'source'].map((name) => h('th', { scope: 'col' }, name)))),
            h('tbody', {}, run.methods.map((m) => h('tr', {}, h('th', { scope: 'row' }, m.id),
                [m.store, m.arithmetic, m.count, m.silhouette, m.mask_scale, m.apply, m.source].map((value) => h('td', {}, value ?? ''))))))));
}
