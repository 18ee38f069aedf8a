// An opened cell: what holds of it, where its pictures are, and what must not be said.
import assert from 'node:assert/strict';
import { after, before, describe } from 'node:test';
import { closeBrowser, onPage as test, openBrowser, reportFile, skip } from './browser.mjs';
import { makeRun } from './fixture.mjs';

/// The small run with its drawings changed.
const drawnOtherwise = (name, change) => () => {
    const made = makeRun();
    change(made.run.drawings);
    return reportFile(name, made);
};

describe('an opened cell of the report', { skip }, () => {
    before(openBrowser);
    after(closeBrowser);

    test('without pictures: the nearest frame of its own scene', { hash: '#cell=tnt/none/boxes/48x36/2' }, async (tab) => {
        const button = tab.locator('[data-do=elsewhere]');
        assert.equal(await button.textContent(), 'Show frame 0');
        await button.click();
        assert.match(await tab.locator('dialog p.muted').first().textContent(), /^boxes, frame 0/);
        await tab.locator('.strip .viewer').waitFor();
    });

    test('without pictures of its scene: it says so and names the other', { hash: '#cell=tnt/none/hard/eye%20%26%20light/48x36/1' }, async (tab) => {
        assert.match(await tab.locator('.pictured').textContent(), /It keeps none of the scene hard\/eye & light with this method on this chip/);
        assert.equal(await tab.locator('[data-do=elsewhere]').textContent(), 'Show frame 0 of the scene boxes');
    });

    test('refused: what the chip lacks, no figures, and the command that says why', { hash: '#cell=voodoo2/heidmann/boxes/48x36/0' }, async (tab) => {
        assert.match(await tab.locator('dialog .said').textContent(), /What the chip lacks.*stencil.*destination alpha beside depth/);
        const terms = await tab.locator('.figures-list dt').allTextContents();
        for (const name of terms) assert.doesNotMatch(name, /passes|nesting|pixels|tied|wrong|unpredicted|cpu|unshadowed|digest|vertices|chosen/);
        assert.ok(terms.includes('store'));
        assert.equal(await tab.locator('.command code').textContent(), 'gnomon plan boxes --profile voodoo2 --method heidmann --size 48x36 --frame 0');
        assert.match(await tab.locator('.rest').textContent(), /Why it is refused/);
        assert.doesNotMatch(await tab.locator('dialog').textContent(), /gnomon render/);
    });

    test('refused with a plan: it is shown as that of other cells', {
        address: () => {
            const made = makeRun();
            made.run.cells.columns.plan.dictionary = made.run.cells.columns.plan.dictionary.map((text) => text ?? 'pass 1: the stencil is lacking');
            return reportFile('planned.html', made);
        },
        hash: '#cell=voodoo2/heidmann/boxes/48x36/0',
    }, async (tab) => {
        assert.match(await tab.locator('.plan').textContent(), /pass 1: the stencil is lacking/);
        assert.equal(await tab.locator('.viewer').count(), 0);
    });

    test('failed: no figures that were not measured', { hash: '#cell=tnt/carmack/boxes/48x36/2' }, async (tab) => {
        for (const name of await tab.locator('.figures-list dt').allTextContents()) assert.doesNotMatch(name, /passes|pixels|tied|wrong|cpu|digest/);
        assert.match(await tab.locator('.command code').textContent(), /^gnomon render/);
    });

    test('drawn again otherwise than in the run: the cell says so, and the page how many', {
        address: drawnOtherwise('differs.html', (drawings) => (drawings[0].differs = ['mask', 'image'])), hash: '#cell=tnt/roettger-half/boxes/48x36/0',
    }, async (tab) => {
        assert.equal(await tab.locator('.otherwise').textContent(), 'Drawn again now, otherwise than in the run: mask, image.');
        // The drawing serves one frame of none, roettger-half and, on frame 0, no other: on five chips.
        assert.match(await tab.locator('#result').textContent(), /10 cells came out otherwise than in the run when drawn again/);
        await tab.locator('.strip .viewer').waitFor();
    });

    test('not drawn again: the reason, and no pictures', {
        address: drawnOtherwise('error.html', (drawings) => (drawings[0] = { ...drawings[0], error: 'the scene file is gone', pictures: {}, strip: [] })), hash: '#cell=tnt/roettger-half/boxes/48x36/0',
    }, async (tab) => {
        assert.equal(await tab.locator('.otherwise').textContent(), 'Not drawn again: the scene file is gone');
        assert.match(await tab.locator('.pictured').textContent(), /There are no pictures of this frame/);
        assert.match(await tab.locator('#result').textContent(), /10 cells could not be drawn again/);
        assert.equal(await tab.locator('.viewer').count(), 0);
    });

    test('a strip that left passes out counts those of the frame', {
        address: drawnOtherwise('gaps.html', (drawings) => drawings[0].strip.splice(2, 2)), hash: '#cell=tnt/roettger-half/boxes/48x36/0&pass=5',
    }, async (tab) => {
        await tab.locator('.strip .viewer').waitFor();
        assert.match(await tab.locator('.strip .caption').textContent(), /^Pass 5 of 6:/);
    });

    test('a run without a fault says nothing of drawing again', { hash: '#cell=tnt/roettger-half/boxes/48x36/0' }, async (tab) => {
        assert.doesNotMatch(await tab.locator('#result').textContent(), /drawn again/);
        assert.equal(await tab.locator('.otherwise').count(), 0);
    });

    for (const [width, height, by] of [[1280, 900, '[data-do=to-strip]'], [1920, 900, '.strip [aria-label="Pass before"]'], [360, 740, '[data-do=to-strip]'], [1280, 700, '[data-do=to-strip]']])
        test(`the film strip and its large picture are seen together at ${width}\u00d7${height}`, { hash: '#cell=tnt/roettger-half/boxes/48x36/0&pass=5', width, height }, async (tab) => {
            await tab.locator('.strip .viewer').waitFor();
            const isJump = by.includes('to-strip');
            await tab.locator(by).click();
            if (isJump) await tab.keyboard.press('ArrowRight');
            await tab.waitForFunction((pass) => document.querySelector('.strip').dataset.pass === pass, isJump ? '6' : '4');
            await tab.waitForFunction(() => ['.strip > .row', '.film', '.strip .caption h4', '.strip .viewer canvas'].every((part) => {
                const box = document.querySelector(part).getBoundingClientRect();
                return box.height > 10 && box.top >= 0 && box.bottom <= innerHeight;
            }));
            assert.ok(await tab.locator('.film').evaluate((film) => {
                const [outer, inner] = [film, film.querySelector('[aria-selected=true]')].map((node) => node.getBoundingClientRect());
                return inner.left >= outer.left && inner.right <= outer.right;
            }));
            assert.ok((await tab.locator('.strip canvas').last().boundingBox()).height >= 100);
        });
});
