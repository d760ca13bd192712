// Takes a model that was dropped or chosen: sends it, and makes it the part of the recipe.
import { signal } from "@preact/signals";
import { edit_recipe, send_file } from "../server/api";
import { Failure } from "../server/http";
import type { Change } from "../server/types";
import { mesh_changes } from "../form/changes";
import { headers } from "../form/places";
import { mesh_endings } from "../form/path_control";
import { report } from "../state/notices";
import { edit, open_text } from "../state/recipe";
import { starting, tab, text } from "../state/store";
import { offer_picture, picture_endings } from "./take_picture";

export const sending = signal("");
/** The machine of new recipes; empty: the recipe's own, or the usual one. */
export const machine_for_new = signal(localStorage.getItem("lamella-machine") ?? "");

export function choose_machine_for_new(name: string): void {
    machine_for_new.value = name;
    localStorage.setItem("lamella-machine", name);
}

function new_recipe(mesh: string): string {
    const names_unit = /\.3mf$/i.test(mesh);
    const lines = [
        "[part]",
        `mesh = ${JSON.stringify(mesh)}`,
        ...(names_unit ? [] : ['unit = "mm"        # the file does not say']),
        "",
        "[foam]",
        "cell = 4           # mean diameter of a cell, mm",
        "beam = 0.5         # radius of the beams, mm",
        "",
        "[skin]",
        "thickness = 0.8    # mm",
        "",
    ];
    return lines.join("\n");
}

/** Changes that give a recipe another machine: keys for the one before may not go with it. */
function machine_changes(recipe: string, machine: string): Change[] {
    const had = headers(recipe).some((one) => one.section === "printer");
    const fresh = { section: "printer", key: "profile", value: machine };
    return had ? [{ section: "printer", key: null, value: null }, fresh] : [fresh];
}

/** Opens a new recipe, for the machine that was chosen. */
export async function open_new(recipe: string): Promise<void> {
    try {
        const machine = machine_for_new.value;
        const changed = machine && (await edit_recipe(recipe, machine_changes(recipe, machine))).text;
        open_text(changed || recipe);
        tab.value = "design";
    } catch (error) {
        report(error);
    }
}

export function is_recipe(file: File): boolean {
    return file.name.toLowerCase().endsWith(".toml");
}

export async function take_files(files: FileList | File[]): Promise<void> {
    const file = [...files][0];
    if (!file) return;
    const name = file.name.toLowerCase();
    if (is_recipe(file)) {
        open_text(await file.text());
        return;
    }
    if (picture_endings.some((ending) => name.endsWith(ending))) {
        offer_picture(file);
        return;
    }
    if (!mesh_endings.some((ending) => name.endsWith(ending))) {
        report(
            new Error(
                `${file.name}: not a model. STL, OBJ, PLY and 3MF files can be dropped, pictures, and recipes (TOML).`,
            ),
        );
        return;
    }
    sending.value = file.name;
    try {
        const { path } = await send_file(file);
        if (starting.value || !text.value.trim()) await open_new(new_recipe(path));
        else edit(mesh_changes(path));
    } catch (error) {
        report(
            error instanceof Failure && error.status === 0
                ? new Error(`${file.name} was not sent: ${error.message}`)
                : error,
        );
    }
    sending.value = "";
}
