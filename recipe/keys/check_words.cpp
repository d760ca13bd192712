// Names, limits and advice, check by check.
#include "recipe/keys/check_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/checks/check_table.h"
#include "recipe/keys/settings_rows.h"

namespace lamella {
namespace {

std::string with_upright(double within, double up) {
    std::string text = fmt::format("at least {:.4g} mm", within);
    if (up > 0) text += up == within ? ", also upright" : fmt::format(", {:.4g} mm upright", up);
    return text;
}

std::string build_volume_text(dvec3 available) {
    if (!std::isfinite(available.x) || !std::isfinite(available.y)) return "the machine's size is not known";
    std::string text = fmt::format("within {:.6g} x {:.6g}", available.x, available.y);
    if (std::isfinite(available.z)) text += fmt::format(" x {:.6g}", available.z);
    return text + " mm";
}

/// Returns a positive number with three digits, without an exponent: "0.0000156".
std::string decimal(double number) {
    const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(number))));
    std::string text = fmt::format("{:.{}f}", number, decimals);
    if (decimals > 0) text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

struct Words {
    const char* fault;
    const char* advice;
    std::string (*limit)(const PrintLimits& limits);
};

/// By Check.
const std::array<Words, check_count> table{{
    {"a piece is not joined to the rest of the part",
     "Join it to the part, or leave loose pieces of foam out with --drop-islands.",
     [](const PrintLimits& limits) -> std::string {
         if (limits.piece <= 0) return "the part is one piece";
         return fmt::format("one piece, but for crumbs below {} mm3", decimal(limits.piece));
     }},
    {"a layer falls into several pieces",
     "Join them in the design, or have bars put between them: --printer-ties join.",
     [](const PrintLimits&) -> std::string { return "each layer is one piece"; }},
    {"something begins with nothing below it",
     "Supports hold it (--support bridges or pillars), or another way up needs none.",
     [](const PrintLimits& limits) -> std::string {
         if (limits.island <= 0) return "nothing begins in the air";
         return fmt::format("nothing in the air but specks below {:.3g} mm2", limits.island);
     }},
    {"a layer stands out too far over the one below",
     "Supports hold it (--support bridges or pillars), or a gentler slope or thinner layers need none.",
     [](const PrintLimits& limits) {
         return fmt::format("at most {:.4g} mm over the layer below", limits.overhang);
     }},
    {"a stretch between two holds is too long",
     "Shorten it, turn the part, or add supports (--support bridges or pillars).",
     [](const PrintLimits& limits) {
         return fmt::format("at most {:.4g} mm from hold to hold", limits.bridge);
     }},
    {"a wall or strut is too thin",
     "Make it thicker there: a thicker skin (--skin) or beam (--beam), or a machine that makes finer things.",
     [](const PrintLimits& limits) { return with_upright(limits.thickness, limits.thickness_up); }},
    {"large parts are joined by something thin", "Make the neck thicker, or expect it to break there.",
     [](const PrintLimits& limits) {
         return fmt::format("at least {:.4g} mm between parts over {:.4g} mm3", limits.neck,
                            limits.large_part);
     }},
    {"a void is too narrow and closes up", "Widen it, or fill it.",
     [](const PrintLimits& limits) { return with_upright(limits.gap, limits.gap_up); }},
    {"a void is closed off", "Open it: --drains 1 for a hollow part, a [[hole]], or a foam of open cells.",
     [](const PrintLimits& limits) { return fmt::format("no closed void over {:.4g} mm3", limits.cavity); }},
    {"a void is closed off by the vat's film while it is printed",
     "Give it a hole near the plate (--drains 2, or a [[hole]]), or turn the part over.",
     [](const PrintLimits& limits) { return fmt::format("no suction cup over {:.4g} mm3", limits.cup); }},
    {"a section is too small for the layers that are peeled off the vat's film above it",
     "Make it thicker there, turn the part so that its layers are smaller, or add supports "
     "(--support pillars).",
     [](const PrintLimits& limits) {
         return fmt::format("at most {:.4g} mm2 of a layer for each mm2 that holds it", limits.peel);
     }},
    {"the part sticks out of the machine's reach", "Scale or turn the part, or take a larger machine.",
     [](const PrintLimits& limits) { return build_volume_text(limits.build_volume); }},
    {"a layer holds nothing of the part", "Join what lies above it to what lies below.",
     [](const PrintLimits&) -> std::string { return "something in every layer"; }},
}};

const Words& words_of(Check check) { return table[static_cast<std::size_t>(check)]; }

}  // namespace

std::string process_name(Process process) { return choice_names(process)[static_cast<std::size_t>(process)]; }
std::string check_name(Check check) { return check_info(check).name; }
std::string check_fault(Check check) { return words_of(check).fault; }
std::string check_advice(Check check) { return words_of(check).advice; }
const char* size_unit(Check check) { return check_info(check).unit; }

std::string check_limit(Check check, const PrintLimits& limits) { return words_of(check).limit(limits); }

std::string size_text(Check check, double size) {
    const char* unit = size_unit(check);
    if (size < 0.001) return fmt::format("below 0.001 {}", unit);
    const int digits = size < 1 ? 3 : size < 10 ? 2 : size < 100 ? 1 : 0;
    return fmt::format("{:.{}f} {}", size, digits, unit);
}

const char* outcome_word(const CheckResult& result) {
    if (result.passed()) return "pass";
    return result.verdict == Severity::fail ? "FAIL" : "warn";
}

std::string layers_text(const Fault& fault) {
    if (fault.end_layer - fault.first_layer <= 1) return fmt::format("layer {}", fault.layer);
    return fmt::format("layers {} to {}", fault.first_layer, fault.end_layer - 1);
}

std::string place_text(dvec3 at) {
    // A rounded -0.00 is 0.
    const auto rounded = [](double v) { return std::round(v * 100) / 100 + 0.0; };
    return fmt::format("({:.2f}, {:.2f}, {:.2f}) mm", rounded(at.x), rounded(at.y), rounded(at.z));
}

}  // namespace lamella
