// The state of a machine with several tools: followed, written down, restored.
#include "printers/serial/machine_state.h"

#include <catch2/catch.hpp>

namespace machine_state_test {

using namespace lamella;

namespace {

MachineState after(const std::vector<std::string>& lines, MachineState state = {}) {
    for (const std::string& line : lines) state.apply(line);
    return state;
}

MachineState printing_with_tool(const std::string& tool) {
    return after({"G90", "M83", "G28", "M104 T0 S215", "M104 T2 S190", "M140 S60", tool, "M109 S230",
                  "M106 S128", "G0 X20 Y30 Z1.2 F3000"});
}

}  // namespace

TEST_CASE("each tool has its own temperature", "[machine_state]") {
    MachineState state = printing_with_tool("T1");
    CHECK(state.nozzle() == 230);
    state.apply("T0");
    CHECK(state.nozzle() == 215);
    state.apply("T3");
    CHECK(state.nozzle() == 0);
    state.apply("M104 S205");
    CHECK(state.nozzle() == 205);
    state.apply("T2");
    CHECK(state.nozzle() == 190);
}

TEST_CASE("words that only look like tools change none", "[machine_state]") {
    const std::string word = GENERATE("T", "Tx", "T1a", "T-1", "TURN", "T1000");
    MachineState state = printing_with_tool("T1");
    state.apply(word);
    CHECK(state.nozzle() == 230);
    state.apply("M104 T1000 S20");
    CHECK(state.nozzle() == 230);
}

TEST_CASE("a machine that was switched off gets its tools back", "[machine_state]") {
    const std::string tool = GENERATE("T1", "T0", "M117 no tool");
    const MachineState state = printing_with_tool(tool);
    const MachineState again = MachineState::from_json(state.to_json());
    CHECK(again.to_json() == state.to_json());
    const MachineState restored = after(again.take_up(1.2, 0, 200, 250, "G92 Z1.2"));
    CHECK(restored.nozzle() == state.nozzle());
    CHECK(restored.to_json().at("tool") == state.to_json().at("tool"));
    if (tool != "M117 no tool") CHECK(restored.to_json().at("nozzles") == state.to_json().at("nozzles"));
    CHECK(restored.x() == state.x());
    CHECK(restored.z() == state.z());
}

TEST_CASE("all tools are switched off", "[machine_state]") {
    const MachineState off = after(printing_with_tool("T1").switch_off(), printing_with_tool("T1"));
    const auto state = off.to_json();
    CHECK(state.at("nozzles").size() == 3);
    for (const auto& degrees : state.at("nozzles")) CHECK(degrees == 0);
    CHECK(off.bed() == 0);
}

TEST_CASE("damaged states of tools are refused", "[machine_state]") {
    const auto state = printing_with_tool("T1").to_json();
    for (const char* tool : {"\"one\"", "1000", "0.5"}) {
        auto damaged = state;
        damaged["tool"] = nlohmann::ordered_json::parse(tool);
        CHECK_THROWS_AS(MachineState::from_json(damaged), nlohmann::json::exception);
    }
    auto damaged = state;
    damaged["nozzles"] = {1e300};
    CHECK_THROWS_AS(MachineState::from_json(damaged), nlohmann::json::exception);
}

}  // namespace machine_state_test
