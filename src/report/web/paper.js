// The page on paper: the table in pieces that a page on its side holds, and the plots as wide as it.

const figureColumns = 11, symbolColumns = 40;  // that an A4 page on its side holds

/// The shown table in pieces of a page's width.
export function slices(shown, state) {
    const name = state.across === 'methods' ? 'rows' : 'profiles';
    const all = shown[name], most = state.look === 'symbols' ? symbolColumns : figureColumns;
    const pieces = Math.ceil(all.length / most), each = Math.ceil(all.length / pieces);
    return Array.from({ length: pieces }, (_, at) => ({ ...shown, [name]: all.slice(at * each, (at + 1) * each) }));
}

/// Makes the page ready for paper before it is printed, and as it was afterwards.
/// @param begin  makes it ready, without waiting for anything: the printer doesn't
export function onPaper(begin, end) {
    const root = document.documentElement;
    let theme = null;
    const ready = () => {
        if (theme !== null) return;
        theme = root.dataset.theme ?? '';
        root.dataset.theme = 'light';
        begin();
    };
    const back = () => {
        if (theme === null) return;
        if (theme) root.dataset.theme = theme;
        else delete root.dataset.theme;
        theme = null;
        end();
    };
    window.addEventListener('beforeprint', ready);
    window.addEventListener('afterprint', back);
    const print = matchMedia('print');
    print.addEventListener('change', () => (print.matches ? ready() : back()));
    if (print.matches) ready();
}
