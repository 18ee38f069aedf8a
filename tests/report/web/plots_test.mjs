// The plots: each method has its name, and can be marked.
import assert from 'node:assert/strict';
import { after, before, describe } from 'node:test';
import { closeBrowser, onPage as test, openBrowser, reportFile, skip } from './browser.mjs';
import { makeRun } from './fixture.mjs';

const many = () => reportFile('many.html', makeRun({ chipCount: 1, methodCount: 21, frames: 12, scenes: ['boxes'] }));
/// The names in a plot with their places; what is faded has an opacity.
const labels = (tab, id) => tab.locator(`#plot-${id} svg .mark-text.role-mark text`).evaluateAll((all) => all.filter((node) => node.textContent).map((node) => {
    const { left, right, top, bottom } = node.getBoundingClientRect(), plot = node.closest('svg').getBoundingClientRect();
    return { name: node.textContent, left, right, top, bottom, isInside: left >= plot.left && right <= plot.right && top >= plot.top && bottom <= plot.bottom, opacity: Number(node.getAttribute('opacity') ?? 1) };
}));

describe('the plots of the report', { skip }, () => {
    before(openBrowser);
    after(closeBrowser);

    for (const width of [360, 1280])
        test(`all lines and points have names that cover no other, at ${width} pixels`, { address: many, plots: true, width }, async (tab) => {
            for (const id of ['accuracy', 'path']) {
                const all = await labels(tab, id);
                assert.equal(new Set(all.map(({ name }) => name)).size, all.length);
                if (id === 'path' || width > 1000) assert.equal(all.length, 21, id);
                // A line of text is 14 pixels from the next; its letters may be drawn a little higher than that.
                for (const a of all) {
                    assert.ok(a.isInside, `${id} ${a.name}`);
                    for (const b of all) assert.ok(a === b || a.left >= b.right || b.left >= a.right || a.top + 3 >= b.bottom || b.top + 3 >= a.bottom, `${id}: ${a.name} covers ${b.name}`);
                }
            }
        });

    test('a method is marked in all plots by the pointer, by the focus, and for good by a press', { address: many, plots: true }, async (tab) => {
        const bright = async (id) => (await labels(tab, id)).filter(({ opacity }) => opacity > 0.5).map(({ name }) => name);
        const carmack = tab.locator('.method-marks [data-method=carmack]');
        assert.equal((await bright('path')).length, 21);
        await carmack.hover();
        for (const id of ['accuracy', 'path']) {
            await tab.waitForFunction((plot) => [...document.querySelectorAll(`#plot-${plot} .mark-text.role-mark text`)].filter((node) => Number(node.getAttribute('opacity') ?? 1) > 0.5).length === 1, id);
            assert.deepEqual(await bright(id), ['carmack']);
        }
        assert.match(await tab.locator('.mark-said').textContent(), /^carmack on ideal: exact, 0 wrong pixels, 1 scene pass/);
        await tab.mouse.move(5, 5);
        await tab.waitForFunction(() => [...document.querySelectorAll('#plot-path .mark-text.role-mark text')].every((node) => Number(node.getAttribute('opacity') ?? 1) > 0.5));
        await tab.locator('#plot-accuracy svg .mark-symbol.role-mark path').first().hover();
        await tab.waitForFunction(() => / on ideal: /.test(document.querySelector('.mark-said').textContent));
        assert.equal((await bright('path')).length, 1);
        await tab.mouse.move(5, 5);
        await tab.locator('.method-marks [tabindex="0"]').focus();
        await tab.keyboard.press('ArrowRight');
        assert.match(await tab.locator('.mark-said').textContent(), /^heidmann on ideal/);
        await tab.keyboard.press('Enter');
        await tab.waitForURL(/#mark=heidmann$/);
        assert.equal(await tab.locator('.method-marks [data-method=heidmann]').getAttribute('aria-pressed'), 'true');
        assert.equal(await tab.evaluate(() => document.activeElement.dataset.method), 'heidmann');
        await tab.goBack();
        assert.equal(await tab.locator('.method-marks [aria-pressed=true]').count(), 0);
    });

    test('a store keeps its colour, whatever the filters leave', { plots: true }, async (tab) => {
        const colour = () => tab.locator('#plot-path svg .mark-text.role-mark text', { hasText: /^williams$/ }).getAttribute('fill');
        const before = await colour();
        await tab.locator('#text').fill('depth-map');
        await tab.waitForFunction(() => document.querySelector('#plot-path').dataset.drawn === '3');
        assert.equal(await colour(), before);
    });

    test('the passes are the most of all frames, with the fewest beside them', { plots: true }, async (tab) => {
        await tab.locator('#plot-passes summary').click();
        const row = tab.locator('#plot-passes tr', { hasText: 'heidmann' }).first();
        assert.deepEqual(await row.locator('td').allTextContents(), ['ideal', 'boxes; hard/eye & light', 'heidmann', 'scene', '1', '13']);
        assert.match(await tab.locator('#plot-passes figcaption').textContent(), /the most over the scenes and frames/);
    });
});
