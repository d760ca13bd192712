// A list of names with figures.

export interface Fact {
    name: string;
    value: string;
    more?: string | undefined;
}

export function Facts({ facts, label }: { facts: Fact[]; label: string }) {
    return (
        <dl class="facts" aria-label={label}>
            {facts.map(({ name, value, more }) => (
                <div key={name}>
                    <dt>{name}</dt>
                    <dd>
                        <b>{value}</b>
                        {more && <span>{more}</span>}
                    </dd>
                </div>
            ))}
        </dl>
    );
}

/** A hint with a button that mends what it says. */
export function Missing({ text, action, act }: { text: string; action?: string; act?: () => void }) {
    return (
        <div class="missing">
            <p>{text}</p>
            {action && <button onClick={act}>{action}</button>}
        </div>
    );
}
