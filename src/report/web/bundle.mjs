// Makes the report's page: page.html with its style and its modules in one file, and Vega packed in it.
//   node bundle.mjs OUTPUT.html
import { build } from 'esbuild';
import { readFile, rename, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const output = process.argv[2];
if (!output) {
    console.error('bundle: node bundle.mjs OUTPUT.html');
    process.exit(2);
}

const minified = async (file, options) => {
    const result = await build({
        absWorkingDir: here,
        entryPoints: [join(here, file)],
        bundle: true,
        minify: true,
        write: false,
        legalComments: 'none',
        charset: 'utf8',
        logLevel: 'warning',
        // Vega-Lite takes four small functions from all of Vega; they stand in its vega-util. vega.js names the rest.
        alias: { vega: 'vega-util' },
        ...options,
    });
    return result.outputFiles[0].text.trim();
};

const script = (file, options) => minified(file, { format: 'iife', target: ['es2022'], ...options });

// "<!--" inside a script would start a comment of HTML there.
const style = await minified('page.css', {});
const main = (await script('main.js')).replaceAll('<!--', '<\\!--');
const vega = Buffer.from(await script('vega.js', { globalName: 'packed' }));
const page = await readFile(join(here, 'page.html'), 'utf8');
const put = (text, mark, what) => {
    if (text.split(mark).length !== 2) throw new Error(`page.html: ${mark} must stand there once`);
    return text.replace(mark, () => what);
};
const packed = `<script type="text/plain" id="packed-vega" data-length="${vega.length}">${deflateRawSync(vega, { level: 9 }).toString('base64')}</script>`;
const parts = { '/* page.css */': style, '/* main.js */': main, '<!-- vega.js -->': packed };
const whole = Object.entries(parts).reduce((text, [mark, what]) => put(text, mark, what), page);
if (whole.split('<!-- gnomon:data -->').length !== 2)
    throw new Error('page.html: <!-- gnomon:data --> must stand there once');

// Beside it, then renamed: a page is never half there.
await writeFile(`${output}.part`, whole);
await rename(`${output}.part`, output);
