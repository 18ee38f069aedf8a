// The page's modules without a browser.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { exclusiveOr, undoDifferences } from '../../../src/report/web/decode.js';
import { mendView, readAddress } from '../../../src/report/web/address.js';
import { changeKinds } from '../../../src/report/web/compare.js';
import { changeWords, differences } from '../../../src/report/web/change_words.js';
import { filterWords } from '../../../src/report/web/filter_words.js';
import { placeLabels, spreadLabels, widthOf } from '../../../src/report/web/labels.js';
import { slices } from '../../../src/report/web/paper.js';
import { accuracyRows, passRows } from '../../../src/report/web/plot_specs.js';
import { Cells, median, nearestMate, table, verdicts } from '../../../src/report/web/run.js';
import { csvOf } from '../../../src/report/web/save.js';
import { hashOf, initialState, keeper, stateOf } from '../../../src/report/web/state.js';
import { sentenceOf, sortedLines, tableRows } from '../../../src/report/web/table.js';
import { numberText, planCommand, renderCommand } from '../../../src/report/web/words.js';
import { makeRun } from './fixture.mjs';

const { run } = makeRun();
const cells = new Cells(run.cells);

describe('report modules', () => {
    it('rows of differences and exclusive-or come back', () => {
        assert.deepEqual([...undoDifferences(Uint8Array.from([250, 10, 255, 1, 0, 2]), 3)], [250, 4, 3, 1, 1, 3]);
        assert.deepEqual([...exclusiveOr(Uint8Array.from([1, 255]), Uint8Array.from([3, 15]))], [2, 240]);
    });

    it('filters and order in words', () => {
        const words = (news, changedOnly = false) => filterWords({ ...initialState(), ...news }, changedOnly);
        assert.equal(words({}), '');
        assert.equal(words({ sort: ':down' }), 'Sorted by name, last first.');
        assert.equal(words({ profile: new Set(['tnt', 'ps2']), frame: new Set(['1']), verdict: new Set(['wrong', 'edge']), text: ' max ', sort: 'tnt:down' }, true),
            'Only: what changed since the old run; chips tnt, ps2; frame 1; verdict wrong or edge; words max; sorted by tnt, verdict, worst first.');
        assert.equal(words({ method: new Set(), scene: new Set('abcdefghi') }), 'Only: no methods; 9 scenes.');
    });

    it('the address holds the whole state', () => {
        const state = { ...initialState(), profile: new Set(['tnt', 'a,b&c=d']), verdict: new Set(['wrong']), frame: new Set(['0', '11']), text: 'max & 50 %',
            sort: 'geforce2mx-565:down', mark: new Set(['carmack']), changed: 'all', cell: 'tnt/none/hard/eye & light/48x36/0', pair: 'image,causes', divider: '20', zoom: '12', pixel: '3,4', pass: '5', buffer: 'stencil', 'pass-zoom': '8', 'pass-pixel': '1,2' };
        assert.deepEqual(stateOf(hashOf(state)), { state, unknown: [] });
        assert.equal(hashOf(initialState()), '');
        assert.deepEqual(stateOf(''), { state: initialState(), unknown: [] });
        // How a cell is looked at says nothing without it.
        assert.equal(hashOf({ ...initialState(), pair: 'image,causes', pixel: '3,4' }), '');
        assert.match(hashOf(state), /^#cell=tnt\/none\/hard\/eye%20%26%20light\/48x36\/0&/);
        // What somebody mistyped does no harm.
        assert.deepEqual(stateOf('#nonsense=1&%'), { state: initialState(), unknown: ['nonsense=1', '%'] });
        assert.equal(stateOf('#text=50%').state.text, '50%');
    });

    const known = { profile: ['tnt', 'ps2'], method: ['none'], scene: ['boxes'], size: ['48x36'], frame: ['0', '1'], verdict: verdicts, mark: ['none'], chip: ['tnt'], path: ['boxes'], figure: ['verdict'], across: ['profiles'], look: ['figures'], changed: ['only', 'all'] };
    for (const [hash, kept, fault] of [
        ['#profile=nonsense', {}, /profile=nonsense: the run has no such chip/],
        ['#profile=nonsense,tnt', { profile: new Set(['tnt']) }, /profile=nonsense/],
        ['#verdict=foo&text=a', { text: 'a' }, /verdict=foo: the run has no such verdict/],
        ['#frame=7', {}, /frame=7/], ['#mark=carmack', {}, /mark=carmack/], ['#chip=ps3', {}, /chip=ps3/], ['#path=sea', {}, /path=sea: the run has no such scene/],
        ['#sort=tnt2:up', {}, /sort=tnt2:up: the table has no such column/], ['#sort=tnt', {}, /sort=tnt: it must end/], ['#sort=tnt:up', { sort: 'tnt:up' }, null],
        ['#sort=:down', { sort: ':down' }, null], ['#figure=size', {}, /figure=size: known are verdict/], ['#across=x', {}, /across=x/], ['#look=x', {}, /look=x/], ['#changed=no', {}, /changed=no: known are only, all/],
        ['#answer', {}, /\u201canswer\u201d, which means nothing/], ['#shade=black&text=b', { text: 'b' }, /shade=black/], ['#pixel=1,2', {}, /pixel=1,2: it belongs to a cell/],
        ['#profile=', { profile: new Set() }, null],
    ])
        it(`the address ${hash} ${fault ? 'is named as wrong, and its rest holds' : 'holds'}`, () => {
            const { state, faults } = readAddress(hash, known);
            assert.deepEqual(state, { ...initialState(), ...kept });
            assert.equal(faults.length, fault ? 1 : 0, faults.join());
            if (fault) assert.match(faults[0], fault);
        });

    const drawing = { pictures: { mask: 0, truth: 1, image: 2 }, strip: [{ pass: 1, buffers: { colour: 0 } }, { pass: 2, buffers: { colour: 0, stencil: 1 } }] };
    for (const [name, good, bad, fault] of [
        ['pair', 'image,mask', 'image,nothing', /two of mask, truth, image/], ['pair', 'mask,mask', 'mask', /two of/], ['divider', '0', '101', /0 to 100/], ['zoom', '12.5', '-1', /up to 128/],
        ['zoom', '128', '129', /up to 128/], ['pixel', '47,35', '48,0', /48\u00d736/], ['pixel', '0,0', '1;2', /two whole numbers/], ['pass', '2', '3', /from 1 to 2, 2 of them/], ['buffer', 'stencil', 'depth', /colour, stencil/],
        ['pass-zoom', '4', '0', /up to 128/], ['pass-pixel', '1,1', '1,36', /48\u00d736/],
    ])
        it(`of a cell's view ${name}=${good} holds and ${name}=${bad} is named`, () => {
            const size = { width: 48, height: 36 }, right = { ...initialState(), [name]: good }, wrong = { ...initialState(), [name]: bad }, without = { ...initialState(), [name]: good };
            assert.deepEqual([mendView(right, drawing, size), right[name]], [[], good]);
            const [said] = mendView(wrong, drawing, size);
            assert.match(said, fault);
            assert.ok(said.includes(`${name}=${bad}`));
            assert.equal(wrong[name], initialState()[name]);
            assert.match(mendView(without, null, size)[0], /keeps no/);
        });

    it('the worst verdict counts and wrong pixels add up', () => {
        for (const keep of [() => true, keeper(cells, { ...initialState(), scene: new Set(['boxes']), frame: new Set(['0', '2']) })])
            for (const entry of table(cells, keep).all()) {
                const mine = Array.from({ length: cells.count }, (_, i) => i).filter((i) => keep(i) && cells.get('profile', i) === entry.profile && cells.get('method', i) === entry.method);
                assert.deepEqual(entry.cells, mine);
                assert.equal(entry.wrong, mine.reduce((sum, i) => sum + cells.get('wrong.edge', i) + cells.get('wrong.interior', i), 0));
                assert.equal(entry.rank, Math.max(...mine.map((i) => verdicts.indexOf(cells.get('verdict', i)))));
                assert.equal(cells.get('verdict', entry.worst), entry.verdict);
            }
    });

    it('a cell is found by its name, and a second of one name is told apart', () => {
        for (let cell = 0; cell < cells.count; cell += 17) assert.equal(cells.find(cells.id(cell)), cell);
        assert.equal(cells.find('no/such/cell'), -1);
        const twice = new Cells({ count: 2, columns: { profile: { dictionary: ['a'], values: [0, 0] }, method: { dictionary: ['b'], values: [0, 0] }, scene: { dictionary: ['c'], values: [0, 0] }, width: { values: [1, 1] }, height: { values: [1, 1] }, frame: { values: [0, 0] } } });
        assert.deepEqual([twice.id(0), twice.id(1), twice.find('a/b/c/1x1/0~2')], ['a/b/c/1x1/0', 'a/b/c/1x1/0~2', 1]);
    });

    it('fidelities of one run stand in rows of their own', () => {
        const plain = (values) => ({ dictionary: values, values: values.map((_, i) => i) });
        const both = new Cells({ count: 2, columns: { profile: plain(['a', 'a']), method: plain(['b', 'b']), shade: plain(['black', 'attenuated']), fidelity: plain(['gl', 'chip']), verdict: plain(['exact', 'wrong']) } });
        assert.deepEqual(table(both, () => true).all().map((e) => [e.row, e.verdict]), [['b black gl', 'exact'], ['b chip', 'wrong']]);
    });

    it('median', () => {
        assert.equal(median([3, 1, 2]), 2);
        assert.equal(median([4, 1, NaN, 2, 3]), 2.5);
        assert.ok(Number.isNaN(median([NaN])));
    });

    it('sorting keeps what is not there last, whichever way', () => {
        const entries = { a: { rank: 1, wrong: 5, passes: {}, ratio: 1 }, b: null, c: { rank: 0, wrong: 0, passes: {}, ratio: 2 } };
        const order = (sort, figure = 'verdict') => sortedLines(['a', 'b', 'c'], (line) => entries[line], { sort, figure }).join('');
        assert.deepEqual([order(''), order('x:up'), order('x:down'), order('x:up', 'ratio'), order(':down')], ['abc', 'cab', 'acb', 'acb', 'cba']);
    });

    it('sorting by passes goes by the most, and by ratio then by verdict', () => {
        const entry = (verdict, scene, ratio) => ({ verdict, rank: verdicts.indexOf(verdict), wrong: 0, passes: { scene, rectangle: [0, 0] }, ratio });
        const entries = { a: entry('exact', [1, 13], NaN), b: entry('wrong', [2, 3], 2), c: entry('edge', [4, 4], 2), d: entry('exact', [1, 4], 2.5), e: entry('refused', null, NaN) };
        const order = (sort, figure) => sortedLines(Object.keys(entries), (line) => entries[line], { sort, figure }).join('');
        assert.equal(order('x:up', 'passes'), 'bdcae');
        assert.equal(order('x:up', 'ratio'), 'cbdae');
        assert.equal(order('x:down', 'ratio').slice(-3), 'dbc');
    });

    const passing = (passes, verdict = ['exact', 'exact', 'refused']) => new Cells({ count: 3, columns: {
        ...Object.fromEntries(['profile', 'method', 'scene'].map((name) => [name, { dictionary: [name[0]], values: [0, 0, 0] }])), verdict: { dictionary: verdict, values: [0, 1, 2] },
        frame: { values: [0, 1, 2] }, ...Object.fromEntries(['scene', 'volume', 'rectangle', 'copy'].map((kind) => [`passes.${kind}`, { values: passes[kind] ?? [0, 0, 0] }])),
    } });
    it('passes that differ over frames are a range, in words and in CSV; a refused frame counts none', () => {
        const [entry] = table(passing({ scene: [13, 1, 0], rectangle: [4, 4, 0] }), () => true).all();
        assert.deepEqual(entry.passes, { scene: [1, 13], volume: [0, 0], rectangle: [4, 4], copy: [0, 0] });
        assert.match(sentenceOf({ ...entry, verdict: 'exact' }), /, 1 to 13 scene passes, 4 rectangles/);
        const [row] = tableRows({ all: () => [entry] });
        assert.deepEqual([row.scene_passes_min, row.scene_passes_max, row.rectangles_min, row.rectangles_max], [1, 13, 4, 4]);
        const rows = passRows({ rows: ['m'], entry: () => ({ ...entry, verdict: 'exact' }) }, 'p', ['a', 'b']);
        assert.deepEqual(rows[0], { profile: 'p', scenes: 'a; b', method: 'm', kind: 'scene', fewest: 1, most: 13 });
    });

    it('of what was refused everywhere the table as CSV has no figures', () => {
        const [entry] = table(passing({}, ['refused', 'refused', 'refused']), () => true).all();
        const [row] = tableRows({ all: () => [entry] });
        for (const name of ['scene_passes_min', 'volume_passes_max', 'wrong_edge', 'wrong_interior', 'tied', 'pixels']) assert.equal(row[name] ?? null, null, name);
    });

    it('where a frame has no pictures the nearest of its scene is offered, else another scene is named', () => {
        const at = (values) => ({ values });
        const frames = new Cells({ count: 5, columns: { scene: { dictionary: ['a', 'b'], values: [1, 0, 0, 0, 1] }, frame: at([3, 0, 3, 9, 0]), width: at([1, 1, 1, 1, 1]), height: at([1, 1, 1, 1, 1]) } });
        assert.deepEqual(nearestMate(frames, 2, [0, 1, 3]), { mate: 1, isSame: true });
        assert.deepEqual(nearestMate(frames, 2, [4, 0]), { mate: 0, isSame: false });
        assert.deepEqual(nearestMate(frames, 2, []), { mate: -1, isSame: false });
    });

    it('names stand beside each other, never over each other or a line', () => {
        const points = Array.from({ length: 24 }, (_, i) => ({ name: `roettger-${i}`, x: 200 + 6 * i, y: 300 }));
        const line = { left: 0, right: 600, top: 200, bottom: 204 };
        const boxes = placeLabels(points, { width: 600, height: 320 }, [line]).map(({ name, left, middle }) => ({ name, left, right: left + widthOf(name), top: middle - 7, bottom: middle + 7 }));
        assert.equal(boxes.length, 24);
        for (const a of [...boxes, line]) for (const b of boxes) assert.ok(a === b || a.left >= b.right || b.left >= a.right || a.top >= b.bottom || b.top >= a.bottom, `${a.name} ${b.name}`);
        const middles = spreadLabels(points, 330).map(({ middle }) => middle);
        middles.forEach((middle, i) => assert.ok(middle >= 0 && middle <= 330 && (i === 0 || middle - middles[i - 1] > 13)));
    });

    it('paper has the table in pieces, each column once', () => {
        const all = { rows: ['m'], profiles: Array.from({ length: 41 }, (_, i) => `p${i}`) };
        const pieces = slices(all, { across: 'profiles', look: 'figures' });
        assert.deepEqual(pieces.flatMap((piece) => piece.profiles), all.profiles);
        assert.ok(pieces.every((piece) => piece.profiles.length <= 11));
        assert.equal(slices(all, { across: 'methods', look: 'figures' }).length, 1);
    });

    it('on the frontier nothing is both faster and more exact', () => {
        const all = table(cells, () => true).all();
        const shown = { rows: run.methods.map((m) => m.id), entry: (row, profile) => all.find((e) => e.row === row && e.profile === profile) };
        const rows = accuracyRows(shown, 'ideal', ['boxes']);
        assert.ok(rows.length > 5);
        for (const row of rows) {
            const beaten = rows.some((other) => other !== row && other.time_ratio <= row.time_ratio && other.wrong_percent <= row.wrong_percent && (other.time_ratio < row.time_ratio || other.wrong_percent < row.wrong_percent));
            assert.equal(row.frontier, !beaten, row.method);
        }
    });

    it('CSV quotes what must be quoted', () => {
        assert.equal(csvOf([{ a: 'x,y', b: 'say "no"', c: null }, { a: 1.5, b: NaN, c: true }]), 'a,b,c\r\n"x,y","say ""no""",\r\n1.5,,true\r\n');
        assert.equal(csvOf([]), '');
    });

    it('differences name what changed, nested ones with a dot', () => {
        assert.deepEqual(differences({ verdict: 'exact', wrong: { edge: 0, interior: 1 }, same: [1] }, { verdict: 'edge', wrong: { edge: 3, interior: 1 }, same: [1], more: 1 }),
            [{ key: 'verdict', before: 'exact', after: 'edge' }, { key: 'wrong.edge', before: 0, after: 3 }, { key: 'more', before: undefined, after: 1 }]);
    });

    it('groups of changes with the same words are one', () => {
        const lack = (...whats) => ({ missing: whats.map((what) => ({ what, capability: what, source: '' })) });
        const changes = ['a', 'b'].map((other) => ({ cause: `limits: old, ${other} -> ${other}`, cells: [{ cell: other, old: lack('old', other), new: lack(other) }] }));
        const [kind] = changeKinds({ changes });
        assert.deepEqual([kind.number, kind.groups.map(({ words, cells: list }) => [words, list.length])], [2, [['lacks no more: old', 2]]]);
    });

    it('a number of single precision is written as it was given', () => {
        assert.deepEqual([Math.fround(0.02), 0.5, 3, 0.7, Math.fround(1 / 3)].map(numberText), ['0.02', '0.5', '3', '0.7', '0.33333334']);
    });

    it('changes of what is missing are words, source by source', () => {
        const lack = (what, source = 'S') => ({ capability: what, what, source });
        const words = changeWords({ old: { missing: [lack('stencil'), lack('alpha', 'A')] }, new: { missing: [lack('alpha', 'B'), lack('depth')] } });
        assert.deepEqual(words.map(({ what, text }) => `${what}: ${text}`), ['lacks now: depth', 'lacks no more: stencil', 'source of \u201calpha\u201d: A \u2192 B']);
        assert.deepEqual(changeWords({ old: { causes: {}, warnings: ['a'], digest: '1' }, new: { causes: { 'mask clamps': 3 }, warnings: [], digest: '2' } }).map(({ what, text }) => `${what}: ${text}`),
            ['wrong pixels, mask clamps: none \u2192 3', 'warns no more: a', ': another image or mask']);
    });

    it('the command names a method by its axes where it has no row, and quotes for the shell', () => {
        const one = (values) => new Cells({ count: 1, columns: Object.fromEntries(Object.entries(values).map(([name, value]) => [name, { dictionary: [value], values: [0] }])) });
        const axes = { profile: 'tnt', method: 'stencil-count-zfail', scene: "a b's.obj", store: 'stencil', arithmetic: 'count', count: 'zfail', silhouette: 'visible', mask_scale: 0.5, apply: 'blend', shade: 'black', width: 64, height: 48, frame: 3, fidelity: 'chip', device: 'egl', effects: 'needed', caps: 'away', dither: 'on', blend_unit: 'voodoo_86box', view: { eye: '1,2,3', fov: '60' } };
        assert.equal(renderCommand(one(axes), 0, []), "gnomon render 'a b'\\''s.obj' --profile tnt --store stencil --arithmetic count --count zfail --silhouette visible --mask-scale 1/2 --apply blend --caps away --shade black --size 64x48 --frame 3 --fidelity chip --dither on --blend-unit voodoo_86box --device egl --effects needed --eye 1,2,3 --fov 60 -o image.png --mask mask.png --truth truth.png --steps steps");
        // plan draws nothing: it takes no fidelity and no device.
        assert.equal(planCommand(one(axes), 0, []), "gnomon plan 'a b'\\''s.obj' --profile tnt --store stencil --arithmetic count --count zfail --silhouette visible --mask-scale 1/2 --apply blend --caps away --shade black --size 64x48 --frame 3 --effects needed --eye 1,2,3 --fov 60");
    });
});
