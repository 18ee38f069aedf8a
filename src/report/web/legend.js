// How the table is read: every sign that stands in it.
import { h, symbolOf } from './dom.js';

const meanings = {
    exact: 'every pixel that can be judged is lit or in shadow as exact ray tracing says',
    edge: 'wrong pixels, all within one mask pixel of the true boundary of a shadow',
    wrong: 'wrong pixels away from the boundaries: a leak or a hole',
    refused: 'the chip lacks what the method needs, so nothing was drawn; the first lack stands below',
    failed: 'a fault of gnomon or of the driver',
};

/// @param compares  whether cells that changed are marked
export const legend = (compares) => h('details.legend', {}, h('summary', {}, 'How to read the table'),
    h('p', {}, 'An entry puts together all scenes and frames that the filters leave: the worst verdict counts.'),
    h('dl', {}, Object.entries(meanings).map(([verdict, meaning]) => h('div', {}, h('dt', {}, symbolOf(verdict), verdict), h('dd', {}, meaning))),
        [
            ['2/3', 'scene passes / rectangles over the whole window, as the OpenGL calls were counted'],
            ['1\u201313/4', 'from 1 to 13 scene passes: they differ over scenes and frames; the order by passes goes by the most'],
            ['*', 'the path that gnomon takes on this chip'],
            ['72 px', 'wrong pixels, added over scenes and frames'],
            ['\u00d72.7', 'the host\u2019s time of a frame by that of the same frame without shadows, the median; no time of the chip'],
            ['+3', 'three further things that the chip lacks; the opened cell names them with their sources'],
            ['\u25b2 \u25bc', 'the table is sorted by this column, best or worst first; a press on a heading turns it'],
            compares && ['\u0394', 'cells of this entry changed since the old run'],
        ].filter(Boolean).map(([sign, meaning]) => h('div', {}, h('dt', {}, sign), h('dd', {}, meaning)))),
    h('p.keys', {}, 'Arrow keys, Home, End, Page up and Page down walk over the table, with Control Home and End to its corners; Enter opens an entry\u2019s worst cell.'));
