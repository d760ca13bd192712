// Interpolates between five colours.
#include "app/reports/modulus_paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"

namespace lamella {

namespace {

/// From dark blue over green to yellow with uniformly increasing lightness, readable with red-green colour
/// blindness.
constexpr std::array<dvec3, 5> scale{dvec3{0.058, 0.001, 0.089},
                                     {0.043, 0.084, 0.258},
                                     {0.015, 0.278, 0.262},
                                     {0.107, 0.584, 0.122},
                                     {0.984, 0.800, 0.019}};
constexpr dvec3 softer{0.85, 0.03, 0.03}, stiffer{0.9, 0.9, 0.9};

dvec3 on_scale(double share) {
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(scale.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(place), scale.size() - 2);
    const double t = place - static_cast<double>(i);
    return scale[i] * (1 - t) + scale[i + 1] * t;
}

/// The modulus at a place: beside the asked one, or its share of the logarithmic scale.
struct PlacedModulus {
    enum class Kind : unsigned char { softer, stiffer, on_scale };
    Kind kind = Kind::on_scale;
    double share = 0;
};

std::function<PlacedModulus(dvec3)> placed_modulus(const BuiltModulus& modulus, const ModulusReport& report) {
    const double low = std::log(report.predicted.lo), width = std::log(report.predicted.hi) - low;
    return [modulus, low, width](dvec3 p) -> PlacedModulus {
        using Kind = PlacedModulus::Kind;
        const double made = modulus.made->at(p);
        if (modulus.asked) {
            const double asked = modulus.asked->asked->at(p);
            if (made < asked * (1 - modulus_tolerance)) return {Kind::softer};
            if (made > asked * (1 + modulus_tolerance)) return {Kind::stiffer};
        }
        return {Kind::on_scale, width > 0 ? std::clamp((std::log(made) - low) / width, 0.0, 1.0) : 0.5};
    };
}

void check_has_modulus(const BuiltJob& built, const std::string& who) {
    if (built.modulus) return;
    throw InputError(
        who +
        ": the foam's modulus is unknown; accepted: [material] as well, and foam.law if there is "
        "no built-in law");
}

}  // namespace

std::function<dvec3(dvec3)> modulus_paint(const BuiltJob& built, const std::string& who) {
    check_has_modulus(built, who);
    return [place = placed_modulus(*built.foam->modulus, *built.modulus)](dvec3 p) {
        const PlacedModulus found = place(p);
        if (found.kind == PlacedModulus::Kind::softer) return softer;
        return found.kind == PlacedModulus::Kind::stiffer ? stiffer : on_scale(found.share);
    };
}

std::function<std::uint8_t(dvec3)> modulus_codes(const BuiltJob& built, const std::string& who) {
    check_has_modulus(built, who);
    return [place = placed_modulus(*built.foam->modulus, *built.modulus)](dvec3 p) -> std::uint8_t {
        const PlacedModulus found = place(p);
        if (found.kind == PlacedModulus::Kind::softer) return ModulusCode::softer;
        if (found.kind == PlacedModulus::Kind::stiffer) return ModulusCode::stiffer;
        constexpr int span = ModulusCode::most - ModulusCode::least;
        return static_cast<std::uint8_t>(ModulusCode::least + std::lround(span * found.share));
    };
}

std::string modulus_legend(const ModulusReport& report) {
    std::string text = fmt::format("colours: {:.3g} MPa dark blue to {:.3g} MPa yellow", report.predicted.lo,
                                   report.predicted.hi);
    if (report.is_asked) text += "; red where the foam gets softer than asked, white where stiffer";
    return text;
}

}  // namespace lamella
