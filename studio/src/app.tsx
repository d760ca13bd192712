// The page: header, left panel by tab, view, layer pane, curve and status line.
import { CheckPanel } from "./check/check_panel";
import { Form } from "./form/form";
import { CurvePane } from "./layers/curve";
import { LayerPane } from "./layers/pane";
import { MakePanel } from "./make/make_panel";
import { PrintPanel } from "./print/print_panel";
import { Header } from "./shell/header";
import { Messages } from "./shell/messages";
import { Segments } from "./shell/segments";
import { StatusLine } from "./shell/status";
import { DropShade } from "./start/drop";
import { PictureDialog } from "./start/picture_dialog";
import { Start } from "./start/start";
import { StiffnessPanel } from "./stiffness/stiffness_panel";
import { left_mode, ready, starting, tab, text } from "./state/store";
import { TextEditor } from "./text/editor";
import { View } from "./view/view";

function DesignPanel() {
    return (
        <div class="panel">
            <div class="mode-row">
                <Segments
                    label="How the recipe is shown"
                    value={left_mode.value}
                    choices={[
                        { word: "form", label: "Form" },
                        { word: "text", label: "Recipe text" },
                    ]}
                    choose={(word) => {
                        left_mode.value = word;
                    }}
                />
            </div>
            {left_mode.value === "form" ? <Form /> : <TextEditor />}
        </div>
    );
}

const panels = {
    design: DesignPanel,
    check: CheckPanel,
    stiffness: StiffnessPanel,
    make: MakePanel,
    print: PrintPanel,
};

function Workbench() {
    const Panel = panels[tab.value];
    return (
        <main class="bench">
            <div class="left" id="left-panel" role="tabpanel" aria-labelledby={`tab-${tab.value}`}>
                <Panel />
            </div>
            <View />
            <LayerPane />
            <CurvePane />
        </main>
    );
}

export function App() {
    if (!ready.value)
        return (
            <>
                <Header />
                <main class="start" aria-busy="true" />
                <Messages />
            </>
        );
    const start = starting.value || !text.value.trim();
    return (
        <>
            <Header />
            {start ? <Start /> : <Workbench />}
            <StatusLine />
            <Messages />
            <DropShade />
            <PictureDialog />
        </>
    );
}
