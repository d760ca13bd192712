// The header: the name of the recipe, the tabs, undo and redo, the theme and the help.
import { useRef } from "preact/hooks";
import { can_redo, can_undo } from "../state/history";
import { redo, save, undo } from "../state/recipe";
import { path, starting, type Tab, tab, text, unsaved } from "../state/store";
import { HelpDialog } from "./help_dialog";
import { HelpIcon, Mark, MoonIcon, RedoIcon, SunIcon, UndoIcon } from "./icons";
import { dark, toggle_theme } from "./theme";

const tabs: { word: Tab; label: string }[] = [
    { word: "design", label: "Design" },
    { word: "check", label: "Check" },
    { word: "stiffness", label: "Stiffness" },
    { word: "make", label: "Make" },
    { word: "print", label: "Print" },
];

function Tabs() {
    const row = useRef<HTMLDivElement>(null);
    const move = (event: KeyboardEvent) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (!step) return;
        event.preventDefault();
        const next = (tabs.findIndex((one) => one.word === tab.value) + step + tabs.length) % tabs.length;
        tab.value = tabs[next]!.word;
        (row.current!.children[next] as HTMLElement).focus();
    };
    return (
        <div class="tabs" role="tablist" aria-label="Steps" ref={row} onKeyDown={move}>
            {tabs.map(({ word, label }) => (
                <button
                    key={word}
                    id={`tab-${word}`}
                    role="tab"
                    aria-selected={tab.value === word}
                    aria-controls="left-panel"
                    tabIndex={tab.value === word ? 0 : -1}
                    onClick={() => {
                        tab.value = word;
                    }}
                >
                    {label}
                </button>
            ))}
        </div>
    );
}

export function Header() {
    const help = useRef<HTMLDialogElement>(null);
    const has_recipe = text.value.trim() !== "" && !starting.value;
    return (
        <header class="top">
            <Mark />
            <h1>Lamella</h1>
            {has_recipe && (
                <span class="recipe-name" title={unsaved.value ? "Not saved" : "Saved"}>
                    {path.value ?? "unnamed recipe"}
                    {unsaved.value && (
                        <span class="unsaved" aria-label="not saved">
                            ●
                        </span>
                    )}
                </span>
            )}
            {has_recipe && <Tabs />}
            <div class="top-buttons">
                {has_recipe && (
                    <button
                        class="quiet"
                        title="Start with another model or example"
                        onClick={() => {
                            starting.value = true;
                        }}
                    >
                        New
                    </button>
                )}
                {starting.value && text.value.trim() !== "" && (
                    <button
                        class="quiet"
                        onClick={() => {
                            starting.value = false;
                        }}
                    >
                        Back
                    </button>
                )}
                {has_recipe && (
                    <button
                        class="quiet"
                        title="Save the recipe (Ctrl+S)"
                        disabled={!unsaved.value && path.value !== null}
                        onClick={() => void save()}
                    >
                        Save
                    </button>
                )}
                <button
                    class="icon-button"
                    title="Undo (Ctrl+Z)"
                    aria-label="Undo"
                    disabled={!can_undo.value}
                    onClick={undo}
                >
                    <UndoIcon />
                </button>
                <button
                    class="icon-button"
                    title="Redo (Ctrl+Shift+Z)"
                    aria-label="Redo"
                    disabled={!can_redo.value}
                    onClick={redo}
                >
                    <RedoIcon />
                </button>
                <button
                    class="icon-button"
                    title={dark.value ? "Light colours" : "Dark colours"}
                    aria-label={dark.value ? "Light colours" : "Dark colours"}
                    onClick={toggle_theme}
                >
                    {dark.value ? <SunIcon /> : <MoonIcon />}
                </button>
                <button
                    class="icon-button"
                    title="Keys"
                    aria-label="Keys"
                    onClick={() => help.current?.showModal()}
                >
                    <HelpIcon />
                </button>
            </div>
            <HelpDialog dialog={help} />
        </header>
    );
}
