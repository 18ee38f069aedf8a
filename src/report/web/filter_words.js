// The filters and the order in words: on paper nothing else tells of them.
import { splitSort } from './address.js';
import { figureNames } from './table.js';

const nouns = { profile: 'chip', method: 'method', scene: 'scene', size: 'size', frame: 'frame' };
const most = 8;  // names of a list

/// "Only: verdict wrong; words clamps; sorted by tnt, time ratio, best first."; empty where all is shown as the run has it.
/// @param changedOnly  whether only entries with a cell that changed are left
export function filterWords(state, changedOnly) {
    const only = [];
    if (changedOnly) only.push('what changed since the old run');
    for (const [name, noun] of Object.entries(nouns)) {
        if (!state[name]) continue;
        const { size } = state[name];
        only.push(size && size <= most ? `${noun}${size > 1 ? 's' : ''} ${[...state[name]].join(', ')}` : `${size || 'no'} ${noun}s`);
    }
    if (state.verdict) only.push(`verdict ${[...state.verdict].join(' or ')}`);
    if (state.text.trim()) only.push(`words ${state.text.trim()}`);
    const { column, way } = splitSort(state.sort);
    const order = !way ? '' : column ? `sorted by ${column}, ${figureNames[state.figure]}, ${way === 'up' ? 'best' : 'worst'} first`
        : `sorted by name${way === 'up' ? '' : ', last first'}`;
    if (!only.length) return order && `${order[0].toUpperCase()}${order.slice(1)}.`;
    return `Only: ${[...only, order].filter(Boolean).join('; ')}.`;
}
