// The page's modules without a browser.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { exclusiveOr, undoDifferences } from '../../../src/report/web/decode.js';
import { differences } from '../../../src/report/web/compare.js';
import { accuracyRows } from '../../../src/report/web/plot_specs.js';
import { Cells, median, table, verdicts } from '../../../src/report/web/run.js';
import { csvOf } from '../../../src/report/web/save.js';
import { hashOf, initialState, keeper, stateOf } from '../../../src/report/web/state.js';
import { sortedLines } from '../../../src/report/web/table.js';
import { renderCommand } from '../../../src/report/web/words.js';
import { makeRun } from './fixture.mjs';

const { run } = makeRun();
const cells = new Cells(run.cells);

describe('report modules', () => {
    it('rows of differences and exclusive-or come back', () => {
        assert.deepEqual([...undoDifferences(Uint8Array.from([250, 10, 255, 1, 0, 2]), 3)], [250, 4, 3, 1, 1, 3]);
        assert.deepEqual([...exclusiveOr(Uint8Array.from([1, 255]), Uint8Array.from([3, 15]))], [2, 240]);
    });

    it('the address holds the whole state', () => {
        const state = { ...initialState(), profile: new Set(['tnt', 'a,b&c=d']), verdict: new Set(['wrong']), frame: new Set(['0', '11']), text: 'max & 50 %',
            sort: 'geforce2mx-565:down', cell: 'tnt/none/hard/eye & light/48x36/0' };
        assert.deepEqual(stateOf(hashOf(state)), state);
        assert.equal(hashOf(initialState()), '');
        assert.deepEqual(stateOf(''), initialState());
        assert.match(hashOf(state), /^#cell=tnt\/none\/hard\/eye%20%26%20light\/48x36\/0&/);
        // What somebody mistyped does no harm.
        assert.deepEqual(stateOf('#nonsense=1&%'), initialState());
        assert.equal(stateOf('#text=50%').text, '50%');
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

    it('on the frontier nothing is both faster and more exact', () => {
        const all = table(cells, () => true).all();
        const shown = { rows: run.methods.map((m) => m.id), entry: (row, profile) => all.find((e) => e.row === row && e.profile === profile) };
        const rows = accuracyRows(shown, 'ideal');
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

    it('the command names a method by its axes where it has no row, and quotes for the shell', () => {
        const one = (values) => new Cells({ count: 1, columns: Object.fromEntries(Object.entries(values).map(([name, value]) => [name, { dictionary: [value], values: [0] }])) });
        const axes = { profile: 'tnt', method: 'stencil-count-zfail', scene: "a b's.obj", store: 'stencil', arithmetic: 'count', count: 'zfail', silhouette: 'visible', mask_scale: 0.5, apply: 'blend', shade: 'black', width: 64, height: 48, frame: 3, fidelity: 'chip', device: 'egl', effects: 'needed', caps: 'away', dither: 'on', blend_unit: 'voodoo_86box', view: { eye: '1,2,3', fov: '60' } };
        assert.equal(renderCommand(one(axes), 0, []), "gnomon render 'a b'\\''s.obj' --profile tnt --store stencil --arithmetic count --count zfail --silhouette visible --mask-scale 1/2 --apply blend --caps away --shade black --size 64x48 --frame 3 --fidelity chip --dither on --blend-unit voodoo_86box --device egl --effects needed --eye 1,2,3 --fov 60 -o image.png --mask mask.png --truth truth.png --steps steps");
    });
});
