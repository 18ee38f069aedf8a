// The address of the page: it holds what is looked at, "back" undoes, and what it says wrongly is named.
import assert from 'node:assert/strict';
import { after, before, describe } from 'node:test';
import { close, closeBrowser, escape, focused, onPage as test, open, openBrowser, skip, smallReport } from './browser.mjs';

const hash = (tab) => new URL(tab.url()).hash;
const hashIs = (tab, wanted) => tab.waitForURL((url) => url.hash === wanted);
const names = (tab) => tab.locator('.answer tbody th .name').allTextContents();
const problem = (tab) => tab.locator('#problem').textContent();
const problemOfCell = (tab) => tab.locator('dialog .problem');
const cell = '#cell=tnt/roettger-half/boxes/48x36/0';

describe('the address of the report', { skip }, () => {
    before(openBrowser);
    after(closeBrowser);

    test('back undoes filters, order and choices one by one, and typing as a whole', {}, async (tab) => {
        const steps = ['', '#verdict=edge', '#verdict=edge,wrong', '#verdict=edge,wrong&text=roe', '#verdict=edge,wrong&text=roe&sort=tnt:up', '#verdict=edge,wrong&text=roe&sort=tnt:up&figure=wrong'];
        const acts = [
            () => tab.locator('[data-verdict=edge]').click(), () => tab.locator('[data-verdict=wrong]').click(), () => tab.locator('#text').pressSequentially('roe'),
            () => tab.locator('.head[data-column=tnt]').click(), () => tab.locator('#figure').selectOption('wrong'),
        ];
        for (const [i, act] of acts.entries()) {
            await act();
            await hashIs(tab, steps[i + 1]);
        }
        assert.deepEqual(await names(tab), ['roettger-half']);
        for (const step of steps.slice(0, -1).reverse()) {
            await tab.goBack();
            await hashIs(tab, step);
        }
        assert.equal((await names(tab)).length, 8);
        assert.equal(await tab.locator('#text').inputValue(), '');
        assert.equal(await tab.locator('[data-verdict=edge]').getAttribute('aria-pressed'), 'false');
        await tab.goForward();
        assert.equal(await tab.locator('[data-verdict=edge]').getAttribute('aria-pressed'), 'true');
        assert.deepEqual(await names(tab), ['roettger-half']);
    });

    test('back undoes the last filter after a cell was opened and closed', {}, async (tab) => {
        await tab.locator('[data-verdict=edge]').click();
        await tab.locator('.entry').first().click();
        await escape(tab);
        await hashIs(tab, '#verdict=edge');
        await tab.goBack();
        await hashIs(tab, '');
        assert.equal((await names(tab)).length, 8);
    });

    test('back gives the text field what it had, although the focus is in it', {}, async (tab) => {
        await tab.locator('#text').pressSequentially('half');
        assert.deepEqual(await names(tab), ['roettger-half']);
        await tab.goBack();
        await hashIs(tab, '');
        assert.equal(await tab.locator('#text').inputValue(), '');
        assert.equal((await names(tab)).length, 8);
    });

    test('pictures, divider, zoom, pixel and pass of a cell come back from the address', { hash: cell }, async (tab) => {
        const view = tab.locator('.viewer').first(), stage = view.locator('.stage');
        await tab.locator('.strip .viewer').waitFor();
        await view.locator('select').first().selectOption('image');
        await view.locator('input[type=range]').fill('25');
        await stage.focus();
        for (const key of ['ArrowRight', 'ArrowDown', '+', '+']) await tab.keyboard.press(key);
        const zoom = await view.getAttribute('data-scale');
        await tab.locator('.film').focus();
        for (const key of ['ArrowRight', 'ArrowRight', 'ArrowRight']) await tab.keyboard.press(key);
        await tab.locator('.strip select').first().selectOption('colour');
        const whole = `${cell}&pair=image,truth&divider=25&zoom=${zoom}&pixel=25,19&pass=4&buffer=colour`;
        await hashIs(tab, whole);
        const again = await open(smallReport(), { hash: whole });
        await again.locator('.strip .viewer').waitFor();
        const there = again.locator('.viewer').first();
        assert.deepEqual(await there.locator('select').evaluateAll((all) => all.map((node) => node.value)), ['image', 'truth']);
        assert.equal(await there.locator('input[type=range]').inputValue(), '25');
        assert.equal(await there.getAttribute('data-scale'), zoom);
        assert.equal(await there.locator('.values dd').first().textContent(), '25, 19');
        assert.equal(await again.locator('.strip').getAttribute('data-pass'), '4');
        assert.equal(await again.locator('.strip select').first().inputValue(), 'colour');
        assert.equal(await again.locator('#problem').isVisible(), false);
        assert.ok((await again.locator('[data-link]').getAttribute('data-copy')).endsWith(whole));
        assert.deepEqual(again.faults, []);
        await close(again);
    });

    test('the strip keeps its zoom and its pixel from pass to pass, and so does the address', { hash: `${cell}&pass=3` }, async (tab) => {
        const strip = tab.locator('.strip');
        await strip.locator('.viewer').waitFor();
        await strip.locator('.stage').focus();
        await tab.keyboard.press('ArrowRight');
        await tab.keyboard.press('+');
        const zoom = await strip.locator('.viewer').getAttribute('data-scale');
        await tab.locator('.film').focus();
        await tab.keyboard.press('ArrowRight');
        await hashIs(tab, `${cell}&pass=4&pass-zoom=${zoom}&pass-pixel=25,18`);
        await tab.waitForFunction((wanted) => document.querySelector('.strip .viewer').dataset.scale === wanted && document.querySelector('.strip .values dd')?.textContent === '25, 18', zoom);
    });

    test('a click on a picture keeps its pixel, a pointer over it does not', { hash: cell }, async (tab) => {
        const canvas = tab.locator('.viewer canvas').first();
        await canvas.waitFor();
        await canvas.hover({ position: { x: 20, y: 20 } });
        assert.match(await tab.locator('.values').first().textContent(), /pixel/);
        assert.equal(hash(tab), cell);
        await canvas.click({ position: { x: 20, y: 20 } });
        await tab.waitForURL(/&pixel=\d+,\d+$/);
    });

    for (const [what, named, rest] of [
        ['#profile=nonsense&verdict=edge', /profile=nonsense: the run has no such chip/, ['roettger-half']],
        ['#verdict=foo&method=carmack', /verdict=foo/, ['carmack']],
        ['#sort=voodoo9:up&method=carmack', /sort=voodoo9:up: the table has no such column/, ['carmack']],
        ['#shade=black&method=carmack', /\u201cshade=black\u201d/, ['carmack']],
        ['#cell=&method=carmack', /\u201ccell=\u201d/, ['carmack']],
        ['#changed=only&method=carmack', /changed=only: this page compares no runs/, ['carmack']],
    ])
        test(`the address ${what} is named as wrong, and its rest is used`, { hash: what }, async (tab) => {
            assert.match(await problem(tab), named);
            assert.deepEqual(await names(tab), rest);
            // What the reader does next makes a right address.
            await tab.locator('[data-verdict=exact]').click();
            assert.equal(await tab.locator('#problem').isVisible(), false);
            assert.doesNotMatch(hash(tab), /nonsense|foo|voodoo9|shade|changed/);
        });

    for (const [what, named] of [['pair=mask,none', /two of image, mask/], ['pixel=99,1', /48\u00d736/], ['pass=77', /from 1 to 6, 6 of them/], ['zoom=a', /up to 128/], ['buffer=alpha', /colour, stencil/], ['left=foo', /\u201cleft=foo\u201d/]])
        test(`of an opened cell ${what} is named as wrong`, { hash: `${cell}&${what}` }, async (tab) => {
            await tab.locator('.strip .viewer').waitFor();
            assert.match(await problem(tab), named);
            // The cell lies over the page.
            assert.match(await problemOfCell(tab).textContent(), named);
            assert.ok(await problemOfCell(tab).isVisible());
            assert.equal(await tab.locator('.strip').getAttribute('data-pass'), '1');
        });

    test('an order by a column that is filtered away is said and given up', { hash: '#sort=tnt:down' }, async (tab) => {
        const sorted = await names(tab);
        await tab.locator('[data-list=profile] summary').click();
        await tab.locator('[data-list=profile] input[value=tnt]').uncheck();
        assert.match(await problem(tab), /no column tnt to be sorted by/);
        assert.doesNotMatch(hash(tab), /sort/);
        assert.equal((await names(tab))[0], 'none');
        await tab.goBack();
        await hashIs(tab, '#sort=tnt:down');
        assert.deepEqual(await names(tab), sorted);
        assert.equal(await tab.locator('#problem').isVisible(), false);
    });

    test('a stale order in the address is named', { hash: '#sort=tnt:down&profile=ps2' }, async (tab) => {
        assert.match(await problem(tab), /no column tnt to be sorted by/);
    });

    test('closing a cell that was opened by its address focuses its entry', { hash: '#cell=ps2/williams/boxes/48x36/0' }, async (tab) => {
        await escape(tab);
        assert.match(await focused(tab), /^williams on ps2:/);
        assert.equal(hash(tab), '');
        await tab.keyboard.press('ArrowUp');
        assert.match(await focused(tab), /^roettger-half on ps2:/);
    });

    test('closing a cell whose entry is filtered away focuses the heading', { hash: '#cell=ps2/williams/boxes/48x36/0&method=none' }, async (tab) => {
        await escape(tab);
        assert.equal(await focused(tab), 'Which method works on which chip');
    });

    test('an address that is typed over is read', {}, async (tab) => {
        await tab.evaluate(() => (location.hash = '#verdict=edge'));
        await tab.waitForFunction(() => document.querySelectorAll('.answer tbody tr').length === 1);
        assert.deepEqual(await names(tab), ['roettger-half']);
    });
});
