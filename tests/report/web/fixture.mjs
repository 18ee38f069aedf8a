// A made-up run in the form that the page reads: several chips, methods, scenes, and pictures of all kinds and bases.
// Figures in it are arithmetic, not results.
import { deflateRawSync } from 'node:zlib';

const chips = [
    ['ideal', 'No limits', 'reference', null], ['voodoo2', '3dfx Voodoo2', 'PC card', 1998], ['i740', 'Intel i740', 'PC card', 1998],
    ['tnt', 'NVIDIA RIVA TNT', 'PC card', 1998], ['ps2', 'Sony PlayStation 2', 'console', 2000],
];
const methodRows = [
    ['none', 'none', '-', '-'], ['heidmann', 'stencil', 'count', 'zpass'], ['carmack', 'stencil', 'count', 'zfail'],
    ['roettger-screen', 'screen', 'double', 'zpass-cap'], ['roettger-alpha', 'alpha', 'double', 'zpass-cap'],
    ['roettger-screen-max', 'screen', 'halve', 'zpass-cap'], ['roettger-half', 'screen', 'double', 'zpass-cap'], ['williams', 'depth-map', '-', '-'],
];
const causes = [{ name: 'mask clamps', colour: '#e69f00' }, { name: 'low mask resolution', colour: '#56b4e9' }, { name: 'no shadow is drawn', colour: '#cc79a7' }];

/// Numbers from 0 to 1 that look random and are always the same.
function numbers(seed) {
    let state = seed >>> 0;
    return () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state / 2 ** 32;
    };
}

/// Columns as the contract has them: texts and objects in a dictionary, plain numbers as they are.
function columnsOf(cells) {
    const columns = {};
    for (const name of new Set(cells.flatMap(Object.keys))) {
        const values = cells.map((cell) => cell[name] ?? null);
        if (values.every((value) => typeof value === 'number' || typeof value === 'boolean')) {
            columns[name] = { values };
            continue;
        }
        const keys = values.map((value) => JSON.stringify(value));
        const dictionary = [...new Set(keys)];
        const codes = new Map(dictionary.map((key, i) => [key, i]));
        columns[name] = { dictionary: dictionary.map((key) => JSON.parse(key)), values: keys.map((key) => codes.get(key)) };
    }
    return columns;
}

/// Pictures as the report stores them, chunk by chunk.
export class PictureWriter {
    constructor() {
        this.list = [], this.plain = [], this.chunks = [[]];
    }
    newChunk() {
        this.chunks.push([]);
    }
    /// @param data  plane after plane
    /// @return      its index
    add(kind, width, height, data, base = -1) {
        const planes = kind === 'rgb' ? 3 : 1;
        const stored = Uint8Array.from(data, (value, i) =>
            base >= 0 ? value ^ this.plain[base][i] : i % width === 0 ? value : value - data[i - 1]);
        const chunk = this.chunks.length - 1;
        const offset = this.chunks[chunk].reduce((sum, bytes) => sum + bytes.length, 0);
        this.chunks[chunk].push(stored);
        this.plain.push(Uint8Array.from(data));
        this.list.push({ chunk, offset, width, height, planes, kind, base });
        return this.list.length - 1;
    }
    block() {
        const head = [], parts = [];
        let offset = 0;
        for (const chunk of this.chunks) {
            const bytes = Buffer.concat(chunk), packed = deflateRawSync(bytes);
            head.push({ offset, size: packed.length, length: bytes.length });
            parts.push(packed);
            offset += packed.length;
        }
        return { head, bytes: Buffer.concat(parts) };
    }
}

/// The value of every pixel by a function of (x, y, plane).
const painted = (width, height, planes, value) => {
    const data = new Uint8Array(width * height * planes);
    for (let p = 0; p < planes; ++p) for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) data[(p * height + y) * width + x] = value(x, y, p);
    return data;
};

