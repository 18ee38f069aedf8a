// Elements in few words.

/// An element: `name` may carry classes ("div.bar.wide"); properties that begin with "on" are listeners; null and
/// false leave a property or a child out.
export function h(name, properties = {}, ...children) {
    const [tag, ...classes] = name.split('.');
    const node = document.createElement(tag);
    if (classes.length) node.className = classes.join(' ');
    for (const [key, value] of Object.entries(properties)) {
        if (value === null || value === undefined || value === false) continue;
        if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
        else if (key in node && !key.startsWith('aria') && key !== 'list') node[key] = value;
        else node.setAttribute(key, value === true ? '' : value);
    }
    node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
    return node;
}

/// An element of SVG; all properties are attributes.
export function svg(tag, attributes = {}, ...children) {
    const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.append(...children);
    return node;
}

/// The symbol of a verdict. Its word stands beside it or in a label, so a reader of the screen skips it.
export function symbolOf(verdict) {
    return svg('svg', { class: `symbol ${verdict}`, 'aria-hidden': 'true' }, svg('use', { href: `#${verdict}` }));
}

/// Says a sentence to a reader of the screen.
export function say(text) {
    document.getElementById('said').textContent = text;
}

/// One stop of the tabulator for many widgets: arrow keys, Home and End walk over the `selector`s in `box`.
/// @param columns  widgets in a row, a function; 0: one row
export function roving(box, selector, columns = () => 0) {
    const all = () => [...box.querySelectorAll(selector)];
    const stop = (node) => {
        for (const other of all()) other.tabIndex = other === node ? 0 : -1;
    };
    box.addEventListener('focusin', (event) => {
        const node = event.target.closest(selector);
        if (node) stop(node);
    });
    box.addEventListener('keydown', (event) => {
        const node = event.target.closest(selector);
        if (!node || event.ctrlKey || event.altKey || event.metaKey) return;
        const list = all();
        const row = columns() || 1;
        const step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -row, ArrowDown: row }[event.key];
        let to = list.indexOf(node) + (step ?? 0);
        if (event.key === 'Home') to = 0;
        else if (event.key === 'End') to = list.length - 1;
        else if (step === undefined) return;
        event.preventDefault();
        list[Math.max(0, Math.min(list.length - 1, to))].focus();
    });
    const first = all().find((node) => node.matches('[aria-pressed=true], [aria-current=true]')) ?? all()[0];
    if (first) stop(first);
}

/// A colour of the page's style as the theme has it now.
export function themeColour(variable) {
    const probe = h('span', { style: `color: var(${variable}); display: none` });
    document.body.append(probe);
    const colour = getComputedStyle(probe).color;
    probe.remove();
    return colour;
}

/// Counts with a thin space between thousands.
export const counted = (number) => String(number).replace(/\B(?=(\d{3})+$)/g, '\u202f');

/// "1 cell", "2 cells"
export const plural = (number, word) => `${counted(number)} ${word}${number === 1 ? '' : 's'}`;
