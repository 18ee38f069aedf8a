// What stands above the page: what was run, in words, and the answer in a few sentences.
import { counted, h, plural, symbolOf } from './dom.js';
import { verdicts } from './run.js';

const several = (number, one, many) => (number === 1 ? one : `${counted(number)} ${many}`);

/// "heidmann on 41 graphics chips, in 3 scenes of 12 frames: 1 476 cells"
export function runInWords(run, cells) {
    const methods = several(run.methods.length, `The method ${run.methods[0]?.id}`, 'shadow methods');
    const chips = several(run.profiles.length, run.profiles[0]?.name ?? run.profiles[0]?.id, 'graphics chips');
    const scenes = several(run.scenes.length, `the scene ${run.scenes[0]?.id}`, 'scenes');
    const numbers = run.scenes.map((scene) => scene.frames.length), most = Math.max(...numbers);
    const frames = `${numbers.some((n) => n !== most) ? 'up to ' : ''}${several(most, 'one frame', 'frames')}`;
    return `${methods} on ${chips}, in ${scenes} of ${frames}: ${plural(cells.count, 'cell')}`;
}

/// "a", "a and b", "a, b and c"; of more than four their number
function listed(names, what) {
    if (names.length > 4) return `${counted(names.length)} ${what}`;
    return names.length < 2 ? names.join('') : `${names.slice(0, -1).join(', ')} and ${names.at(-1)}`;
}

/// The answer in sentences: the methods that are exact on most chips, chips without any, faults.
/// @param whole  of table(), of all cells
export function answerOf(run, cells, whole) {
    const idle = new Set(run.methods.filter((method) => method.store === 'none').map((method) => method.id));
    const rows = new Map(), chips = new Set();
    for (const entry of whole.all()) {
        if (entry.verdict !== 'exact' || idle.has(entry.method)) continue;
        rows.set(entry.row, (rows.get(entry.row) ?? 0) + 1);
        chips.add(entry.profile);
    }
    const number = whole.profiles.length, most = Math.max(0, ...rows.values());
    const best = [...rows.keys()].filter((row) => rows.get(row) === most);
    const without = whole.profiles.filter((profile) => !chips.has(profile));
    const where = number === 1 ? whole.profiles[0] : `${counted(most)} of ${plural(number, 'chip')}`;
    const sentences = [];
    if (most) sentences.push(`${listed(best, 'methods')} ${best.length === 1 ? 'is' : 'are'} exact in every scene and frame on ${where}${number > 1 && best.length < rows.size ? ', more than any other method' : ''}.`);
    if (!most) sentences.push('No method is exact in every scene and frame on any chip.');
    else if (number > 1) sentences.push(without.length ? `On ${listed(without, 'chips')} none is.` : 'Every chip has one that is.');
    return [...sentences, ...faultsOf(run, cells)];
}

/// What went wrong with the run or with its report.
function faultsOf(run, cells) {
    let failed = 0, differing = 0, undrawn = 0;
    for (let cell = 0; cell < cells.count; ++cell) {
        failed += cells.get('verdict', cell) === 'failed';
        const drawing = run.drawings[cells.get('drawing', cell) ?? -1];
        differing += Boolean(drawing?.differs?.length);
        undrawn += Boolean(drawing?.error);
    }
    return [
        failed && `${plural(failed, 'cell')} failed, by a fault of gnomon or of the driver.`,
        differing && `${plural(differing, 'cell')} came out otherwise than in the run when drawn again for this report.`,
        undrawn && `${plural(undrawn, 'cell')} could not be drawn again for this report.`,
    ].filter(Boolean);
}

/// How many cells have each verdict.
export function verdictCounts(cells) {
    const counts = Object.fromEntries(verdicts.map((verdict) => [verdict, 0]));
    for (let cell = 0; cell < cells.count; ++cell) ++counts[cells.get('verdict', cell)];
    return h('p.summary', {}, h('span.muted', {}, 'Cells:'), verdicts.filter((verdict) => counts[verdict]).map((verdict) => h(`span.badge.${verdict}`, {}, symbolOf(verdict), `${counted(counts[verdict])} ${verdict}`)));
}
