// The film strip: the buffers after every pass.
import { pixelOf } from './address.js';
import { h } from './dom.js';
import { canvasOf, coloured } from './pictures.js';
import { viewer } from './viewer.js';

/// @param passes  of a drawing: [{pass, title, why, buffers: {name: picture}}]
/// @param get     gives a decoded picture
/// @param begin   {pass, buffer, pass-zoom, pass-pixel}, as views in state.js has it
/// @param look    takes what is new of that
export function filmStrip(passes, causes, get, begin, look) {
    const names = [...new Set(passes.flatMap((pass) => Object.keys(pass.buffers)))];
    // First the buffer in which most happens: of a stencil method the stencil, not the colours that stay.
    const changes = (name) => new Set(passes.map((pass) => pass.buffers[name])).size;
    const liveliest = names.reduce((best, name) => (changes(name) >= changes(best) ? name : best), names[0]);
    const state = {
        at: Math.max(0, passes.findIndex(({ pass }) => String(pass) === begin.pass)), buffer: begin.buffer || liveliest, zoom: begin['pass-zoom'],
        pixel: begin['pass-pixel'], asked: 0,
    };
    const keep = () => look({ pass: String(passes[state.at].pass), buffer: state.buffer === liveliest ? '' : state.buffer, 'pass-zoom': state.zoom, 'pass-pixel': state.pixel });
    const frames = passes.map((pass, at) =>
        h('div.frame', { role: 'option', id: `pass-${at}`, 'aria-label': `pass ${pass.pass}: ${pass.title}`, onclick: () => go(at) },
            h('span.number', {}, pass.pass)));
    const film = h('div.film', {
        role: 'listbox', tabIndex: 0, 'aria-label': 'Passes: left and right arrow step', 'aria-orientation': 'horizontal',
    }, frames);
    const title = h('h4');
    const why = h('p.why');
    const large = h('div');
    const choice = h('select', {
        'aria-label': 'Buffer of the film strip',
        onchange: () => {
            state.buffer = choice.value;
            keep();
            fill();
            show();
        },
    }, names.map((name) => h('option', { value: name, selected: name === state.buffer }, name)));
    const button = (label, step) => h('button', { type: 'button', 'aria-label': label, onclick: () => go(state.at + step) }, step < 0 ? '\u25c0' : '\u25b6');
    const node = h('div.strip', {},
        h('div.row', {}, button('Pass before', -1), button('Next pass', 1), names.length > 1 ? h('label.field', {}, 'Buffer ', choice) : null,
            h('div.caption', { 'aria-live': 'polite' }, title, why)),
        film, large);
    const bufferOf = (pass) => (state.buffer in pass.buffers ? state.buffer : Object.keys(pass.buffers)[0]);

    /// What is left of the window's height beside the strip's own parts and the head of the dialog.
    const room = () => {
        const head = node.closest('dialog')?.querySelector('.cell-head')?.offsetHeight ?? 0;
        const parts = [...node.children].filter((part) => part !== large).reduce((sum, part) => sum + part.offsetHeight + 8, 0);
        return Math.max(120, 0.96 * window.innerHeight - head - parts - 100);
    };
    film.addEventListener('focus', bringIntoView);
    film.addEventListener('keydown', (event) => {
        const to = { ArrowLeft: state.at - 1, ArrowRight: state.at + 1, Home: 0, End: passes.length - 1 }[event.key];
        if (to === undefined) return;
        event.preventDefault();
        go(to);
    });

    /// Small pictures of all passes.
    async function fill() {
        const buffer = state.buffer;
        for (const [at, pass] of passes.entries()) {
            const name = bufferOf(pass);
            if (!name) continue;
            const small = canvasOf(coloured(await get(pass.buffers[name]), causes));
            if (buffer !== state.buffer) return;
            small.setAttribute('aria-hidden', 'true');
            frames[at].querySelector('canvas')?.remove();
            frames[at].prepend(small);
        }
    }
    function go(to) {
        state.at = Math.max(0, Math.min(passes.length - 1, to));
        keep();
        show();
        bringIntoView();
    }
    /// All of the strip, its large picture too, which is as high as what the window has left.
    function bringIntoView() {
        const scroller = node.closest('dialog'), head = scroller?.querySelector('.cell-head');
        if (!scroller) return;
        const box = node.getBoundingClientRect(), top = getComputedStyle(head).position === 'sticky' ? head.getBoundingClientRect().bottom : 0;
        if (box.top < top || box.bottom > window.innerHeight) scroller.scrollTop += box.top - top - 8;
    }
    async function show() {
        const { at } = state;
        const pass = passes[at];
        frames.forEach((frame, i) => frame.setAttribute('aria-selected', String(i === at)));
        film.setAttribute('aria-activedescendant', `pass-${at}`);
        title.textContent = `Pass ${pass.pass} of ${passes.at(-1).pass}: ${pass.title}`;
        why.textContent = pass.why ?? '';
        node.dataset.pass = pass.pass;
        const asked = ++state.asked;
        const here = await Promise.all(Object.entries(pass.buffers).map(async ([name, picture]) => ({ id: name, label: name, picture: await get(picture) })));
        const name = bufferOf(pass);
        const before = at > 0 && passes[at - 1].buffers[name];
        if (before !== false && before !== undefined) here.unshift({ id: 'before', label: `${name} before`, picture: await get(before) });
        if (asked !== state.asked) return;
        // By now the strip is laid out. Not scrollIntoView(): that would move the page too.
        const box = frames[at];
        film.scrollLeft = Math.max(Math.min(film.scrollLeft, box.offsetLeft - 8), box.offsetLeft + box.offsetWidth + 8 - film.clientWidth);
        if (!here.length) return;
        const sameSize = here.filter(({ picture }) => picture.width === here.at(-1).picture.width && picture.height === here.at(-1).picture.height);
        const view = viewer(sameSize, causes, {
            label: 'Buffers after the pass', pair: ['before', name], divider: state.divider ?? 0, zoom: Number(state.zoom), pixel: pixelOf(state.pixel), height: room,
            keep({ divider, zoom, pixel }) {
                state.divider = divider;
                if (zoom === state.zoom && pixel === state.pixel) return;
                state.zoom = zoom, state.pixel = pixel;
                keep();
            },
        });
        large.replaceChildren(view.node);
        view.draw();
    }
    fill();
    show();
    return node;
}