/// All pictures of one drawing, and its film strip.
function drawing(writer, width, height, wrong) {
    const inside = (x, y, cx) => (x - width * cx) ** 2 + (y - height * 0.6) ** 2 < (height * 0.26) ** 2;
    const shadow = (x, y) => inside(x, y, 0.4) || inside(x, y, 0.6);
    const truth = painted(width, height, 1, (x, y) => (shadow(x, y) ? 0 : 255));
    const mask = painted(width, height, 1, (x, y) => (shadow(x, y) !== (wrong && inside(x, y, 0.4) && inside(x, y, 0.6)) ? 0 : 255));
    const image = painted(width, height, 3, (x, y, p) => Math.round((60 + 120 * (y / height) + 30 * p) * (mask[y * width + x] ? 1 : 0.45)));
    const cause = painted(width, height, 1, (x, y) => (mask[y * width + x] === truth[y * width + x] ? 0 : 1 + (x > width / 2)));
    const difference = painted(width, height, 1, (x, y) => Math.abs(mask[y * width + x] - truth[y * width + x]));
    const pictures = { truth: writer.add('grey', width, height, truth) };
    pictures.mask = writer.add('grey', width, height, mask, pictures.truth);
    pictures.image = writer.add('rgb', width, height, image);
    pictures.causes = writer.add('cause', width, height, cause);
    pictures.difference = writer.add('grey', width, height, difference);
    const { truth: t, mask: m, image: i, causes: c, difference: d } = pictures;
    const strip = [];
    let last = [-1, -1];
    for (let pass = 1; pass <= 6; ++pass) {
        const count = painted(width, height, 1, (x, y) => (pass > 2 && inside(x, y, 0.4) ? 1 : 0) + (pass > 4 && inside(x, y, 0.6) ? 1 : 0));
        const colour = painted(width, height, 3, (x, y, p) => (pass === 1 ? 30 : Math.round(60 + 120 * (y / height) + 30 * p)));
        // A base of a base: two steps at most.
        last = [writer.add('rgb', width, height, colour, pass === 3 ? last[0] : -1), writer.add('count', width, height, count, pass % 3 ? -1 : last[1])];
        strip.push({ pass, title: ['background', 'scene: lit', 'front faces of volume 0', 'back faces of volume 0', 'front faces of volume 1', 'the mask over the scene'][pass - 1],
            why: `reason ${pass}`, buffers: { colour: last[0], stencil: last[1] } });
    }
    return { width, height, chunk: writer.chunks.length - 1, frame: 0, pictures: { image: i, mask: m, truth: t, causes: c, difference: d }, strip };
}

const lacks = (...whats) => whats.map((what) => ({ capability: what, what, source: 'a source' }));
const refusals = { heidmann: ['voodoo2', 'i740', 'ps2'], carmack: ['voodoo2', 'i740', 'ps2'], 'roettger-alpha': ['voodoo2', 'i740'], 'roettger-screen-max': ['voodoo2', 'i740', 'tnt'] };

