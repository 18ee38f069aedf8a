// What the page unpacks only when it is needed: Vega, which is most of it.
import { bytesOfBase64, inflate } from './decode.js';

let asked = null;

/// The module vega.js.
export const vega = () => (asked ??= load('packed-vega'));

/// Unpacks a script that stands in the page and runs it; it leaves its exports in window.packed.
async function load(id) {
    const block = document.getElementById(id);
    const bytes = await inflate(bytesOfBase64(block.textContent), Number(block.dataset.length));
    const script = document.createElement('script');
    script.textContent = new TextDecoder().decode(bytes);
    document.head.append(script);
    return window.packed;
}
