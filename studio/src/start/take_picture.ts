// A picture that is dropped becomes a pattern of the skin: its shapes as they are, or an example for more of their kind.
import { signal } from "@preact/signals";
import { send_file } from "../server/api";
import type { Change } from "../server/types";
import { needed } from "../form/applies";
import { given_at } from "../form/changes";
import { starter } from "../form/starters";
import { report } from "../state/notices";
import { edit } from "../state/recipe";
import { job, starting, tab, table, text } from "../state/store";
import { size_of } from "../place/space";

export const picture_endings = [".png", ".jpg", ".jpeg", ".tif", ".tiff", ".webp"];

export type Use = "image" | "by-example";

/** The picture that waits for its use. */
export const dropped_picture = signal<File | null>(null);

export function offer_picture(file: File): void {
    if (starting.value || !text.value.trim())
        report(new Error(`${file.name}: a picture becomes a pattern of a skin. Begin with a model or an example.`));
    else dropped_picture.value = file;
}

/** Changes that make a picture the pattern of the skin. */
function pattern_changes(image: string, use: Use): Change[] {
    const given = given_at({ section: "skin" });
    const width = job.value ? Number((size_of(job.value) / (use === "image" ? 1 : 4)).toPrecision(2)) : 20;
    const values: Record<string, string> = { pattern: use, image, image_size: `${width}` };
    for (const key of ["thickness", ...needed(table.value, "skin", use, { ...given, ...values })]) {
        const setting = table.value.settings.find((one) => one.section === "skin" && one.key === key);
        const value = setting && !(key in given) && !(key in values) ? starter(setting) : null;
        if (value !== null) values[key] = value;
    }
    const stray = Object.keys(given).filter((key) => ["window", "second_image", "second_weight"].includes(key));
    return [
        ...stray.map((key) => ({ section: "skin", key, value: null })),
        ...Object.entries(values).map(([key, value]) => ({ section: "skin", key, value })),
    ];
}

export async function use_picture(use: Use): Promise<void> {
    const file = dropped_picture.value;
    dropped_picture.value = null;
    if (!file) return;
    try {
        const { path } = await send_file(file);
        edit(pattern_changes(path, use), `picture ${path}`);
        tab.value = "design";
    } catch (error) {
        report(error);
    }
}
