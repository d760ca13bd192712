// Stiffness: how stiff the foam is, and the search for a stiff or light part.
import { FoamPanel } from "./foam_panel";
import { SearchPanel } from "./search_panel";

export function StiffnessPanel() {
    return (
        <div class="panel">
            <div class="panel-scroll" tabIndex={-1}>
                <FoamPanel />
                <SearchPanel />
            </div>
        </div>
    );
}
