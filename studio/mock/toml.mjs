// Reads and edits recipes: the part of TOML that recipes use. Values are kept as the text of a flag.

/** The text of a value as a flag takes it: "text" loses its quotes, [1, 2, 3] becomes 1,2,3. */
function flag_text(raw) {
    const value = raw.trim();
    if (/^"(.*)"$/s.test(value)) return value.slice(1, -1).replace(/\\"/g, '"').replace(/\\\\/g, "\\");
    if (/^'(.*)'$/s.test(value)) return value.slice(1, -1);
    if (/^\[[^[\]]*\]$/.test(value))
        return value
            .slice(1, -1)
            .split(",")
            .map((one) => one.trim())
            .join(",");
    return value;
}

/** Splits "key = value  # comment"; null when the line is no assignment. */
function split_line(line) {
    const found = /^(\s*([A-Za-z_0-9]+)\s*=\s*)(.*)$/.exec(line);
    if (!found) return null;
    const rest = found[3];
    let quote = "";
    let end = rest.length;
    for (let i = 0; i < rest.length; ++i) {
        if (quote) {
            if (rest[i] === quote && rest[i - 1] !== "\\") quote = "";
        } else if (rest[i] === '"' || rest[i] === "'") {
            quote = rest[i];
        } else if (rest[i] === "#") {
            end = i;
            break;
        }
    }
    const raw = rest.slice(0, end).trimEnd();
    return { key: found[2], before: found[1], raw, after: rest.slice(raw.length), open: quote !== "" };
}

/** Returns {"sections": [{name, index, list, line, entries: [{key, value, line}]}], "mistakes": [...]}. */
export function read_toml(text) {
    const sections = [];
    const mistakes = [];
    const counts = {};
    text.split("\n").forEach((line, i) => {
        const bare = line.trim();
        if (!bare || bare.startsWith("#")) return;
        const head = /^(\[\[?)\s*([A-Za-z_0-9]+)\s*(\]\]?)\s*(#.*)?$/.exec(bare);
        if (head) {
            const list = head[1] === "[[";
            const index = list ? (counts[head[2]] = (counts[head[2]] ?? -1) + 1) : 0;
            sections.push({ name: head[2], index, list, line: i + 1, entries: [] });
            return;
        }
        const found = split_line(line);
        if (!found || found.open || !found.raw) {
            mistakes.push({ line: i + 1, text: "not valid TOML: expected key = value or [section]" });
        } else if (sections.length) {
            sections.at(-1).entries.push({ key: found.key, value: flag_text(found.raw), line: i + 1 });
        }
    });
    return { sections, mistakes };
}

/** The value as TOML, by the setting's type. */
function toml_value(setting, value) {
    const plain = /^(-?[0-9.]+(e[-+]?[0-9]+)?|true|false)$/i.test(value.trim());
    const text = setting.type === "text" || setting.type === "path" || setting.type === "choice";
    if (!text && plain) return value.trim();
    if (setting.type === "triple")
        return `[${value
            .split(",")
            .map((one) => one.trim())
            .join(", ")}]`;
    if (setting.type === "rows") return value;
    return JSON.stringify(value);
}

/** Applies one change to the text: comments and order stay. A change without a key removes the section. */
export function edit_toml(text, change, setting) {
    const lines = text.replace(/\n+$/, "").split("\n");
    const { sections } = read_toml(text);
    const section = sections.find((one) => one.name === change.section && one.index === (change.index ?? 0));
    if (change.key === null) {
        if (!section) return text;
        const next = sections[sections.indexOf(section) + 1];
        lines.splice(section.line - 1, (next ? next.line - 1 : lines.length) - (section.line - 1));
        return lines.join("\n").replace(/\n+$/, "") + "\n";
    }
    const entry = section?.entries.find((one) => one.key === change.key);
    if (change.value === null) {
        if (entry) lines.splice(entry.line - 1, 1);
    } else if (entry) {
        const old = split_line(lines[entry.line - 1]);
        const fresh = toml_value(setting, change.value);
        const pad = old.after.trim()
            ? " ".repeat(Math.max(1, old.raw.length + old.after.search(/\S/) - fresh.length))
            : "";
        lines[entry.line - 1] = old.before + fresh + pad + old.after.trimStart();
    } else {
        const fresh = `${change.key} = ${toml_value(setting, change.value)}`;
        if (section) {
            const at = section.entries.length ? section.entries.at(-1).line : section.line;
            lines.splice(at, 0, fresh);
        } else {
            const list = change.list ? [`[[${change.section}]]`] : [`[${change.section}]`];
            lines.push("", ...list, fresh);
        }
    }
    return lines.join("\n").replace(/^\n+/, "") + "\n";
}
