// Writes mock/settings.json from what `lamella keys` prints: lamella keys | node mock/read_keys.mjs
import { readFileSync, writeFileSync } from "node:fs";

const number = "(-?[0-9.e+-]+)";
const forms = [
    [new RegExp(`^a number from ${number} to ${number} ?(.*?) or a formula$`), "graded"],
    [new RegExp(`^a number from ${number} to ${number} ?(.*)$`), "number"],
    [new RegExp(`^a whole number from ${number} to ${number} ?(.*)$`), "integer"],
    [new RegExp(`^three numbers from ${number} to ${number} ?(.*?) or formulas$`), "graded_triple"],
    [new RegExp(`^three numbers from ${number} to ${number} ?(.*)$`), "triple"],
    [/^a text$/, "text"],
    [/^a path$/, "path"],
    [/^a formula$/, "formula"],
    [/^true or false$/, "boolean"],
    [/^a list of lines/, "lines"],
    [/^one of (.*)$/, "choice"],
    [new RegExp(`\\[.* from ${number} to ${number} ?(.*)$`), "rows"],
];

function typed(accepted) {
    for (const [form, type] of forms) {
        const found = form.exec(accepted);
        if (!found) continue;
        if (type === "choice") return { type, choices: found[1].split(", ") };
        if (found.length < 4) return { type };
        return { type, unit: found[3], lo: Number(found[1]), hi: Number(found[2]) };
    }
    throw new Error(`unknown form: ${accepted}`);
}

const sections = [];
const settings = [];
const lines = readFileSync(0, "utf8").split("\n");
for (let i = 0; i < lines.length; ++i) {
    const head = /^(\[+([a-z_]+)\]+) {2}(.*)$/.exec(lines[i]);
    if (head) {
        const list = head[1].startsWith("[[");
        sections.push({ name: head[2], title: head[1], help: head[3], list });
        continue;
    }
    const key = /^ {2}([a-z_0-9]{1,40}?) *([A-Z0-9].*)$/.exec(lines[i]);
    if (!key) continue;
    const tail = /^ {22}(.*?); default: (.*?)(?:; flag: (.*))?$/.exec(lines[i + 1]);
    const section = sections.at(-1).name;
    const base = { section, key: key[1], flag: tail[3] ?? "", unit: "", lo: null, hi: null, choices: [] };
    settings.push({ ...base, ...typed(tail[1]), default: tail[2], help: key[2] });
}

const rows = (list) => list.map((entry) => "  " + JSON.stringify(entry)).join(",\n");
const text = `{"sections": [\n${rows(sections)}\n],\n"settings": [\n${rows(settings)}\n]}\n`;
writeFileSync(new URL("settings.json", import.meta.url), text);
