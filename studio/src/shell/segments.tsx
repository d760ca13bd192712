// A row of buttons of which one is chosen. Arrow keys move along it.

interface Choice<Word extends string> {
    word: Word;
    label: string;
    title?: string;
}

interface Props<Word extends string> {
    choices: Choice<Word>[];
    value: Word;
    choose: (word: Word) => void;
    label?: string;
    labelled_by?: string;
}

export function Segments<Word extends string>({ choices, value, choose, label, labelled_by }: Props<Word>) {
    const move = (event: KeyboardEvent) => {
        const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (!step) return;
        event.preventDefault();
        const now = choices.findIndex((one) => one.word === value);
        const next = (now + step + choices.length) % choices.length;
        choose(choices[next]!.word);
        const row = event.currentTarget as HTMLElement;
        (row.children[next] as HTMLElement).focus();
    };
    return (
        <div
            class="segments"
            role="radiogroup"
            aria-label={label}
            aria-labelledby={labelled_by}
            onKeyDown={move}
        >
            {choices.map(({ word, label: shown, title }) => (
                <button
                    key={word}
                    role="radio"
                    aria-checked={word === value}
                    tabIndex={word === value ? 0 : -1}
                    title={title}
                    onClick={() => choose(word)}
                >
                    {shown}
                </button>
            ))}
        </div>
    );
}
