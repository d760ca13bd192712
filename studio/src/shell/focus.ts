// Focus of an element that may be on its way.

/** Focuses at once what is shown, so that no letter is lost; else after the page has changed. */
export function focus_soon(id: string): void {
    const there = document.getElementById(id);
    if (there) there.focus();
    else requestAnimationFrame(() => document.getElementById(id)?.focus());
}
