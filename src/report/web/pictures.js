// Pictures: from a chunk of the report to bytes, and from bytes to colours.
import { exclusiveOr, inflate, undoDifferences } from './decode.js';

/// The pictures of a report; a chunk is inflated when its first picture is asked for.
export class Pictures {
    /// @param chunks  of the head: {offset, size, length}
    /// @param list    of the run: {chunk, offset, width, height, planes, kind, base}
    /// @param bytes   gives the block of all chunks
    constructor(chunks, list, bytes) {
        Object.assign(this, { chunks, list, bytes, inflated: new Map(), decoded: new Map() });
    }

    chunk(index) {
        if (!this.inflated.has(index)) {
            const { offset, size, length } = this.chunks[index];
            this.inflated.set(index, inflate(this.bytes().subarray(offset, offset + size), length));
        }
        return this.inflated.get(index);
    }

    /// @return  {width, height, planes, kind, data}: plane after plane, rows from the top
    get(index) {
        if (!this.decoded.has(index)) {
            // Some hundreds of pictures of a window are kept, those that were asked for last.
            if (this.decoded.size > 200) this.decoded.delete(this.decoded.keys().next().value);
            this.decoded.set(index, this.decode(index));
        }
        return this.decoded.get(index);
    }

    async decode(index) {
        const { chunk, offset, width, height, planes, kind, base } = this.list[index];
        const data = (await this.chunk(chunk)).slice(offset, offset + planes * width * height);
        if (base < 0) undoDifferences(data, width);
        else exclusiveOr(data, (await this.get(base)).data);
        return { width, height, planes, kind, data };
    }
}

/// Colours of counts: 0 is dark, and each count up to 11 a step lighter, from blue to yellow; above, pink.
const steps = [
    [16, 18, 24], [38, 44, 110], [44, 72, 150], [40, 104, 166], [36, 134, 160], [44, 160, 140], [78, 182, 112],
    [128, 200, 84], [178, 212, 66], [222, 216, 66], [246, 224, 110], [252, 238, 170],
];
const many = [236, 120, 190];
const noCause = [206, 206, 202];  // dark blue and yellow are both seen on it

const bytesOfHex = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

/// A picture as ImageData.
/// @param causes  of the run: {name, colour}
export function coloured(picture, causes) {
    const { width, height, planes, kind, data } = picture;
    const size = width * height;
    const image = new ImageData(width, height);
    const out = image.data;
    const table = kind === 'cause' ? [noCause, ...causes.map((cause) => bytesOfHex(cause.colour))] : steps;
    for (let i = 0; i < size; ++i) {
        const at = 4 * i;
        if (kind === 'cause' || kind === 'count') {
            const colour = table[data[i]] ?? many;
            out[at] = colour[0], out[at + 1] = colour[1], out[at + 2] = colour[2];
        } else {
            out[at] = data[i];
            out[at + 1] = data[planes === 3 ? size + i : i];
            out[at + 2] = data[planes === 3 ? 2 * size + i : i];
        }
        out[at + 3] = 255;
    }
    return image;
}

/// The values of a pixel: one number a plane.
export function valuesAt(picture, x, y) {
    const at = y * picture.width + x;
    return Array.from({ length: picture.planes }, (_, plane) => picture.data[plane * picture.width * picture.height + at]);
}

/// The values of a pixel in words.
export function valueText(picture, causes, x, y) {
    const values = valuesAt(picture, x, y);
    if (picture.kind !== 'cause') return values.join(' ');
    return values[0] === 0 ? 'no wrong pixel' : (causes[values[0] - 1]?.name ?? `cause ${values[0]}`);
}

/// A canvas of coloured() pixels.
export function canvasOf(image) {
    const canvas = document.createElement('canvas');
    canvas.width = image.width, canvas.height = image.height;
    canvas.getContext('2d').putImageData(image, 0, 0);
    return canvas;
}
