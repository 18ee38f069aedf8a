// The blocks of the report: what stands in the file, as text, bytes and objects.

/// The bytes of a text in base64.
export function bytesOfBase64(text) {
    const binary = atob(text.trim());
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

/// Inflates a raw deflate stream (RFC 1951).
/// @throws Error  if it is no such stream, or not of `length` bytes
export async function inflate(bytes, length) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    const out = new Uint8Array(await new Response(stream).arrayBuffer());
    if (out.length !== length) throw new Error(`a block of the report has ${out.length} bytes and not ${length}`);
    return out;
}

/// The text of a data block of the page; null where there is none.
export function blockText(id) {
    return document.getElementById(id)?.textContent ?? null;
}

/// Undoes the rows' differences in place: each byte stands as the difference to its left neighbour.
export function undoDifferences(bytes, width) {
    for (let row = 0; row < bytes.length; row += width)
        for (let i = row + 1; i < row + width; ++i) bytes[i] = bytes[i] + bytes[i - 1];
    return bytes;
}

/// `bytes` XOR `base`, in place.
export function exclusiveOr(bytes, base) {
    for (let i = 0; i < bytes.length; ++i) bytes[i] ^= base[i];
    return bytes;
}
