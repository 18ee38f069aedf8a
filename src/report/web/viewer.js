// Two pictures of one window, one on each side of a divider; zoomed to single pixels with their values.
import { h, say, themeColour } from './dom.js';
import { canvasOf, coloured, valueText } from './pictures.js';

const calm = matchMedia('(prefers-reduced-motion: reduce)');

/// @param views    [{id, label, picture}], decoded, all of one size
/// @param options  {pair: [left id, right id], divider: 0..1, zoom: pixels of the screen for one of the picture (0: all of it is
///                 seen), pixel: {x, y} or null, height(): of the window that the picture may take, label, keep(what the reader
///                 chose: {pair, divider, zoom, pixel}, the last two as text)}
export function viewer(views, causes, options) {
    const byId = new Map(views.map((view) => {
        const image = coloured(view.picture, causes);
        return [view.id, { ...view, colours: image.data, canvas: canvasOf(image) }];
    }));
    const { width, height } = views[0].picture;
    const has = (id, otherwise) => (byId.has(id) ? id : otherwise);
    const state = {
        left: has(options.pair[0], views[0].id), right: has(options.pair[1], views.at(-1).id),
        divider: options.divider ?? 0.5, scale: (options.zoom ?? 0) * (window.devicePixelRatio || 1), x: 0, y: 0, cursor: null, pinned: null, blinking: 0, blinked: false,
    };
    let isPlaced = false;  // whether the pixel of the address has been brought into view

    const canvas = h('canvas');
    const stage = h('div.stage', {
        tabIndex: 0, role: 'application',
        'aria-label': `${options.label}: arrow keys walk over pixels, plus and minus zoom, brackets move the divider, b blinks, s swaps`,
    }, canvas);
    const chooser = (side, label) => h('select', {
        'aria-label': label,
        onchange: (event) => {
            state[side] = event.target.value;
            chose();
        },
    }, views.map((view) => h('option', { value: view.id }, view.label)));
    const selects = { left: chooser('left', 'Picture on the left'), right: chooser('right', 'Picture on the right') };
    const slider = h('input', {
        type: 'range', min: 0, max: 100, step: 1, 'aria-label': 'Divider, percent of the width',
        oninput: () => {
            state.divider = slider.value / 100;
            chose();
        },
    });
    const blinkButton = h('button', { type: 'button', 'data-do': 'blink', onclick: () => blink() });
    const zoomed = h('output.zoom', { 'aria-label': 'Zoom' });
    const values = h('dl.values');
    const node = h('div.viewer', {},
        h('div.row', {}, selects.left, h('button', { type: 'button', 'data-do': 'swap', onclick: () => swap() }, 'Swap'), selects.right, blinkButton,
            h('span.group', {},
                h('button', { type: 'button', 'aria-label': 'Zoom out', onclick: () => zoom(-1) }, '\u2212'), zoomed,
                h('button', { type: 'button', 'aria-label': 'Zoom in', onclick: () => zoom(1) }, '+'),
                h('button', { type: 'button', onclick: () => fit() }, 'Fit'))),
        stage, slider, values);

    const ratio = () => window.devicePixelRatio || 1;
    /// Device pixels that a pixel of the picture fills where all of it is seen.
    const fitted = () => {
        const room = Math.min((stage.clientWidth * ratio()) / width, ((options.height?.() ?? Math.max(240, window.innerHeight * 0.6)) * ratio()) / height);
        return room >= 1 ? Math.floor(room) : room;
    };
    const scaleNow = () => state.scale || fitted();

    function draw() {
        if (!node.isConnected || !stage.clientWidth) return;
        if (!isPlaced) place();
        const whole = fitted(), scale = scaleNow();
        canvas.width = Math.round(width * whole), canvas.height = Math.round(height * whole);
        canvas.style.width = `${canvas.width / ratio()}px`;
        canvas.style.height = `${canvas.height / ratio()}px`;
        const seen = [canvas.width / scale, canvas.height / scale];
        state.x = Math.max(0, Math.min(width - seen[0], state.x));
        state.y = Math.max(0, Math.min(height - seen[1], state.y));
        const pen = canvas.getContext('2d');
        pen.imageSmoothingEnabled = false;
        const split = Math.round(state.divider * canvas.width);
        const half = (id, from, to) => {
            if (to <= from) return;
            pen.save();
            pen.beginPath();
            pen.rect(from, 0, to - from, canvas.height);
            pen.clip();
            pen.drawImage(byId.get(id).canvas, -state.x * scale, -state.y * scale, width * scale, height * scale);
            if (scale / ratio() >= 44) letter(pen, byId.get(id), scale);
            pen.restore();
        };
        const [left, right] = state.blinked ? [state.right, state.left] : [state.left, state.right];
        half(left, 0, state.blinking ? canvas.width : split);
        if (!state.blinking) half(right, split, canvas.width);
        if (scale >= 8 * ratio()) grid(pen, scale);
        if (!state.blinking && split > 0 && split < canvas.width) {
            pen.fillStyle = themeColour('--accent');
            pen.fillRect(split - 1, 0, 2, canvas.height);
        }
        if (state.cursor) frame(pen, scale);
        zoomed.value = `${scale >= 1 ? Math.round((scale / ratio()) * 10) / 10 : (scale / ratio()).toFixed(2)}\u00d7`;
        selects.left.value = state.left, selects.right.value = state.right;
        slider.value = Math.round(state.divider * 100);
        slider.disabled = Boolean(state.blinking);
        blinkButton.textContent = calm.matches ? 'Blink once' : 'Blink';
        blinkButton.setAttribute('aria-pressed', String(Boolean(state.blinking)));
        node.dataset.scale = scale / ratio();
    }
    function grid(pen, scale) {
        pen.strokeStyle = 'rgba(128,128,128,0.45)';
        pen.lineWidth = 1;
        pen.beginPath();
        for (let x = Math.ceil(state.x); x <= width; ++x) pen.moveTo((x - state.x) * scale + 0.5, 0), pen.lineTo((x - state.x) * scale + 0.5, canvas.height);
        for (let y = Math.ceil(state.y); y <= height; ++y) pen.moveTo(0, (y - state.y) * scale + 0.5), pen.lineTo(canvas.width, (y - state.y) * scale + 0.5);
        pen.stroke();
    }
    /// The values stand in the pixels themselves once these are large enough.
    function letter(pen, { picture, colours }, scale) {
        pen.textAlign = 'center';
        pen.textBaseline = 'middle';
        pen.font = `${Math.round(scale / 5)}px ui-monospace, monospace`;
        const right = Math.min(width, Math.ceil(state.x + canvas.width / scale)), below = Math.min(height, Math.ceil(state.y + canvas.height / scale));
        for (let y = Math.floor(state.y); y < below; ++y)
            for (let x = Math.floor(state.x); x < right; ++x) {
                const lines = picture.kind === 'cause' ? [String(picture.data[y * width + x])] : valueText(picture, causes, x, y).split(' ');
                const [r, g, b] = colours.subarray(4 * (y * width + x));
                pen.fillStyle = 0.3 * r + 0.59 * g + 0.11 * b > 128 ? '#000' : '#fff';
                lines.forEach((line, i) => pen.fillText(line, (x - state.x + 0.5) * scale, (y - state.y + 0.5) * scale + (i - (lines.length - 1) / 2) * scale * 0.24));
            }
    }
    function frame(pen, scale) {
        const { x, y } = state.cursor;
        const [left, top, side] = [(x - state.x) * scale, (y - state.y) * scale, Math.max(scale, 5)];
        pen.lineWidth = Math.max(1, ratio());
        pen.strokeStyle = '#000';
        pen.strokeRect(left - 1.5, top - 1.5, side + 3, side + 3);
        pen.strokeStyle = '#fff';
        pen.strokeRect(left - 0.5, top - 0.5, side + 1, side + 1);
    }

    function chose() {
        options.keep?.({
            pair: [state.left, state.right], divider: state.divider,
            zoom: state.scale ? String(Math.round((1000 * state.scale) / ratio()) / 1000) : '', pixel: state.pinned ? `${state.pinned.x},${state.pinned.y}` : '',
        });
        draw();
    }
    /// Once it is known how large the picture is: the zoom and the pixel that it begins with.
    function place() {
        isPlaced = true;
        if (state.scale && state.scale <= fitted()) state.scale = 0;
        const { x, y } = options.pixel ?? { x: width / 2, y: height / 2 };
        if (state.scale) state.x = x + 0.5 - (width * fitted()) / state.scale / 2, state.y = y + 0.5 - (height * fitted()) / state.scale / 2;
        if (options.pixel && x < width && y < height) state.pinned = { x, y }, show(x, y);
    }
    function swap() {
        [state.left, state.right] = [state.right, state.left];
        chose();
    }
    /// Two pictures a second by turns; one change a press where the reader asked for less motion.
    function blink() {
        if (calm.matches) {
            state.blinked = !state.blinked;
            state.blinking = state.blinked ? 1 : 0;
            return draw();
        }
        clearInterval(state.blinking);
        if (state.blinking) {
            state.blinking = 0, state.blinked = false;
        } else {
            state.blinking = setInterval(() => {
                if (!node.isConnected) return clearInterval(state.blinking);
                state.blinked = !state.blinked;
                draw();
            }, 500);
        }
        draw();
    }
    function fit() {
        state.scale = 0;
        chose();
    }
    /// Doubles or halves, about the cursor or the middle.
    function zoom(step) {
        const before = scaleNow(), least = fitted();
        const to = step > 0 ? before * 2 : before / 2;
        if (to > 128 * ratio()) return;
        const about = state.cursor ?? { x: state.x + canvas.width / before / 2, y: state.y + canvas.height / before / 2 };
        state.scale = to <= least ? 0 : to;
        const after = scaleNow();
        state.x = about.x + 0.5 - ((about.x + 0.5 - state.x) * before) / after;
        state.y = about.y + 0.5 - ((about.y + 0.5 - state.y) * before) / after;
        chose();
    }
    /// @return  what the pixel holds, in words
    function show(x, y) {
        state.cursor = { x: Math.max(0, Math.min(width - 1, x)), y: Math.max(0, Math.min(height - 1, y)) };
        const texts = views.map((view) => [view.label, valueText(view.picture, causes, state.cursor.x, state.cursor.y)]);
        values.replaceChildren(h('div', {}, h('dt', {}, 'pixel'), h('dd', {}, `${state.cursor.x}, ${state.cursor.y}`)),
            ...texts.map(([label, text]) => h('div', {}, h('dt', {}, label), h('dd', {}, text))));
        draw();
        return `pixel ${state.cursor.x}, ${state.cursor.y}: ${texts.map((pair) => pair.join(' ')).join('; ')}`;
    }
    function walk(dx, dy) {
        const from = state.cursor ?? { x: Math.floor(width / 2), y: Math.floor(height / 2) };
        say(show(from.x + dx, from.y + dy));
        const scale = scaleNow(), [across, down] = [canvas.width / scale, canvas.height / scale];
        const { x, y } = state.cursor;
        state.x = Math.max(x + 1 - across, Math.min(x, state.x));
        state.y = Math.max(y + 1 - down, Math.min(y, state.y));
        state.pinned = state.cursor;
        chose();
    }

    stage.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.altKey || event.metaKey) return;
        const far = event.shiftKey ? 10 : 1;
        const does = {
            ArrowLeft: () => walk(-far, 0), ArrowRight: () => walk(far, 0), ArrowUp: () => walk(0, -far), ArrowDown: () => walk(0, far),
            '+': () => zoom(1), '=': () => zoom(1), '-': () => zoom(-1), 0: fit, b: blink, s: swap,
            '[': () => divide(-0.05), ']': () => divide(0.05),
        }[event.key];
        if (!does) return;
        event.preventDefault();
        event.stopPropagation();
        does();
    });
    const divide = (by) => {
        state.divider = Math.max(0, Math.min(1, state.divider + by));
        chose();
    };

    // The pointer: over pixels it shows their values, and a click keeps one; near the divider it moves that, else it moves a
    // zoomed picture.
    const placeOf = (event) => {
        const box = canvas.getBoundingClientRect();
        return [(event.clientX - box.left) * ratio(), (event.clientY - box.top) * ratio()];
    };
    let drag = null, dragged = false;
    canvas.addEventListener('pointerdown', (event) => {
        const [x, y] = placeOf(event);
        dragged = false;
        const near = !state.blinking && Math.abs(x - state.divider * canvas.width) < 10 * ratio();
        if (!near && !state.scale) return;
        drag = { divider: near, x, y, from: [state.x, state.y] };
        canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
        const [x, y] = placeOf(event), scale = scaleNow();
        dragged ||= Boolean(drag);
        if (drag?.divider) return (state.divider = Math.max(0, Math.min(1, x / canvas.width))), chose();
        if (drag) return ([state.x, state.y] = [drag.from[0] - (x - drag.x) / scale, drag.from[1] - (y - drag.y) / scale]), draw();
        show(Math.floor(state.x + x / scale), Math.floor(state.y + y / scale));
    });
    canvas.addEventListener('pointerup', () => (drag = null));
    canvas.addEventListener('pointercancel', () => (drag = null));
    canvas.addEventListener('click', (event) => {
        if (dragged) return;
        const [x, y] = placeOf(event), scale = scaleNow();
        show(Math.floor(state.x + x / scale), Math.floor(state.y + y / scale));
        state.pinned = state.cursor;
        chose();
    });
    canvas.addEventListener('dblclick', () => zoom(1));
    canvas.addEventListener('wheel', (event) => {
        if (!event.ctrlKey) return;
        event.preventDefault();
        zoom(event.deltaY < 0 ? 1 : -1);
    }, { passive: false });
    new ResizeObserver(() => draw()).observe(stage);
    return { node, draw };
}
