// The design of a search that the view shows instead of the part.
import { signal } from "@preact/signals";

export interface ShownDesign {
    /** Of the search, and how many designs it has had. */
    id: number;
    number: number;
    step: number;
    /** The text of its recipe. */
    of: string;
}

/** Null: the part is shown. */
export const shown_design = signal<ShownDesign | null>(null);
