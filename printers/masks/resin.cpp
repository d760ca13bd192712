// Ramp from the first exposure to the regular one.
#include "printers/masks/resin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace lamella {

void check_resin_profile(const ResinProfile& given, double greatest_height) {
    const ResinProfile resin = resin_for_height(given, greatest_height);

    const auto check = [](const std::string& what, double value, double most) {
        if (!(value > 0 && value <= most)) {
            throw InputError(fmt::format("{} of {}: must be above 0, at most {}", what, value, most));
        }
    };
    const std::string of_height =
        given.penetration > 0 ? fmt::format(" of a layer of {} mm", greatest_height) : "";
    check("exposure" + of_height + " (s)", resin.exposure, 1e4);
    check("first exposure" + of_height + " (s)", resin.first_exposure, 1e4);
    check("lift (mm)", resin.lift, 1e3);
    check("lift speed (mm/min)", resin.lift_speed, 1e5);
    check("retract speed (mm/min)", resin.retract_speed, 1e5);
}

ResinProfile resin_for_height(const ResinProfile& resin, double height) {
    if (resin.penetration <= 0) return resin;
    ResinProfile suited = resin;
    const double factor = std::exp((height - resin.exposure_height) / resin.penetration);
    suited.exposure *= factor;
    suited.first_exposure *= factor;
    return suited;
}

double resin_exposure(const ResinProfile& given, int index, double height) {
    const ResinProfile resin = resin_for_height(given, height);
    const int faded = index - resin.first_layers + 1;
    if (faded <= 0) return resin.first_exposure;
    if (faded > resin.fade_layers) return resin.exposure;
    return resin.first_exposure + (resin.exposure - resin.first_exposure) * faded / (resin.fade_layers + 1);
}

double resin_print_time(const ResinProfile& resin, const LayerPlan& layers, LayerRange range) {
    const int ramp = range.first + std::min(range.count(), resin.first_layers + resin.fade_layers);
    double seconds = range.count() * resin.moves;
    for (int layer = range.first; layer < ramp; ++layer)
        seconds += resin_exposure(resin, layer - range.first, layers.height(layer));
    int first = 0;
    for (const EqualLayers& run : layers.runs()) {
        const int end = first + run.count;
        const int others = std::min(end, range.last) - std::max(first, ramp);
        if (others > 0) seconds += others * resin_for_height(resin, run.height).exposure;
        first = end;
    }
    return seconds;
}

std::string machine_name(const PrinterProfile& profile) {
    return profile.resin.machine.empty() ? profile.name : profile.resin.machine;
}

std::string describe_resin(const ResinProfile& r) {
    std::string text = fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {}", r.machine, r.material,
                                   r.exposure, r.first_exposure, r.first_layers, r.fade_layers, r.moves,
                                   r.lift, r.lift_speed, r.retract_speed, r.light, r.preview, r.notes);
    if (r.penetration > 0) text += fmt::format(" {} {}", r.penetration, r.exposure_height);
    return text;
}

}  // namespace lamella
