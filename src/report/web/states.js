// The mask's states (Figures 2 and 5 of Roettger et al. 2002): values on a line, what leads from one to another as arcs.
import { svg, themeColour } from './dom.js';
import { widthOf } from './labels.js';

const titleHigh = 24;  // pixels

const number = (label) => parseFloat(String(label).match(/-?[\d.]+/)?.[0] ?? 'NaN');

/// @param state  {nodes: [{id, label, kind}], edges: [{from, to, label}]}
/// @return       an SVG that stands alone: all colours are in it
export function stateGraph({ profile, method, nodes, edges }) {
    const order = nodes.map((node, at) => ({ ...node, at })).sort((a, b) => number(a.label) - number(b.label) || a.at - b.at);
    const longest = Math.max(3, ...order.map((node) => String(node.label).length));
    const words = order.map((node) => (node.kind && node.kind !== 'value' ? String(node.kind).split(', ') : []));
    const tall = 12 * Math.max(0, ...words.map((lines) => lines.length));
    const gap = Math.max(52, 8 * longest + 22, 12 + 5.8 * Math.max(0, ...words.flat().map((word) => word.length))), side = gap / 2 + 8;
    const place = new Map(order.map((node, i) => [node.id, side + i * gap]));
    const kinds = [...new Set(edges.map((edge) => kindOf(edge)))];
    const colours = kinds.map((_, i) => themeColour(`--series-${(i % 8) + 1}`));
    // An arc is as high as it is wide, up to a limit; those to the right run above, those to the left below.
    const rise = (edge) => Math.min(150, 18 + 0.42 * Math.abs(place.get(edge.to) - place.get(edge.from)));
    const above = Math.max(36, ...edges.filter((e) => place.get(e.to) >= place.get(e.from)).map(rise)) + 16 + titleHigh;
    const below = Math.max(36, ...edges.filter((e) => place.get(e.to) < place.get(e.from)).map(rise)) + 16 + tall;
    const title = `${profile}, ${method}`;
    const width = Math.max(260, widthOf(title) + 16, side * 2 + gap * Math.max(0, order.length - 1)), height = above + below + 16 + 22 * kinds.length;
    const ink = themeColour('--ink'), paper = themeColour('--raised'), muted = themeColour('--muted');
    const root = svg('svg', {
        xmlns: 'http://www.w3.org/2000/svg', width, height, viewBox: `0 0 ${width} ${height}`, role: 'img',
        'font-family': 'sans-serif', 'font-size': 12,
        'aria-label': `States of the mask, ${method} on ${profile}: ${order.length} values, ${edges.length} steps`,
    });
    root.append(svg('rect', { width: '100%', height: '100%', fill: paper }), svg('text', { x: 8, y: 16, fill: ink }, title));
    const defs = svg('defs');
    kinds.forEach((_, i) => defs.append(svg('marker', { id: `tip-${i}`, viewBox: '0 0 8 8', refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: 'auto-start-reverse' },
        svg('path', { d: 'M0 0 8 4 0 8z', fill: colours[i] }))));
    root.append(defs);
    for (const edge of edges) {
        const kind = kinds.indexOf(kindOf(edge));
        const from = place.get(edge.from), to = place.get(edge.to);
        if (from === undefined || to === undefined) continue;
        const up = to >= from ? -1 : 1;
        const start = up < 0 ? above - 12 : above + 14 + tall;
        const top = start + up * rise(edge) * 1.25;
        const d = from === to
            ? `M${from - 8} ${above - 10}C${from - 20} ${above - 42} ${from + 20} ${above - 42} ${from + 8} ${above - 12}`
            : `M${from + (to > from ? 6 : -6)} ${start}C${from + (to - from) * 0.2} ${top} ${to - (to - from) * 0.2} ${top} ${to - (to > from ? 6 : -6)} ${start}`;
        root.append(svg('path', { d, fill: 'none', stroke: colours[kind], 'stroke-width': 1.6, 'stroke-dasharray': dash(kind), 'marker-end': `url(#tip-${kind})` },
            svg('title', {}, `${edge.from} \u2192 ${edge.to}: ${edge.label}`)));
    }
    order.forEach((node, i) => {
        const wide = Math.max(24, 8 * String(node.label).length + 10), x = place.get(node.id);
        const dark = node.kind === 'in shadow', start = words[i].includes('start');
        root.append(svg('rect', { x: x - wide / 2, y: above - 12, width: wide, height: 24, rx: 12, fill: dark ? ink : paper, stroke: ink, 'stroke-width': start ? 3 : 1.2 }),
            svg('text', { x, y: above + 4, 'text-anchor': 'middle', fill: dark ? paper : ink }, String(node.label)),
            ...words[i].map((word, line) => svg('text', { x, y: above + 24 + 12 * line, 'text-anchor': 'middle', fill: muted, 'font-size': 10.5 }, word)));
    });
    kinds.forEach((kind, i) => {
        const y = above + below + 20 + 22 * i;
        root.append(svg('line', { x1: 12, x2: 44, y1: y - 4, y2: y - 4, stroke: colours[i], 'stroke-width': 1.6, 'stroke-dasharray': dash(i), 'marker-end': `url(#tip-${i})` }),
            svg('text', { x: 52, y, fill: ink }, kind));
    });
    return root;
}

/// Edges of one label are of one kind; a number in it doesn't tell them apart.
const kindOf = (edge) => String(edge.label);
const dash = (kind) => ['none', '6 3', '2 3', '8 3 2 3'][kind % 4];
