// The page in a browser: opened from disk, used with pointer and keyboard.
import assert from 'node:assert/strict';
import { after, before, describe, it } from 'node:test';
import { close, closeBrowser, comparedReport, download, escape, focused, onPage as test, open, openBrowser, reportFile, skip, smallReport, smallRun } from './browser.mjs';
import { makeRun, plainPicture } from './fixture.mjs';

const shown = (tab) => tab.locator('#shown').textContent();
const plain = (text) => text.replaceAll('\u202f', '');
const names = (tab) => tab.locator('.answer tbody th .name').allTextContents();
const entry = (tab, method, chip) => tab.locator(`.entry[aria-label^="${method} on ${chip}:"]`);

describe('report page', { skip }, () => {
    before(openBrowser);
    after(closeBrowser);

    test('opens from disk without a request or a word on the console', { plots: true }, async (tab) => {
        assert.match(tab.url(), /^file:/);
        assert.deepEqual((await tab.locator('h1').allTextContents()).map(plain), ['8 shadow methods on 5 graphics chips, in 2 scenes of 3 frames: 240 cells']);
        assert.equal(await tab.locator('#result').textContent(), 'roettger-screen is exact in every scene and frame on 5 of 5 chips, more than any other method. Every chip has one that is. 2 cells failed, by a fault of gnomon or of the driver.');
        assert.ok((await tab.locator('#result').boundingBox()).y < (await tab.locator('.answer').boundingBox()).y);
        assert.equal(plain(await shown(tab)), '8 methods on 5 chips: 240 cells of 240');
    });

    it('may not ask the network: the policy of the page refuses it', async () => {
        const tab = await open();
        const refused = await tab.evaluate(() => fetch('https://example.org/').then(() => false, () => true));
        assert.ok(refused);
        assert.ok(tab.faults.some((fault) => fault.includes('Content Security Policy')));
        await close(tab);
    });

    test('says what a cell of the table holds, in words as well as in colours', {}, async (tab) => {
        assert.equal(await entry(tab, 'heidmann', 'voodoo2').getAttribute('aria-label'), 'heidmann on voodoo2: refused for want of stencil; destination alpha beside depth');
        // Its frames have 1, 7 and 13 scene passes.
        assert.match(await entry(tab, 'heidmann', 'tnt').getAttribute('aria-label'), /, 1 to 13 scene passes, 1 rectangle,/);
        assert.match(await entry(tab, 'heidmann', 'tnt').locator('.passes').textContent(), /^1\u201313\/1$/);
        // Three frames of two scenes: the wrong pixels add up, the worst verdict counts.
        assert.match(await entry(tab, 'roettger-half', 'tnt').getAttribute('aria-label'), /: edge, 72 wrong pixels, 2 scene passes, 3 rectangles, [\d.]+ times/);
        assert.match(await entry(tab, 'williams', 'tnt').getAttribute('aria-label'), /: wrong, 166 wrong pixels/);
        assert.match(await entry(tab, 'carmack', 'tnt').getAttribute('aria-label'), /: failed: GL_INVALID_OPERATION/);
        assert.match(await entry(tab, 'roettger-screen', 'ps2').getAttribute('aria-label'), /the path that gnomon takes/);
        const symbols = await tab.locator('.entry svg use').evaluateAll((uses) => [...new Set(uses.map((use) => use.getAttribute('href')))].sort());
        assert.deepEqual(symbols, ['#edge', '#exact', '#failed', '#refused', '#wrong']);
    });

    test('filters by chip, method, scene, frame, verdict and words', {}, async (tab) => {
        await tab.locator('[data-list=profile] summary').click();
        await tab.locator('[data-list=profile] button', { hasText: 'None' }).click();
        await tab.locator('[data-list=profile] input[value=tnt]').check();
        assert.equal(plain(await shown(tab)), '8 methods on 1 chip: 48 cells of 240');
        await tab.locator('[data-list=profile] input[value=ps2]').check();
        await tab.keyboard.press('Escape');
        await tab.locator('[data-list=frame] summary').click();
        await tab.locator('[data-list=frame] input[value="2"]').uncheck();
        assert.equal(plain(await shown(tab)), '8 methods on 2 chips: 64 cells of 240');
        await tab.keyboard.press('Escape');
        await tab.locator('[data-list=scene] summary').click();
        await tab.locator('[data-list=scene] input[value=boxes]').uncheck();
        assert.equal(plain(await shown(tab)), '8 methods on 2 chips: 32 cells of 240');
        // Frame 2 is left out, and with it the failure; the figures are of what is left.
        assert.match(await entry(tab, 'roettger-half', 'tnt').getAttribute('aria-label'), /edge, 24 wrong pixels/);
        await tab.locator('[data-verdict=refused]').click();
        assert.deepEqual(await names(tab), ['heidmann', 'carmack', 'roettger-screen-max']);
        await tab.locator('#reset').click();
        assert.equal(plain(await shown(tab)), '8 methods on 5 chips: 240 cells of 240');
        await tab.locator('#text').fill('CLAMPS williams');
        assert.deepEqual(await names(tab), ['williams']);
        await tab.locator('#text').fill('no such thing');
        assert.match(await tab.locator('.answer-box').textContent(), /leave nothing/);
    });

    test('sorts by a column, and says so', {}, async (tab) => {
        const unsorted = await names(tab);
        const head = tab.locator('.head[data-column=tnt]'), cell = tab.locator('th:has(.head[data-column=tnt])');
        assert.equal(await cell.getAttribute('aria-sort'), 'none');
        await head.click();
        assert.equal(await cell.getAttribute('aria-sort'), 'ascending');
        assert.deepEqual((await names(tab)).slice(-3), ['none', 'roettger-screen-max', 'carmack']);
        await head.click();
        assert.equal(await cell.getAttribute('aria-sort'), 'descending');
        assert.deepEqual((await names(tab)).slice(0, 3), ['carmack', 'roettger-screen-max', 'none']);
        assert.equal(await focused(tab), await head.textContent());
        await head.click();
        assert.deepEqual(await names(tab), unsorted);
        await tab.locator('#figure').selectOption('wrong');
        await head.click();
        await head.click();
        // None of the refused and failed has a number of wrong pixels: infinite, so first when the worst come first.
        assert.deepEqual((await names(tab)).slice(2, 5), ['none', 'williams', 'roettger-half']);
        await tab.locator('#across').selectOption('methods');
        assert.deepEqual(await names(tab), ['ideal', 'voodoo2', 'i740', 'tnt', 'ps2']);
    });

    test('a permalink opens its cell', { hash: '#cell=tnt/roettger-half/boxes/48x36/0&verdict=edge' }, async (tab) => {
        assert.match(await tab.locator('dialog h2').textContent(), /roettger-half on NVIDIA RIVA TNT/);
        assert.match(await tab.locator('dialog .verdict').textContent(), /12 pixels are wrong, all within one mask pixel/);
        assert.match(await tab.locator('dialog .causes').textContent(), /low mask resolution: 12 pixels/);
        assert.equal(await tab.locator('dialog .command code').textContent(), 'gnomon render boxes --profile tnt --method roettger-half --size 48x36 --frame 0 -o image.png --mask mask.png --truth truth.png --steps steps');
        await escape(tab);
        assert.equal(await tab.locator('dialog[open]').count(), 0);
        assert.deepEqual(await names(tab), ['roettger-half']);
        assert.equal(new URL(tab.url()).hash, '#verdict=edge');
    });

    test('what is opened and chosen stands in the address', {}, async (tab) => {
        await tab.locator('[data-verdict=wrong]').click();
        await tab.locator('.head[data-column=ps2]').click();
        await entry(tab, 'williams', 'ps2').click();
        // The worst frame opens first.
        assert.equal(new URL(tab.url()).hash, '#cell=ps2/williams/boxes/48x36/2&verdict=wrong&sort=ps2:up');
        await tab.locator('.frame-button', { hasText: '1' }).first().click();
        await tab.waitForURL(/boxes\/48x36\/1&/);
        await tab.locator('[data-do=next]').click();
        await tab.waitForURL(/boxes\/48x36\/2&/);
        assert.match(await tab.locator('[data-do="Copy link"]').getAttribute('data-copy'), /#cell=ps2\/williams\/boxes\/48x36\/2$/);
        await tab.goBack();
        assert.equal(await tab.locator('dialog[open]').count(), 0);
    });

    test('a scene with signs of an address in its name keeps its permalink', {}, async (tab) => {
        await entry(tab, 'none', 'tnt').click();
        await tab.locator('.path-row').nth(1).locator('button').first().click();
        await tab.waitForURL(/light/);
        const address = tab.url();
        const again = await open(smallReport(), { hash: new URL(address).hash });
        assert.match(await again.locator('dialog p.muted').first().textContent(), /hard\/eye & light, frame 0/);
        assert.match(await again.locator('dialog .command code').textContent(), /render 'hard\/eye & light'/);
        await close(again);
    });

    test('says that a cell of the address is not there', { hash: '#cell=tnt/none/boxes/1x1/0' }, async (tab) => {
        assert.equal(await tab.locator('#problem').textContent(), 'The run has no cell tnt/none/boxes/1x1/0.');
    });

    test('says that a cell of the address stands only in the old run', { address: comparedReport, hash: '#cell=tnt/gone/boxes/48x36/0' }, async (tab) => {
        assert.equal(await tab.locator('#problem').textContent(), 'The cell tnt/gone/boxes/48x36/0 stands only in the old run, where it was exact: the new run has none of that name.');
    });

    const otherCommand = () => {
        const made = makeRun({ withCompare: true });
        made.run.compare.old = { command: "gnomon matrix boxes --profile 'my chip'", program: 'gnomon' };
        return reportFile('other.html', made);
    };
    for (const [address, words] of [[comparedReport, 'The old run (gnomon 0.0.9) and the new one are both of gnomon matrix boxes.'],
        [otherCommand, "From the old run, gnomon matrix boxes --profile 'my chip', to the new one, gnomon matrix boxes."]])
        test(`names what is known of two runs: ${words}`, { address }, async (tab) => {
            assert.equal(await tab.locator('.compare > p').textContent(), words);
        });

    test('names what refused a cell, with its source', { hash: '#cell=voodoo2/heidmann/boxes/48x36/0' }, async (tab) => {
        assert.match(await tab.locator('dialog .said table').textContent(), /stencilM-TDFX: Napalm only.*destination alpha beside depthMAME/);
        assert.equal(await tab.locator('dialog .viewer').count(), 0);
    });

    test('compares two runs, group by group under the kinds of causes', { address: comparedReport }, async (tab) => {
        assert.deepEqual(await tab.locator('.compare h3').allTextContents(), ['Verdict \u00b7 2 cells', 'What chips lack \u00b7 1 cell', 'Only in the new run \u00b7 1 cell', 'Only in the old run \u00b7 1 cell']);
        assert.equal(await tab.locator('.compare details').count(), 5);
        assert.match(await tab.locator('#result').textContent(), /^5 cells changed since the old run: 2 in \u201cverdict\u201d, 1 in \u201cwhat chips lack\u201d/);
        await tab.locator('.compare summary').first().focus();
        await tab.keyboard.press('Enter');
        await tab.locator('.compare a').first().waitFor();
        assert.match(await tab.locator('.compare details').first().textContent(), /exact \u2192 edge.*wrong pixels at the boundaries: 0 \u2192 12/);
        assert.equal(await tab.locator('.compare summary').nth(2).textContent(), 'lacks now: destination alpha beside depth; lacks no more: old lack \u00b7 1 cell');
        await tab.locator('.compare summary').nth(2).click();
        const limits = tab.locator('.compare details').nth(2);
        await limits.locator('li').first().waitFor();
        assert.deepEqual(await limits.locator('li').allTextContents(), ['lacks now: destination alpha beside depth', 'lacks no more: old lack']);
        assert.doesNotMatch(await tab.locator('.compare').textContent(), /[{}[\]]/);
        await tab.locator('.compare a').first().click();
        assert.match(await tab.locator('dialog h2').textContent(), /roettger-half on NVIDIA RIVA TNT/);
        assert.match(await tab.locator('dialog .said').textContent(), /Changed since the old run.*verdict: exact \u2192 edge/);
        await escape(tab);
        assert.match(await focused(tab), /^tnt\/roettger-half\/boxes/);
    });

    test('of two runs the table has what changed, and all of it on request', { address: comparedReport }, async (tab) => {
        assert.deepEqual(await names(tab), ['heidmann', 'roettger-half', 'williams']);
        const marked = () => tab.locator('.entry:has(.delta)').evaluateAll((nodes) => nodes.map((node) => `${node.dataset.row} ${node.dataset.profile}`));
        assert.deepEqual(await marked(), ['heidmann voodoo2', 'heidmann tnt', 'roettger-half tnt', 'williams tnt']);
        assert.equal(await tab.locator('.entry').count(), 4);
        assert.match(await entry(tab, 'heidmann', 'tnt').getAttribute('aria-label'), /, 1 cell changed$/);
        // What changed opens, and not another frame.
        await entry(tab, 'heidmann', 'tnt').click();
        assert.equal(new URL(tab.url()).hash, '#cell=tnt/heidmann/boxes/48x36/1');
        await escape(tab);
        await tab.locator('#changed').click();
        assert.equal(plain(await shown(tab)), '8 methods on 5 chips: 240 cells of 240');
        assert.equal(new URL(tab.url()).hash, '#changed=all');
        assert.equal((await marked()).length, 4);
        await tab.reload();
        await tab.waitForFunction(() => document.documentElement.dataset.ready);
        assert.equal(await tab.locator('#changed').getAttribute('aria-pressed'), 'false');
        assert.equal(await tab.locator('.answer tbody tr').count(), 8);
    });

    test('a run of its own shows no comparison', { address: () => reportFile('alone.html', makeRun()) }, async (tab) => {
        assert.equal(await tab.locator('.compare, #changed, .delta').count(), 0);
    });

    test('plots export as SVG and their rows as CSV', { plots: true }, async (tab) => {
        for (const id of ['accuracy', 'path', 'passes', 'states']) {
            const svg = await download(tab, () => tab.locator(`#plot-${id} [data-do=svg]`).click());
            assert.equal(svg.name, `gnomon-${id}.svg`);
            assert.match(svg.text, /<svg[^]*<\/svg>/);
            const named = { accuracy: ['ideal, No limits', 'scenes boxes, hard/eye &amp; light'], path: ['ideal, No limits', 'scene boxes'], passes: ['ideal, No limits', 'scenes boxes'], states: ['voodoo2, roettger-screen'] }[id];
            for (const words of named) assert.ok(svg.text.includes(words), `${id} names ${words}`);
            assert.ok(await tab.evaluate((text) => !new DOMParser().parseFromString(text, 'image/svg+xml').querySelector('parsererror'), svg.text));
        }
        await tab.locator('#plot-chip').selectOption('tnt');
        await tab.waitForFunction(() => document.querySelector('#plot-accuracy').dataset.drawn === '6');
        const { text } = await download(tab, () => tab.locator('#plot-accuracy [data-do=csv]').click());
        const lines = text.trim().split('\r\n');
        assert.equal(lines[0], 'profile,scenes,method,verdict,time_ratio,wrong_pixels,wrong_percent,frontier');
        assert.equal(lines.length, 7);
        assert.equal(lines.filter((line) => line.startsWith('tnt,boxes; hard/eye & light,roettger-half,edge,')).length, 1);
        const table = await download(tab, () => tab.locator('#table-csv').click());
        assert.equal(table.text.trim().split('\r\n').length, 1 + 40);
        assert.match(table.text, /tnt,roettger-half,edge,false,6,0,2,2,24,24,3,3,0,0,72,0,/);
    });

    test('the first table of 31,000 cells', { address: () => reportFile('large.html', makeRun({ chipCount: 41, methodCount: 21, scenes: ['boxes', 'knot', 'roettger'], frames: 12 })) }, async (tab) => {
        assert.equal(plain(await shown(tab)), '21 methods on 41 chips: 30996 cells of 30996');
        const [mark] = await tab.evaluate(() => performance.getEntriesByName('gnomon-table').map((m) => m.startTime));
        console.log(`# table of 30996 cells after ${Math.round(mark)} ms`);
    });

    // What the pictures hold must be what the page shows of them.
    const made = smallRun();
    const drawing = made.run.drawings[0];
    test('pictures: values under the cursor, in all kinds and bases', { hash: '#cell=tnt/roettger-half/boxes/48x36/0' }, async (tab) => {
        const stage = tab.locator('.pictured > section').first().locator('.stage');
        await stage.focus();
        for (const [keys, x, y] of [[['ArrowRight'], 25, 18], [['ArrowDown', 'Shift+ArrowLeft'], 15, 19], [['Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowUp', 'Shift+ArrowUp'], 47, 0]]) {
            for (const key of keys) await tab.keyboard.press(key);
            const at = y * 48 + x, of = (name) => plainPicture(made, drawing.pictures[name]);
            const texts = await tab.locator('.values').first().locator('dd').allTextContents();
            const cause = of('causes')[at];
            assert.deepEqual(texts, [`${x}, ${y}`, [0, 1, 2].map((p) => of('image')[p * 48 * 36 + at]).join(' '), String(of('mask')[at]), String(of('truth')[at]),
                cause ? made.run.causes[cause - 1].name : 'no wrong pixel', String(of('difference')[at])]);
        }
        assert.match(await tab.locator('#said').textContent(), /^pixel 47, 0: image/);
    });

    /// The colour in the middle of a pixel of the picture, where the whole of it is seen.
    const colourAt = (tab, x, y) => tab.locator('.stage canvas').first().evaluate((canvas, at) => window.colourOf(canvas, ...at), [x, y]);
    /// Read from a copy: the browser warns of reading from what is drawn.
    const reader = () => {
        window.colourOf = (canvas, x, y) => {
            const scale = canvas.width / 48;
            const copy = Object.assign(document.createElement('canvas'), { width: 1, height: 1 }).getContext('2d', { willReadFrequently: true });
            copy.drawImage(canvas, (x + 0.5) * scale, (y + 0.5) * scale, 1, 1, 0, 0, 1, 1);
            return [...copy.getImageData(0, 0, 1, 1).data.slice(0, 3)];
        };
    };
    test('pictures: a slider between any two, swapping and blinking', { hash: '#cell=tnt/roettger-half/boxes/48x36/0' }, async (tab) => {
        const view = tab.locator('.viewer').first();
        await view.waitFor();
        await tab.evaluate(reader);
        const [x, y] = [24, 22];  // the mask is lit there, and truth is not
        const slider = view.locator('input[type=range]');
        await slider.fill('100');
        assert.deepEqual(await colourAt(tab, x, y), [255, 255, 255]);
        await slider.fill('0');
        assert.deepEqual(await colourAt(tab, x, y), [0, 0, 0]);
        await view.locator('[data-do=swap]').click();
        assert.deepEqual(await colourAt(tab, x, y), [255, 255, 255]);
        await view.locator('select').nth(1).selectOption('causes');
        assert.deepEqual(await colourAt(tab, x, y), plainPicture(made, drawing.pictures.causes)[y * 48 + x] === 1 ? [230, 159, 0] : [86, 180, 233]);
        await slider.focus();
        await tab.keyboard.press('End');
        assert.deepEqual(await colourAt(tab, x, y), [0, 0, 0]);
        const blink = view.locator('[data-do=blink]');
        await tab.locator('.stage').first().focus();
        await tab.keyboard.press('b');
        assert.equal(await blink.getAttribute('aria-pressed'), 'true');
        await tab.waitForFunction(() => window.colourOf(document.querySelector('.stage canvas'), 24, 22)[0] !== 0);
        await tab.keyboard.press('b');
        assert.equal(await blink.getAttribute('aria-pressed'), 'false');
        assert.deepEqual(await colourAt(tab, x, y), [0, 0, 0]);
    });

    test('pictures: nothing blinks by itself where less motion is asked for', { hash: '#cell=tnt/roettger-half/boxes/48x36/0', motion: 'reduce' }, async (tab) => {
        const view = tab.locator('.viewer').first();
        await view.waitFor();
        await tab.evaluate(reader);
        const timers = await tab.evaluate(() => {
            window.started = 0;
            const old = window.setInterval;
            window.setInterval = (...rest) => (++window.started, old(...rest));
            return window.started;
        });
        await view.locator('[data-do=blink]').click();
        assert.equal(await tab.evaluate(() => window.started), timers);
        assert.deepEqual(await colourAt(tab, 24, 22), [0, 0, 0]);
        await view.locator('[data-do=blink]').click();
        assert.deepEqual(await colourAt(tab, 22, 22), [255, 255, 255]);
    });

    test('pictures: zoom to single pixels', { hash: '#cell=tnt/roettger-half/boxes/48x36/0' }, async (tab) => {
        const view = tab.locator('.viewer').first();
        const stage = view.locator('.stage');
        await stage.focus();
        await tab.keyboard.press('ArrowRight');
        const scale = async () => Number(await view.getAttribute('data-scale'));
        const fitted = await scale();
        await tab.keyboard.press('+');
        assert.equal(await scale(), 2 * fitted);
        await tab.keyboard.press('+');
        // The pixel of the cursor stays in view: a click on its middle names it again.
        await tab.keyboard.press('-');
        await tab.keyboard.press('0');
        assert.equal(await scale(), fitted);
        const box = await view.locator('canvas').boundingBox();
        await tab.mouse.move(box.x + 10.5 * fitted, box.y + 3.5 * fitted);
        assert.equal(await view.locator('.values dd').first().textContent(), '10, 3');
        assert.equal(await view.locator('canvas').evaluate((canvas) => canvas.getContext('2d').imageSmoothingEnabled), false);
    });

    test('the film strip steps with the arrow keys', { hash: '#cell=tnt/roettger-half/boxes/48x36/0' }, async (tab) => {
        const film = tab.locator('.film');
        await film.focus();
        const pass = () => tab.locator('.strip').getAttribute('data-pass');
        const caption = () => tab.locator('.strip .caption').textContent();
        assert.equal(await pass(), '1');
        await tab.keyboard.press('ArrowRight');
        await tab.keyboard.press('ArrowRight');
        assert.equal(await pass(), '3');
        assert.match(await caption(), /Pass 3 of 6: front faces of volume 0.*reason 3/);
        assert.equal(await film.getAttribute('aria-activedescendant'), 'pass-2');
        assert.equal(await tab.locator('#pass-2').getAttribute('aria-selected'), 'true');
        await tab.keyboard.press('End');
        await tab.keyboard.press('ArrowRight');
        assert.equal(await pass(), '6');
        await tab.keyboard.press('Home');
        await tab.keyboard.press('ArrowLeft');
        assert.equal(await pass(), '1');
        // Counts are shown as counts.
        await tab.locator('.strip select').first().selectOption('stencil');
        await film.focus();
        await tab.keyboard.press('End');
        await tab.waitForFunction(() => document.querySelectorAll('.strip .viewer').length === 1);
        const stage = tab.locator('.strip .stage');
        await stage.focus();
        await tab.keyboard.press('ArrowDown');
        const stencil = plainPicture(made, drawing.strip[5].buffers.stencil)[19 * 48 + 24];
        assert.equal(stencil, 2);
        assert.equal(await tab.locator('.strip .values div', { hasText: /^stencil\d/ }).locator('dd').textContent(), '2');
    });
});
