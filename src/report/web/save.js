// Files that the page hands out: CSV and SVG, made in the page.

/// A row's values as CSV (RFC 4180).
const field = (value) => {
    const text = value === null || value === undefined || Number.isNaN(value) ? '' : String(value);
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

/// Objects as CSV with the first's keys as its head.
export function csvOf(rows) {
    if (!rows.length) return '';
    const keys = Object.keys(rows[0]);
    return [keys, ...rows.map((row) => keys.map((key) => row[key]))].map((line) => `${line.map(field).join(',')}\r\n`).join('');
}

/// Offers a text as a file.
export function save(name, type, text) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], { type }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/// Puts a text on the clipboard, where the browser lets a file do so.
export async function copy(text) {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return false;
    }
}
