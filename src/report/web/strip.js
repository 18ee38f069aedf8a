// The film strip: the buffers after every pass.
import { h } from './dom.js';
import { canvasOf, coloured } from './pictures.js';
import { viewer } from './viewer.js';

/// @param passes  of a drawing: [{pass, title, why, buffers: {name: picture}}]
/// @param get     gives a decoded picture
export function filmStrip(passes, causes, get) {
    const names = [...new Set(passes.flatMap((pass) => Object.keys(pass.buffers)))];
    // First the buffer in which most happens: of a stencil method the stencil, not the colours that stay.
    const changes = (name) => new Set(passes.map((pass) => pass.buffers[name])).size;
    const liveliest = names.reduce((best, name) => (changes(name) >= changes(best) ? name : best), names[0]);
    const state = { at: 0, buffer: liveliest, asked: 0 };
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
            fill();
            show();
        },
    }, names.map((name) => h('option', { value: name, selected: name === liveliest }, name)));
    const button = (label, step) => h('button', { type: 'button', 'aria-label': label, onclick: () => go(state.at + step) }, step < 0 ? '\u25c0' : '\u25b6');
    const node = h('div.strip', {},
        h('div.row', {}, button('Pass before', -1), button('Next pass', 1), names.length > 1 ? h('label.field', {}, 'Buffer ', choice) : null),
        film, h('div.caption', { 'aria-live': 'polite' }, title, why), large);
    const bufferOf = (pass) => (state.buffer in pass.buffers ? state.buffer : Object.keys(pass.buffers)[0]);

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
        show();
    }
    async function show() {
        const { at } = state;
        const pass = passes[at];
        frames.forEach((frame, i) => frame.setAttribute('aria-selected', String(i === at)));
        film.setAttribute('aria-activedescendant', `pass-${at}`);
        // Not scrollIntoView(): that would move the page too.
        const box = frames[at];
        film.scrollLeft = Math.max(Math.min(film.scrollLeft, box.offsetLeft - 8), box.offsetLeft + box.offsetWidth + 8 - film.clientWidth);
        title.textContent = `Pass ${pass.pass} of ${passes.length}: ${pass.title}`;
        why.textContent = pass.why ?? '';
        node.dataset.pass = pass.pass;
        const asked = ++state.asked;
        const here = await Promise.all(Object.entries(pass.buffers).map(async ([name, picture]) => ({ id: name, label: name, picture: await get(picture) })));
        const name = bufferOf(pass);
        const before = at > 0 && passes[at - 1].buffers[name];
        if (before !== false && before !== undefined) here.unshift({ id: 'before', label: `${name} before`, picture: await get(before) });
        if (asked !== state.asked || !here.length) return;
        const sameSize = here.filter(({ picture }) => picture.width === here.at(-1).picture.width && picture.height === here.at(-1).picture.height);
        const view = viewer(sameSize, causes, { label: 'Buffers after the pass', pair: ['before', name], divider: state.divider ?? 0, keep: ({ divider }) => (state.divider = divider) });
        large.replaceChildren(view.node);
        view.draw();
    }
    fill();
    show();
    return node;
}