/// @param size  {chips, scenes, frames}: how many; more chips than there are get made-up names
/// @return      {run, pictures}: the object of the contract, and its pictures
export function makeRun({ chipCount = chips.length, methodCount = methodRows.length, scenes = ['boxes', 'hard/eye & light'], frames = 3, withCompare = false, only = () => true } = {}) {
    const random = numbers(7), writer = new PictureWriter();
    const allChips = Array.from({ length: chipCount }, (_, i) => chips[i] ?? [`chip${i}`, `Chip number ${i}`, 'PC card', 1999]);
    const allMethods = Array.from({ length: methodCount }, (_, i) => methodRows[i] ?? [`method${i}`, 'stencil', 'count', 'zpass']);
    const drawings = [drawing(writer, 48, 36, true)];
    writer.newChunk();
    drawings.push(drawing(writer, 48, 36, false));
    const cells = [];
    for (const [profile] of allChips) for (const [method, store, arithmetic, count] of allMethods) for (const scene of scenes) for (let frame = 0; frame < frames; ++frame) {
        const refused = refusals[method]?.includes(profile);
        const verdict = refused ? 'refused' : method === 'none' || (method === 'williams' && frame > 0) ? 'wrong' : method === 'roettger-half' ? 'edge' : method === 'carmack' && profile === 'tnt' && frame === 2 ? 'failed' : 'exact';
        const wrong = { wrong: 40 + frame, edge: 12 }[verdict] ?? 0;
        const drawn = !refused && verdict !== 'failed';
        const cause = method === 'none' ? 'no shadow is drawn' : method === 'williams' ? 'mask clamps' : 'low mask resolution';
        const cell = {
            profile, method, scene, store, arithmetic, count, silhouette: 'winding', mask_scale: method === 'roettger-half' ? 0.5 : 1, apply: 'blend', shade: 'attenuated',
            width: 48, height: 36, frame, lights: 1, fidelity: 'gl', device: 'osmesa', effects: 'full', verdict, chosen: method === 'roettger-screen' && !['ideal', 'tnt'].includes(profile),
            missing: refused ? [{ capability: 'stencil', what: store === 'stencil' ? 'stencil' : 'blend equation max', source: 'M-TDFX: Napalm only' }, { capability: 'beside', what: 'destination alpha beside depth', source: 'MAME (as SST-1)' }] : [],
            causes: wrong ? { [cause]: wrong } : {},
            'passes.scene': method === 'heidmann' ? 1 + 6 * frame : store === 'stencil' ? 1 : 2, 'passes.volume': 24, 'passes.rectangle': store === 'screen' ? 3 : 1, 'passes.copy': 0, 'nesting.fronts': drawn ? 2 : 0,
            pixels: drawn ? 1728 : 0, 'tied.truth': drawn ? 5 : 0, 'tied.count': drawn ? 2 : 0, 'wrong.edge': verdict === 'edge' ? wrong : 0, 'wrong.interior': verdict === 'wrong' ? wrong : 0,
            unpredicted: 0, warnings: method === 'roettger-alpha' ? ['resolves 2 levels; up to 4 volumes may nest'] : [], vertices: 1056, clock: 'thread',
            cpu_ms: drawn ? Math.round(1000 * (0.9 + 3 * random() * (1 + cells.length % 5))) / 1000 : 0, unshadowed_ms: drawn ? 0.7 : 0, digest: '6c6f355706f7a9f6',
            drawing: frame === 0 && drawn && scene === scenes[0] ? (wrong ? 0 : 1) : -1,
            plan: refused ? null : `pass  draws  what\n1     clear  background\n      why: the background shows where no surface is (${method})\n`,
        };
        if (verdict === 'failed') cell.error = 'GL_INVALID_OPERATION after glDrawArrays';
        if (only(cell)) cells.push(cell);
    }
    const run = {
        format: 1, command: 'gnomon matrix boxes', program: 'gnomon 0.1.0',
        profiles: allChips.map(([id, name, kind, year]) => ({ id, name, kind, ...(year ? { year } : {}), limits: [{ what: 'stencil', value: id === 'tnt' ? '8' : 'no', source: 'M-TDFX; Napalm only', grade: 'emulator' }, { what: 'depth_functions', value: 'never, less, equal, lequal, greater, notequal, gequal, always', source: 'GL-H3 glide2x/gglide.c:329,glide3x/gglide.c:483', grade: 'driver' }] })),
        methods: allMethods.map(([id, store, arithmetic, count]) => ({ id, store, arithmetic, count, silhouette: 'winding', mask_scale: '1', apply: 'blend', shade: 'attenuated', source: 'made up' })),
        scenes: scenes.map((id) => ({ id, frames: Array.from({ length: frames }, (_, i) => i) })),
        cells: { count: cells.length, columns: columnsOf(cells) }, drawings, causes, pictures: writer.list,
        states: [{ profile: 'voodoo2', method: 'roettger-screen, in six bits and with the dither of its driver', title: 'double in 6 bits, up to 2 volumes open', nodes: [{ id: 's16', label: '16', kind: 'start, lit or in shadow' }, { id: 's31', label: '31', kind: 'in shadow' }, { id: 's15', label: '15' }, { id: 's8', label: '8' }],
            edges: [{ from: 's16', to: 's31', label: 'front face' }, { from: 's31', to: 's31', label: 'front face' }, { from: 's31', to: 's15', label: 'back face' }, { from: 's16', to: 's8', label: 'back face' }] }],
        compare: !withCompare ? null : {
            old: { command: 'gnomon matrix boxes', program: 'gnomon 0.0.9' },
            changes: [
                { cause: 'verdict: exact -> edge', cells: [{ cell: 'tnt/roettger-half/boxes/48x36/0', old: { verdict: 'exact', wrong: { edge: 0, interior: 0 } }, new: { verdict: 'edge', wrong: { edge: 12, interior: 0 } } }] },
                { cause: 'verdict: wrong -> exact', cells: [{ cell: 'tnt/heidmann/boxes/48x36/1', old: { verdict: 'wrong', 'wrong.interior': 7 }, new: { verdict: 'exact', 'wrong.interior': 0 } }] },
                { cause: 'limits: stencil, old lack -> stencil, destination alpha beside depth', cells: [{ cell: 'voodoo2/heidmann/boxes/48x36/0', old: { missing: lacks('stencil', 'old lack') }, new: { missing: lacks('stencil', 'destination alpha beside depth') } }] },
                { cause: 'only in the new run', cells: [{ cell: 'tnt/williams/boxes/48x36/0', old: null, new: { verdict: 'exact' } }] },
                { cause: 'only in the old run', cells: [{ cell: 'tnt/gone/boxes/48x36/0', old: { verdict: 'exact' }, new: null }] },
            ],
        },
    };
    return { run, pictures: writer };
}

/// The report of a run: the page with its three blocks.
export function makeReport(page, { run, pictures }) {
    const text = Buffer.from(JSON.stringify(run)), block = pictures.block();
    const head = { format: 1, run: { length: text.length }, chunks: block.head };
    const blocks = [
        `<script type="application/json" id="gnomon-head">${JSON.stringify(head)}</script>`,
        `<script type="text/plain" id="gnomon-run">${deflateRawSync(text).toString('base64')}</script>`,
        `<script type="text/plain" id="gnomon-pictures">${block.bytes.toString('base64')}</script>`,
    ];
    return page.replace('<!-- gnomon:data -->', () => blocks.join('\n'));
}

/// What the pictures hold, to compare with what the page shows.
export const plainPicture = (made, index) => made.pictures.plain[index];
