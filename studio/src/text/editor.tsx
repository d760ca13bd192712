// The recipe as text, with TOML highlighted and mistakes at their lines.
// The editor lives in a shadow root: there its styles are adopted style sheets, which the policy allows.
import { defaultKeymap, indentWithTab } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { type Diagnostic, lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { MistakeList } from "../shell/mistake_list";
import { redo, set_text, undo } from "../state/recipe";
import { edit_mistakes, mistakes, text, wanted_line } from "../state/store";

/** A pause in typing of this length makes the text the recipe, ms. */
const pause = 400;

const colours = syntaxHighlighting(
    HighlightStyle.define([
        { tag: tags.comment, color: "var(--code-comment)" },
        { tag: [tags.string, tags.special(tags.string)], color: "var(--code-string)" },
        { tag: [tags.number, tags.atom, tags.bool], color: "var(--code-number)" },
        { tag: tags.propertyName, color: "var(--code-key)" },
    ]),
);

const look = EditorView.theme({
    "&": { height: "100%", color: "var(--ink)", backgroundColor: "var(--field)", fontSize: "12.5px" },
    "&.cm-focused": { outline: "none" },
    ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.55" },
    ".cm-content": { caretColor: "var(--ink)" },
    ".cm-cursor": { borderLeftColor: "var(--ink)" },
    ".cm-gutters": { backgroundColor: "var(--field)", color: "var(--ink-soft)", border: "none" },
    ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--hover)" },
    "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": {
        backgroundColor: "var(--select) !important",
    },
    ".cm-tooltip": { backgroundColor: "var(--panel)", color: "var(--ink)", border: "1px solid var(--line)" },
});

/** The server's mistakes as marks of lines. */
function marks(state: EditorState): Diagnostic[] {
    return [...mistakes.value, ...edit_mistakes.value].flatMap(({ line, text: message }) => {
        if (line === null || line < 1 || line > state.doc.lines) return [];
        const at = state.doc.line(line);
        const first = at.from + (at.text.length - at.text.trimStart().length);
        return [{ from: first, to: Math.max(first, at.to), severity: "error" as const, message }];
    });
}

function mount(room: HTMLElement): () => void {
    const root = room.shadowRoot ?? room.attachShadow({ mode: "open" });
    let timer = 0;
    const commit = () => {
        clearTimeout(timer);
        timer = 0;
        set_text(editor.state.doc.toString(), "typing");
    };
    const history_key = (step: () => void) => () => {
        if (timer) commit();
        step();
        return true;
    };
    const editor: EditorView = new EditorView({
        parent: root,
        root,
        state: EditorState.create({
            doc: text.peek(),
            extensions: [
                lineNumbers(),
                drawSelection(),
                highlightActiveLine(),
                lintGutter(),
                StreamLanguage.define(toml),
                colours,
                look,
                keymap.of([
                    { key: "Mod-z", run: history_key(undo), preventDefault: true },
                    { key: "Mod-y", run: history_key(redo) },
                    { key: "Mod-Shift-z", run: history_key(redo) },
                    // Escape leaves the editor for those who use the keyboard alone, since Tab indents.
                    {
                        key: "Escape",
                        run: () => {
                            editor.contentDOM.blur();
                            room.focus();
                            return true;
                        },
                    },
                    indentWithTab,
                    ...defaultKeymap,
                ]),
                EditorView.contentAttributes.of({
                    "aria-label": "Recipe",
                    spellcheck: "false",
                    autocapitalize: "off",
                    tabindex: "0",
                }),
                EditorView.updateListener.of((update) => {
                    if (!update.docChanged || update.transactions.some((one) => one.isUserEvent("studio")))
                        return;
                    clearTimeout(timer);
                    timer = window.setTimeout(commit, pause);
                }),
            ],
        }),
    });
    const stops = [
        effect(() => {
            // changes by the form, by undo or by another recipe
            const next = text.value;
            if (timer || next === editor.state.doc.toString()) return;
            const changes = { from: 0, to: editor.state.doc.length, insert: next };
            editor.dispatch({ changes, userEvent: "studio" });
        }),
        effect(() => {
            void text.value;
            editor.dispatch(setDiagnostics(editor.state, marks(editor.state)));
        }),
        effect(() => {
            const wanted = wanted_line.value;
            if (!wanted || wanted.line > editor.state.doc.lines) return;
            const { from } = editor.state.doc.line(Math.max(1, wanted.line));
            editor.dispatch({
                selection: { anchor: from },
                effects: EditorView.scrollIntoView(from, { y: "center" }),
            });
            editor.focus();
            wanted_line.value = null;
        }),
    ];
    return () => {
        if (timer) commit();
        for (const stop of stops) stop();
        editor.destroy();
    };
}

export function TextEditor() {
    const room = useRef<HTMLDivElement>(null);
    useEffect(() => mount(room.current!), []);
    return (
        <div class="text-editor">
            <div class="text-room" ref={room} tabIndex={-1} />
            <MistakeList list={[...mistakes.value, ...edit_mistakes.value]} />
            <p class="text-hint">Escape leaves the text. Comments and order are kept by the form.</p>
        </div>
    );
}
