// The page without a mouse, in both themes, at all widths, on paper.
import assert from 'node:assert/strict';
import { after, before, describe, it } from 'node:test';
import { close, closeBrowser, focused, open, openBrowser, skip, smallReport } from './browser.mjs';

describe('report page, for all', { skip }, () => {
    before(openBrowser);
    after(closeBrowser);
    const test = (name, options, body) => it(name, async () => {
        const tab = await open(smallReport(), options);
        await body(tab);
        assert.deepEqual(tab.faults, []);
        await close(tab);
    });

    test('a walk by keyboard: skip link, table, cell, strip, and back', {}, async (tab) => {
        await tab.keyboard.press('Tab');
        assert.equal(await focused(tab), 'Skip to the table');
        await tab.keyboard.press('Enter');
        await tab.keyboard.press('Tab');
        assert.match(await focused(tab), /^none on ideal: wrong/);
        await tab.keyboard.press('ArrowDown');
        await tab.keyboard.press('ArrowRight');
        assert.match(await focused(tab), /^heidmann on voodoo2: refused/);
        await tab.keyboard.press('End');
        assert.match(await focused(tab), /^heidmann on ps2/);
        await tab.keyboard.press('Control+End');
        assert.match(await focused(tab), /^williams on ps2/);
        await tab.keyboard.press('ArrowRight');
        assert.match(await focused(tab), /^williams on ps2/);
        await tab.keyboard.press('Control+Home');
        assert.equal(await focused(tab), 'method');
        for (const key of ['ArrowRight', 'Enter', 'ArrowDown', 'ArrowDown']) await tab.keyboard.press(key);
        assert.match(await focused(tab), / on ideal: exact/);
        const from = await focused(tab);
        await tab.keyboard.press('Enter');
        assert.match(await tab.evaluate(() => document.activeElement.tagName), /H2/);
        await tab.locator('.strip .viewer').waitFor();
        // The tabulator stays in the dialog and comes to every part of it.
        const seen = new Set();
        for (let i = 0; i < 40; ++i) {
            await tab.keyboard.press('Tab');
            seen.add(await tab.evaluate(() => document.activeElement.className || document.activeElement.dataset.do || document.activeElement.tagName));
            assert.ok(await tab.evaluate(() => document.activeElement === document.body || document.activeElement.closest('dialog') !== null));
        }
        for (const part of ['close', 'stage', 'film', 'blink']) assert.ok(seen.has(part), `${part} in ${[...seen]}`);
        assert.ok([...seen].some((name) => name.startsWith('frame-button')));
        await tab.keyboard.press('Escape');
        assert.equal(await focused(tab), from);
    });

    test('one stop of the tabulator in the table, and one in the frames', { hash: '#cell=tnt/none/boxes/48x36/1' }, async (tab) => {
        assert.equal(await tab.locator('.answer button[tabindex="0"]').count(), 1);
        assert.equal(await tab.locator('.path button[tabindex="0"]').count(), 1);
        await tab.locator('.path [aria-current=true]').focus();
        await tab.keyboard.press('ArrowRight');
        assert.match(await focused(tab), /^frame 2: wrong/);
        await tab.keyboard.press('Enter');
        assert.match(await focused(tab), /^frame 2: wrong/);
        assert.match(tab.url(), /48x36\/2/);
    });

    test('what takes the focus shows it', {}, async (tab) => {
        for (let i = 0; i < 25; ++i) {
            await tab.keyboard.press('Tab');
            const outline = await tab.evaluate(() => {
                const style = getComputedStyle(document.activeElement);
                return [document.activeElement.outerHTML.slice(0, 60), document.activeElement.id === 'answer' || document.activeElement === document.body || (style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2)];
            });
            assert.ok(outline[1], outline[0]);
        }
    });

    test('a filter tells a reader of the screen what is left', {}, async (tab) => {
        await tab.locator('[data-verdict=edge]').click();
        assert.equal(await tab.locator('#said').textContent(), '1 method on 5 chips: 30 cells of 240');
        assert.equal(await tab.locator('#said').getAttribute('aria-live'), 'polite');
    });

    test('everything that is used has a name', { hash: '#cell=tnt/roettger-half/boxes/48x36/0', plots: true }, async (tab) => {
        await tab.locator('.strip .viewer').waitFor();
        const nameless = await tab.evaluate(() => [...document.querySelectorAll('button, a[href], select, input, summary, [role=grid], [role=listbox], [role=application], [role=option]')]
            .filter((node) => !(node.getAttribute('aria-label') || node.textContent.trim() && node.tagName !== 'SELECT' || node.labels?.length))
            .map((node) => node.outerHTML.slice(0, 120)));
        assert.deepEqual(nameless, []);
        const ids = await tab.evaluate(() => [...document.querySelectorAll('[id]')].map((node) => node.id));
        assert.deepEqual(ids.filter((id, at) => ids.indexOf(id) !== at), []);
    });

    /// Texts whose contrast is below WCAG 2's AA: 4.5, or 3 where it is large.
    const faint = (tab) => tab.evaluate(() => {
        const canvas = document.createElement('canvas');
        canvas.width = canvas.height = 1;
        const pen = canvas.getContext('2d', { willReadFrequently: true });
        const parse = (colour) => {
            pen.clearRect(0, 0, 1, 1);
            pen.fillStyle = colour;
            pen.fillRect(0, 0, 1, 1);
            return [...pen.getImageData(0, 0, 1, 1).data];
        };
        const light = ([r, g, b]) => [r, g, b].map((v) => v / 255).map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)).reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
        const within = (box, inner) => inner.left >= box.left && inner.right <= box.right && inner.top >= box.top && inner.bottom <= box.bottom;
        const ground = (node) => {
            // In a drawing the last rectangle before a text that the text stands in.
            for (let before = node; node instanceof SVGElement && before; before = before.previousElementSibling)
                if (before.tagName === 'rect' && within(before.getBoundingClientRect(), node.getBoundingClientRect())) return parse(getComputedStyle(before).fill);
            for (; node; node = node.parentElement) {
                const colour = parse(getComputedStyle(node).backgroundColor);
                if (colour[3] === 255) return colour;
            }
            return [255, 255, 255, 255];
        };
        const seen = new Map();
        const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
        let texts = 0;
        while (walker.nextNode()) {
            const node = walker.currentNode.parentElement;
            if (!walker.currentNode.textContent.trim() || !node.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true }) || ['SCRIPT', 'STYLE', 'NOSCRIPT'].includes(node.tagName)) continue;
            if (node.closest(':disabled')) continue;
            ++texts;
            const style = getComputedStyle(node);
            const inSvg = node instanceof SVGElement;
            const pair = [light(parse(inSvg ? style.fill : style.color)), light(ground(node))];
            const contrast = (Math.max(...pair) + 0.05) / (Math.min(...pair) + 0.05);
            if (contrast < (parseFloat(style.fontSize) >= 24 ? 3 : 4.5)) seen.set(`${node.tagName}.${node.getAttribute('class')}`, `${contrast.toFixed(2)} ${walker.currentNode.textContent.slice(0, 30)}`);
        }
        return { texts, faint: [...seen].map((pair) => pair.join(': ')) };
    });
    for (const scheme of ['light', 'dark']) {
        test(`contrast is AA, ${scheme}`, { scheme, plots: true }, async (tab) => {
            await tab.evaluate(() => document.querySelectorAll('details').forEach((node) => (node.open = true)));
            await tab.locator('[data-verdict=exact]').click();
            const page = await faint(tab);
            assert.ok(page.texts > 150, String(page.texts));
            assert.deepEqual(page.faint, []);
            await tab.locator('[data-verdict=exact]').click();
            await tab.locator('.entry.edge').first().click();
            await tab.locator('.strip .viewer').waitFor();
            assert.deepEqual((await faint(tab)).faint, []);
        });
    }

    test('the theme can be switched', { scheme: 'light' }, async (tab) => {
        const ground = () => tab.evaluate(() => getComputedStyle(document.body).backgroundColor);
        const light = await ground();
        const button = tab.locator('#theme');
        await button.click();
        assert.equal(await ground(), light);
        await button.click();
        assert.notEqual(await ground(), light);
        assert.equal(await button.textContent(), 'Theme: dark');
        await button.click();
        assert.equal(await ground(), light);
    });

    for (const width of [360, 1280, 3840]) {
        test(`no part is wider than the page at ${width} pixels`, { width, plots: true }, async (tab) => {
            const overflow = () => tab.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
            assert.ok((await overflow()) <= 0);
            await tab.evaluate(() => document.querySelectorAll('details').forEach((node) => (node.open = true)));
            assert.ok((await overflow()) <= 0);
            await tab.evaluate(() => document.querySelectorAll('details.pick').forEach((node) => (node.open = false)));
            await tab.locator('.entry.edge').first().click();
            await tab.locator('.strip .viewer').waitFor();
            assert.ok((await overflow()) <= 0);
            assert.ok(await tab.locator('dialog').evaluate((node) => node.scrollWidth <= node.clientWidth));
        });
    }

    test('on paper: the table and no controls', {}, async (tab) => {
        await tab.emulateMedia({ media: 'print' });
        assert.equal(await tab.locator('.filters').isVisible(), false);
        assert.equal(await tab.locator('#theme').isVisible(), false);
        assert.ok(await tab.locator('.answer').isVisible());
        assert.ok(await entryOf(tab).isVisible());
        const pdf = await tab.pdf();
        assert.equal(pdf.subarray(0, 4).toString(), '%PDF');
    });
    const entryOf = (tab) => tab.locator('.entry.edge').first();
});
