// The page without a mouse, in both themes, at all widths, on paper.
import assert from 'node:assert/strict';
import { after, before, describe } from 'node:test';
import { closeBrowser, comparedReport, escape, focused, onPage as test, openBrowser, reportFile, skip } from './browser.mjs';
import { makeRun } from './fixture.mjs';

describe('report page, for all', { skip }, () => {
    before(openBrowser);
    after(closeBrowser);

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
        await escape(tab);
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

    test('keys of an opened cell from its heading: frames, and the pictures', { hash: '#cell=tnt/roettger-half/boxes/48x36/0' }, async (tab) => {
        const frame = () => tab.locator('dialog p.muted').first().textContent();
        const view = tab.locator('.pictured .viewer').first();
        await view.waitFor();
        const pair = () => view.locator('select').evaluateAll((all) => all.map((node) => node.value));
        const before = await pair(), scale = Number(await view.getAttribute('data-scale'));
        await tab.keyboard.press('s');
        assert.deepEqual(await pair(), before.reverse());
        await tab.keyboard.press('+');
        assert.equal(Number(await view.getAttribute('data-scale')), 2 * scale);
        await tab.keyboard.press('0');
        assert.equal(Number(await view.getAttribute('data-scale')), scale);
        await tab.keyboard.press('b');
        assert.equal(await view.locator('[data-do=blink]').getAttribute('aria-pressed'), 'true');
        await tab.keyboard.press('ArrowLeft');
        assert.match(await frame(), /^boxes, frame 0/);
        await tab.keyboard.press('ArrowRight');
        assert.match(await frame(), /^boxes, frame 1/);
        await tab.keyboard.press('ArrowRight');
        await tab.keyboard.press('ArrowLeft');
        assert.match(await frame(), /^boxes, frame 1/);
        assert.match(await focused(tab), /roettger-half on NVIDIA/);
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
        assert.equal(await tab.locator('#said').textContent(), '1 method on 5 chips: 30 cells of 240, in entries whose worst verdict is edge');
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

    for (const scheme of ['light', 'dark'])
        test(`a pressed filter keeps the marks of its symbol, ${scheme}`, { scheme, hash: '#verdict=wrong,failed' }, async (tab) => {
            for (const verdict of ['wrong', 'failed']) {
                // In the middle of the cross, and beside it; on the stem of the mark, and beside it.
                const [mark, ground] = verdict === 'wrong' ? [[8, 8], [8, 2.5]] : [[8, 8], [5.8, 13]];
                const picture = await tab.locator(`[data-verdict=${verdict}] svg`).screenshot();
                const lights = await tab.evaluate(async ([bytes, places]) => {
                    const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))]));
                    const pen = Object.assign(document.createElement('canvas'), { width: bitmap.width, height: bitmap.height }).getContext('2d', { willReadFrequently: true });
                    pen.drawImage(bitmap, 0, 0);
                    return places.map(([x, y]) => pen.getImageData((x * bitmap.width) / 16, (y * bitmap.height) / 16, 1, 1).data[1]);
                }, [picture.toString('base64'), [mark, ground]]);
                assert.ok(Math.abs(lights[0] - lights[1]) > 60, `${verdict}: ${lights}`);
            }
        });

    test('with one column the names of the lines take no more than they need', { hash: '#profile=tnt' }, async (tab) => {
        const [name, entry] = await tab.locator('.answer tbody tr').first().evaluate((row) => [...row.cells].map((cell) => cell.offsetWidth));
        assert.ok(name < 250 && entry > 800, `${name} ${entry}`);
    });

    for (const width of [1280, 3840])
        test(`the table is as wide as its box at ${width} pixels, and cuts nothing that has room`, { width }, async (tab) => {
            const { box, table } = await tab.evaluate(() => ({ box: document.querySelector('.answer-box').clientWidth, table: document.querySelector('.answer').offsetWidth }));
            assert.equal(table, box);
            assert.deepEqual(await tab.locator('.what').evaluateAll((all) => all.filter((node) => node.scrollHeight > node.clientHeight + 2).map((node) => node.textContent)), []);
        });

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

    test('no column of the table is a trap: from every corner all four arrows move on, or stay where nothing is beyond', {}, async (tab) => {
        const at = () => tab.evaluate(() => {
            const cell = document.activeElement.closest('.answer td, .answer th');
            return cell ? [cell.parentNode.rowIndex, cell.cellIndex] : null;
        });
        const press = async (from, key) => {
            await tab.locator('.answer').evaluate((table, [row, column]) => table.rows[row].cells[column].querySelector('button').focus(), from);
            await tab.keyboard.press(key);
            return at();
        };
        const moves = { // 9 rows of 6 columns; of the first only the heading is a button
            '0,0': { ArrowUp: [0, 0], ArrowDown: [1, 1], ArrowLeft: [0, 0], ArrowRight: [0, 1] },
            '0,5': { ArrowUp: [0, 5], ArrowDown: [1, 5], ArrowLeft: [0, 4], ArrowRight: [0, 5] },
            '8,1': { ArrowUp: [7, 1], ArrowDown: [8, 1], ArrowLeft: [8, 1], ArrowRight: [8, 2] },
            '8,5': { ArrowUp: [7, 5], ArrowDown: [8, 5], ArrowLeft: [8, 4], ArrowRight: [8, 5] },
        };
        for (const [from, keys] of Object.entries(moves))
            for (const [key, to] of Object.entries(keys)) assert.deepEqual(await press(from.split(',').map(Number), key), to, `${from} ${key}`);
        assert.deepEqual(await press([0, 0], 'PageDown'), [8, 1]);
        assert.deepEqual(await press([8, 5], 'Control+Home'), [0, 0]);
        await tab.keyboard.press('ArrowDown');
        assert.deepEqual(await at(), [1, 1]);
    });

    test('the skip link keeps what was filtered', { hash: '#verdict=edge' }, async (tab) => {
        await tab.keyboard.press('Tab');
        await tab.keyboard.press('Enter');
        assert.equal(await tab.evaluate(() => document.activeElement.id), 'answer');
        assert.equal(new URL(tab.url()).hash, '#verdict=edge');
        assert.equal(await tab.locator('.answer tbody tr').count(), 1);
    });

    test('the table is explained above it, every sign of it', { address: comparedReport, hash: '#changed=all' }, async (tab) => {
        const legend = tab.locator('.legend');
        assert.ok((await legend.boundingBox()).y < (await tab.locator('.answer').boundingBox()).y);
        assert.equal(await legend.locator('dl').isVisible(), false);
        await legend.locator('summary').click();
        const signs = await legend.locator('dt').allTextContents();
        // What stands in entries beside numbers and words is named there.
        const used = await tab.locator('.entry').evaluateAll((nodes) => [...new Set(nodes.flatMap((node) => [...node.querySelectorAll('.line > *')].map((part) => part.textContent)).filter(Boolean))]);
        const of = (text) => (/^\+\d/.test(text) ? '+3' : /\*$/.test(text) ? '*' : /\d\u2013\d.*\//.test(text) ? '1\u201313/4' : /^\d+\/\d+/.test(text) ? '2/3' : / px$/.test(text) ? '72 px' : /^\u00d7/.test(text) ? '\u00d72.7' : text);
        const lacks = ['stencil', 'blend equation max'];
        const unnamed = [...new Set(used.map(of))].filter((sign) => !signs.includes(sign) && !lacks.includes(sign));
        assert.deepEqual(unnamed, []);
        for (const sign of ['+3', '\u0394', '*', '1\u201313/4']) assert.ok(used.map(of).includes(sign), sign);
    });

    const paper = { width: 1047, height: 718 };  // A4 on its side without its margins, at 96 pixels an inch
    const wide = () => {
        const made = makeRun({ chipCount: 41, methodCount: 21, frames: 2, scenes: ['boxes'] });
        for (const list of made.run.cells.columns.missing.dictionary) if (list.length) list[0] = { ...list[0], what: 'alpha blend factors one_minus_dst_color zero (only zero, one)' };
        return reportFile('wide.html', made);
    };
    test('on paper: all of the table, drawn plots, no controls', { address: wide, ...paper, scheme: 'dark', plots: true }, async (tab) => {
        await tab.emulateMedia({ media: 'print' });
        await tab.locator('.sheets').waitFor();
        await tab.waitForFunction(() => document.querySelectorAll('.plot-box > svg[width="470"], .plot-box > * svg[width="470"]').length === 3);
        for (const control of ['.filters', '#theme', '.tools', '.method-marks', '.answer-box', '.plot button']) assert.equal(await tab.locator(control).first().isVisible(), false, control);
        const cut = await tab.evaluate(() => [...document.querySelectorAll('.sheets .answer, .sheets .entry, .sheets th, .sheets .what, .plot-box svg, .graph svg')].filter((node) => {
            const box = node.getBoundingClientRect();
            return box.width < 1 || box.right > innerWidth + 1 || (node.tagName !== 'svg' && node.scrollWidth > node.clientWidth + 1);
        }).map((node) => `${node.tagName} ${node.textContent.slice(0, 40)}`));
        assert.deepEqual(cut, []);
        assert.equal(await tab.locator('.sheets .entry').count(), 41 * 21);
        assert.ok(await tab.locator('.sheets .entry').evaluateAll((nodes) => nodes.every((node) => parseFloat(getComputedStyle(node).fontSize) >= 8)));
        assert.ok(await tab.locator('.plot-box svg').evaluateAll((all) => all.length === 4 && all.every((node) => node.getBoundingClientRect().height > 100)));
        // A printer leaves out of a repeated head what is placed in another way, and buttons.
        assert.deepEqual(await tab.locator('.sheets thead :is(th, .head)').evaluateAll((nodes) => [...new Set(nodes.map((node) => getComputedStyle(node).display === 'contents' || getComputedStyle(node).position))]), ['static', true]);
        assert.deepEqual(await tab.locator('.section-head').evaluateAll((nodes) => nodes.map((node) => getComputedStyle(node).breakAfter)), ['avoid', 'avoid']);
        // The paper is white, whatever the theme.
        assert.equal(await tab.evaluate(() => getComputedStyle(document.documentElement).backgroundColor), 'rgb(255, 255, 255)');
        assert.equal(await tab.locator('.result').evaluate((node) => getComputedStyle(node).color), 'rgb(30, 35, 39)');
        await tab.emulateMedia({ media: 'screen' });
        await tab.locator('.answer-box').waitFor();
        assert.equal(await tab.locator('.sheets').count(), 0);
        assert.equal(await tab.evaluate(() => document.documentElement.dataset.theme ?? 'none'), 'none');
    });

    test('on paper: what the filters leave out is said', { ...paper, hash: '#verdict=wrong&text=clamps&sort=tnt:up&figure=ratio' }, async (tab) => {
        assert.equal(await tab.locator('.only').isVisible(), false);
        await tab.emulateMedia({ media: 'print' });
        assert.equal(await tab.locator('.only').textContent(), 'Only: verdict wrong; words clamps; sorted by tnt, time ratio, best first.');
        assert.ok(await tab.locator('.only').isVisible());
    });

    test('on paper: plots that were put off are drawn before the printer begins', { plots: true }, async (tab) => {
        // A filter changes the plots 60 ms later, and the printer comes at once.
        const seen = await tab.evaluate(async () => {
            document.querySelector('[data-verdict=exact]').click();
            await Promise.resolve();
            window.dispatchEvent(new Event('beforeprint'));
            for (let i = 0; i < 300; ++i) await Promise.resolve();
            const hasOld = document.querySelector('#plot-passes svg').textContent.includes('williams');
            return [hasOld, ...['accuracy', 'path', 'passes'].map((id) => [document.querySelector(`#plot-${id}`).dataset.drawn > 0, document.querySelectorAll(`#plot-${id} svg`).length, document.querySelector(`#plot-${id} svg`)?.getAttribute('width') < 490])];
        });
        assert.deepEqual(seen, [false, ...Array(3).fill([true, 1, true])]);
        const pages = (await tab.pdf({ preferCSSPageSize: true })).toString('latin1').match(/\/Type\s*\/Page\b/g).length;
        assert.ok(pages >= 2, String(pages));
    });

    test('on paper: an opened cell alone, with its pictures', { hash: '#cell=tnt/roettger-half/boxes/48x36/0', ...paper }, async (tab) => {
        await tab.locator('.strip .viewer').waitFor();
        await tab.emulateMedia({ media: 'print' });
        assert.equal(await tab.locator('h1').isVisible(), false);
        assert.ok(await tab.locator('dialog .viewer canvas').first().isVisible());
        // The names of the two pictures stand above them.
        assert.ok(await tab.locator('dialog .viewer select').first().isVisible());
        assert.ok(await tab.evaluate(() => [...document.querySelectorAll('dialog canvas, dialog pre, dialog code')].every((node) => node.getBoundingClientRect().right <= innerWidth)));
    });
});
