// Names beside points and lines, placed so that none covers another.

const high = 14;  // pixels from one line of text to the next

/// The width of a text, in pixels, a little more than it takes.
export const widthOf = (text) => 6.6 * text.length + 6;

const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/// Where the name of a point may stand, the nearest first: beside it, above and below, then farther off.
function* placesFor(x, y, wide) {
    const box = (left, top) => ({ left, right: left + wide, top, bottom: top + high });
    yield box(x + 7, y - high / 2);
    yield box(x - 7 - wide, y - high / 2);
    for (let step = 1; step < 20; ++step)
        for (const up of [-1, 1])
            for (const across of [4, -wide / 2, -wide - 4]) yield box(x + across, y - high / 2 + up * step * high);
}

/// @param points  [{name, x, y}], pixels from the upper left
/// @param size    {width, height} of the plot: no name leaves it
/// @param lines   [{left, right, top, bottom}] that no name covers either
/// @return        [{name, x, y, left, middle}] of those that have a place: the point, and the name's left end and middle
export function placeLabels(points, { width, height }, lines = []) {
    const taken = points.map(({ x, y }) => ({ left: x - 5, right: x + 5, top: y - 5, bottom: y + 5 })).concat(lines);
    const inside = (box) => box.left >= 0 && box.right <= width && box.top >= 0 && box.bottom <= height;
    const placed = [];
    for (const { name, x, y } of points)
        for (const box of placesFor(x, y, widthOf(name))) {
            if (!inside(box) || taken.some((other) => overlap(box, other))) continue;
            taken.push(box);
            placed.push({ name, x, y, left: box.left, middle: (box.top + box.bottom) / 2 });
            break;
        }
    return placed;
}

/// Heights of names at the ends of lines: each as near to its line as the others let it, in the lines' order.
/// @param ends  [{name, y}]
/// @return      [{name, y, middle}]
export function spreadLabels(ends, height) {
    const sorted = [...ends].sort((a, b) => a.y - b.y || a.name.localeCompare(b.name));
    const gap = Math.min(high, height / Math.max(1, sorted.length));
    const middles = sorted.map(({ y }) => y);
    for (let i = 0; i < middles.length; ++i) middles[i] = Math.max(middles[i], i ? middles[i - 1] + gap : gap / 2);
    for (let i = middles.length - 1; i >= 0; --i) middles[i] = Math.min(middles[i], i + 1 < middles.length ? middles[i + 1] - gap : height - gap / 2);
    return sorted.map((end, i) => ({ ...end, middle: middles[i] }));
}
