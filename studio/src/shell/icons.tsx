// Small line icons of the header.
import type { ComponentChildren } from "preact";

function Icon({ children }: { children: ComponentChildren }) {
    return (
        <svg class="icon" viewBox="0 0 20 20" aria-hidden="true">
            {children}
        </svg>
    );
}

export const UndoIcon = () => (
    <Icon>
        <path d="M7 4 3.5 7.5 7 11M4 7.5h7.5a4.5 4.5 0 0 1 0 9H8" />
    </Icon>
);
export const RedoIcon = () => (
    <Icon>
        <path d="m13 4 3.5 3.5L13 11m3-3.5H8.5a4.5 4.5 0 0 0 0 9H12" />
    </Icon>
);
export const SunIcon = () => (
    <Icon>
        <circle cx="10" cy="10" r="3.3" />
        <path d="M10 2.5v2m0 11v2M2.5 10h2m11 0h2M4.7 4.7l1.4 1.4m7.8 7.8 1.4 1.4m0-10.6-1.4 1.4m-7.8 7.8-1.4 1.4" />
    </Icon>
);
export const MoonIcon = () => (
    <Icon>
        <path d="M16.5 11.8A7 7 0 0 1 8.2 3.5a7 7 0 1 0 8.3 8.3Z" />
    </Icon>
);
export const HelpIcon = () => (
    <Icon>
        <circle cx="10" cy="10" r="7.3" />
        <path d="M7.8 7.9a2.3 2.3 0 1 1 3.3 2.2c-.8.4-1.1.9-1.1 1.7m0 2.4v.1" />
    </Icon>
);
export const Mark = () => (
    <svg class="mark" viewBox="0 0 32 32" aria-hidden="true">
        <path d="M11 8.5h10" opacity=".5" />
        <path d="M8 13.5h16" opacity=".75" />
        <path d="M7 18.5h7m4 0h7" />
        <path d="M9 23.5h14" />
    </svg>
);
