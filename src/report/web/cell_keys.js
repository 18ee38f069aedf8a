// Keys of an opened cell while none of its parts has the focus: it is on the heading, or nowhere.

const buttons = { ArrowLeft: 'before', ArrowRight: 'next' };
const pictureKeys = ['b', 's', '+', '=', '-', '0'];

/// Left and right go to the frame before and after; what a picture understands goes to the first of them.
export function cellKeys(dialog) {
    document.addEventListener('keydown', (event) => {
        if (!dialog.open || event.ctrlKey || event.altKey || event.metaKey) return;
        if (event.target !== document.body && event.target !== dialog && event.target.closest('h2') === null) return;
        const stage = dialog.querySelector('.pictured .stage');
        if (buttons[event.key]) dialog.querySelector(`[data-do=${buttons[event.key]}]`).click();
        else if (pictureKeys.includes(event.key) && stage) stage.dispatchEvent(new KeyboardEvent('keydown', { key: event.key }));
        else return;
        event.preventDefault();
    });
}
