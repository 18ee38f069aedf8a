// What the page says of a cell: its verdict in sentences, the command that draws it.
import { counted, plural } from './dom.js';

/// Sentences that explain a cell's verdict.
export function explanation(cells, cell) {
    const number = (name) => cells.number(name, cell);
    const verdict = cells.get('verdict', cell);
    if (verdict === 'refused') return ['The chip lacks what the passes of this method need, so nothing was drawn and nothing measured. What it lacks, and who says so, stands below.'];
    if (verdict === 'failed') return [`A fault of gnomon or of the driver: ${cells.get('error', cell) || 'no more is known'}.`];
    const edge = number('wrong.edge'), interior = number('wrong.interior');
    const sentences = [{
        exact: 'Every pixel that can be judged is lit or in shadow as exact ray tracing says.',
        edge: `${plural(edge, 'pixel')} ${edge === 1 ? 'is' : 'are'} wrong, all within one mask pixel of the true boundary of a shadow.`,
        wrong: `${plural(interior, 'pixel')} ${interior === 1 ? 'is' : 'are'} wrong away from the boundaries of shadows, a leak or a hole; ${counted(edge)} at them.`,
    }[verdict]];
    const truth = number('tied.truth'), count = number('tied.count');
    sentences.push(`Of ${plural(number('pixels'), 'pixel')}, ${counted(truth + count)} are tied and excused: for ${counted(truth)} truth itself changes within 1/256 pixel or one quantum of depth, for ${counted(count)} a face of a volume lies too close to the surface.`);
    const unpredicted = number('unpredicted');
    sentences.push(unpredicted
        ? `${plural(unpredicted, 'untied pixel')} of the mask hold what exact arithmetic doesn't allow: a fault of gnomon or of the driver.`
        : 'Every untied pixel of the mask holds what exact arithmetic predicts, so the verdict is the method\u2019s on this chip.');
    return sentences;
}

const axes = {
    store: '--store', arithmetic: '--arithmetic', levels: '--levels', count: '--count', silhouette: '--silhouette',
    mask_scale: '--mask-scale', apply: '--apply',
};
const options = {
    start: '--start', overflow: '--overflow', caps: '--caps', clip: '--clip', offset: '--offset', map_size: '--map-size', map_bias: '--map-bias',
};
const divisor = { 0.5: '1/2', 0.25: '1/4' };

/// A word as the shell takes it.
const quoted = (word) => (/^[\w./,:=+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

/// A number as it was written: a value of single precision stands in the run with more digits than it was given with.
export function numberText(number) {
    if (Number.isInteger(number) || Math.fround(number) !== number) return String(number);
    for (let digits = 1; ; ++digits) {
        const text = String(Number(number.toPrecision(digits)));
        if (Math.fround(Number(text)) === number) return text;
    }
}

/// A command about a cell's plan: scene, chip, method, size and frame.
function planWords(cells, cell, methods, command) {
    const get = (name) => cells.get(name, cell);
    const line = ['gnomon', command, get('scene'), '--profile', get('profile')];
    if (methods.some((method) => method.id === get('method') && method.source) || get('method') === 'auto') {
        line.push('--method', get('method'));
    } else {
        // Named by its axes.
        for (const [name, flag] of Object.entries(axes))
            if (get(name) !== undefined && get(name) !== null) line.push(flag, divisor[get(name)] ?? get(name));
    }
    for (const [name, flag] of Object.entries(options))
        if (get(name) !== undefined && get(name) !== null) line.push(flag, get(name));
    line.push(...unless(get('shade'), '--shade', 'attenuated'), '--size', cells.size(cell), '--frame', get('frame'));
    return line;
}

/// A flag with its value, where that is not the usual one.
const unless = (value, flag, usual) => (value !== undefined && value !== null && value !== usual ? [flag, value] : []);

/// How a cell's passes are told apart from the usual ones: what is simulated, and from where the scene is seen.
function viewWords(cells, cell) {
    const effects = cells.get('method', cell) === 'auto' ? [] : unless(cells.get('effects', cell), '--effects', 'full');
    return [...effects, ...Object.entries(cells.get('view', cell) ?? {}).flatMap(([flag, value]) => [`--${flag}`, value])];
}

const commandOf = (words) => words.map((word) => quoted(typeof word === 'number' ? numberText(word) : String(word))).join(' ');

/// The command that draws a cell.
export function renderCommand(cells, cell, methods) {
    const get = (name) => cells.get(name, cell);
    return commandOf([
        ...planWords(cells, cell, methods, 'render'),
        ...unless(get('fidelity'), '--fidelity', 'gl'), ...unless(get('dither'), '--dither', 'off'), ...unless(get('blend_unit'), '--blend-unit', ''),
        ...unless(get('device'), '--device', 'osmesa'), ...viewWords(cells, cell),
        '-o', 'image.png', '--mask', 'mask.png', '--truth', 'truth.png', '--steps', 'steps',
    ]);
}

/// The command that says why a cell is refused: render would only say that it is.
export const planCommand = (cells, cell, methods) => commandOf([...planWords(cells, cell, methods, 'plan'), ...viewWords(cells, cell)]);
