// Vega-Lite without eval and without a network. It is most of the page, so it stands packed in it: see lazy.js.
import { transforms } from 'vega-dataflow';
import * as encoding from 'vega-encode';
import { expressionInterpreter } from 'vega-interpreter';
import { compile } from 'vega-lite';
import { loader } from 'vega-loader';
import { parse } from 'vega-parser';
import * as data from 'vega-transforms';
import { View } from 'vega-view';
import * as marks from 'vega-view-transforms';

// Only what these plots use; all of Vega (maps, forces, clouds of words) is a sixth more of the page.
Object.assign(transforms, data, marks, encoding);

/// A loader that loads nothing.
const noLoader = Object.assign(loader(), {
    load: () => Promise.reject(new Error('the report loads nothing')),
    sanitize: () => Promise.reject(new Error('the report links to nothing')),
});

// A plot of no rows warns of its empty scales; that is said beside it.
const quiet = Object.fromEntries(['level', 'error', 'warn', 'info', 'debug'].map((name) => [name, function () { return this; }]));

/// Draws a specification of Vega-Lite. Nothing in it waits for more than a promise that is kept already: paper doesn't wait.
/// @param page      of pageConfig(): the page's colours and letters
/// @param width     of the whole, pixels
/// @param labelsOf  gives the rows of the data "labels" once the scales are known; may be left out
/// @return          Vega's view
export async function drawPlot(spec, page, box, width, labelsOf) {
    const legend = width < 560 ? { orient: 'bottom', columns: 2 } : { orient: 'right' };
    const { spec: vega } = compile({
        $schema: 'https://vega.github.io/schema/vega-lite/v6.json', width, autosize: { type: 'fit-x', contains: 'padding' }, ...spec,
        config: { ...page, legend: { ...page.legend, ...legend } },
    }, { logger: quiet });
    const view = new View(parse(vega, null, { ast: true }), { expr: expressionInterpreter, renderer: 'svg', loader: noLoader, logger: quiet });
    view.initialize(box);
    await view.runAsync();
    if (labelsOf) await view.data('labels', labelsOf({ x: view.scale('x'), y: view.scale('y'), width: view.width(), height: view.height() })).runAsync();
    return view;
}
