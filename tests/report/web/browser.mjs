// What the tests of the page share: a browser, and a report opened from disk, of which every request and every word on the
// console is written down.
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { it } from 'node:test';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { makeReport, makeRun } from './fixture.mjs';

const web = new URL('../../../src/report/web/package.json', import.meta.url);
export const page = process.env.GNOMON_REPORT_PAGE;
const chromiums = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
const program = process.env.GNOMON_CHROMIUM ?? chromiums.find((path) => existsSync(path));

/// Playwright, or null with a word why.
function playwright() {
    try {
        return createRequire(web)('playwright-core');
    } catch {
        return null;
    }
}

/// Why the tests can't run; empty if they can.
export const skip = !program ? 'no chromium here' : !playwright() ? 'src/report/web/node_modules is missing: run ./setup'
    : !page || !existsSync(page) ? 'the bundled page is missing: build the target report_page' : false;

const folder = mkdtempSync(join(tmpdir(), 'gnomon-web-'));
let browser = null;

export async function openBrowser() {
    browser = await playwright().chromium.launch({ executablePath: program, args: ['--no-sandbox', '--disable-gpu'] });
    return browser;
}
export async function closeBrowser() {
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
}

/// Writes the report of a run; @return its address.
export function reportFile(name, made) {
    const file = join(folder, name);
    writeFileSync(file, makeReport(readFileSync(page, 'utf8'), made));
    return pathToFileURL(file).href;
}

const once = (make) => {
    let made = null;
    return () => (made ??= make());
};
export const smallRun = once(() => makeRun());
export const smallReport = once(() => reportFile('small.html', smallRun()));
/// The same, compared with an older run.
export const comparedReport = once(() => reportFile('compared.html', makeRun({ withCompare: true })));

/// Opens a report at an address.
/// @return  the page; `page.faults` are errors, warnings and requests that leave the file
export async function open(address = smallReport(), { hash = '', width = 1280, height = 900, scheme = 'light', motion = 'no-preference', plots = false } = {}) {
    const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, reducedMotion: motion, acceptDownloads: true });
    const tab = await context.newPage();
    tab.faults = [];
    tab.on('request', (request) => {
        if (!/^(data|blob):/.test(request.url()) && request.url().split('#')[0] !== address) tab.faults.push(`request ${request.url()}`);
    });
    tab.on('console', (message) => {
        if (['error', 'warning'].includes(message.type())) tab.faults.push(`${message.type()}: ${message.text()}`);
    });
    tab.on('pageerror', (error) => tab.faults.push(`error: ${error.message}`));
    await tab.goto(address + hash);
    await tab.waitForFunction(() => document.documentElement.dataset.ready);
    if (plots) await tab.waitForFunction(() => [...document.querySelectorAll('figure.plot')].every((plot) => plot.dataset.drawn));
    return tab;
}
export const close = (tab) => tab.context().close();

/// A test on a page of its own, that must be without faults at the end.
/// @param options  of open(), and address(): of another report than the small one
export const onPage = (name, options, body) => it(name, async () => {
    const tab = await open(options.address?.() ?? smallReport(), options);
    await body(tab);
    assert.deepEqual(tab.faults, []);
    await close(tab);
});

/// The text of what is focused: its label, else its words.
export const focused = (tab) => tab.evaluate(() => document.activeElement.getAttribute('aria-label') ?? document.activeElement.textContent);

/// Closes a cell by its key. A dialog tells of it after the key: what is there before that is still the cell's.
export async function escape(tab) {
    await tab.keyboard.press('Escape');
    await tab.waitForFunction(() => !document.querySelector('dialog.cell').firstChild);
}

/// A downloaded file's name and text.
export async function download(tab, act) {
    const [file] = await Promise.all([tab.waitForEvent('download'), act()]);
    return { name: file.suggestedFilename(), text: readFileSync(await file.path(), 'utf8') };
}
