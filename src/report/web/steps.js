// The address follows the state: deliberate changes are steps of the browser's history, which "back" undoes; what changes
// while a key or the pointer moves is written over the last step.

const pause = 250;  // ms; a browser refuses an address that changes much faster

/// @param moved  is called once the browser has gone to another step; it reads the address
export function steps(moved) {
    let waiting = null, timer = 0, last = -Infinity, typing = false, leaving = false, seen = location.hash;
    const queue = [];
    const address = (hash) => hash || location.pathname + location.search;
    const write = () => {
        clearTimeout(timer);
        timer = 0;
        if (waiting === null) return;
        last = performance.now();
        history.replaceState(history.state, '', address(waiting));
        waiting = null, seen = location.hash;
    };
    const onceThere = (task) => (leaving ? queue.push(task) : task());
    const arrive = () => {
        waiting = null, typing = false, leaving = false, seen = location.hash;
        moved();
        for (const task of queue.splice(0)) task();
    };
    window.addEventListener('popstate', arrive);
    // An address that somebody typed.
    window.addEventListener('hashchange', () => {
        if (location.hash !== seen) arrive();
    });
    return {
        /// A step of its own.
        /// @param opens  it opens a cell: leave() goes back from it
        push(hash, opens = false) {
            onceThere(() => {
                write();
                typing = false;
                history.pushState({ opens }, '', address(hash));
                seen = location.hash;
            });
        },
        /// The same step, with another address.
        replace(hash) {
            onceThere(() => {
                waiting = hash;
                if (performance.now() - last > pause) write();
                else timer ||= setTimeout(write, pause);
            });
        },
        /// A letter: the first is a step.
        type(hash) {
            if (typing) return this.replace(hash);
            this.push(hash);
            typing = true;
        },
        /// Goes back from a step that opened a cell.
        /// @return  false where the cell was open from the start: there is nothing to go back to
        leave() {
            write();
            if (!history.state?.opens) return false;
            leaving = true;
            history.back();
            return true;
        },
    };
}
