// The token of the server: from the page's address, which then no longer shows it. Kept for reloads.

const kept_as = "lamella-token";

function take_token(): string {
    const address = new URL(location.href);
    const given = address.searchParams.get("token");
    if (given) {
        sessionStorage.setItem(kept_as, given);
        address.searchParams.delete("token");
        history.replaceState(null, "", address.pathname + address.search + address.hash);
    }
    return given ?? sessionStorage.getItem(kept_as) ?? "";
}

export const token = take_token();

/** Names this page to the server, which cancels older work of the same session. */
export const session = Array.from(crypto.getRandomValues(new Uint8Array(6)), (byte) =>
    byte.toString(16).padStart(2, "0"),
).join("");
