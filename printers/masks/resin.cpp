// Ramp from the first exposure to the regular one.
#include "printers/masks/resin.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"

namespace lamella {

void check_resin_profile(const ResinProfile& resin) {
    const auto check = [](const char* what, double value, double most) {
        if (!(value > 0 && value <= most)) {
            throw InputError(fmt::format("{} of {}: must be above 0, at most {}", what, value, most));
        }
    };
    check("exposure (s)", resin.exposure, 1e4);
    check("first exposure (s)", resin.first_exposure, 1e4);
    check("lift (mm)", resin.lift, 1e3);
    check("lift speed (mm/min)", resin.lift_speed, 1e5);
    check("retract speed (mm/min)", resin.retract_speed, 1e5);
}

double resin_exposure(const ResinProfile& resin, int index) {
    const int faded = index - resin.first_layers + 1;
    if (faded <= 0) return resin.first_exposure;
    if (faded > resin.fade_layers) return resin.exposure;
    return resin.first_exposure + (resin.exposure - resin.first_exposure) * faded / (resin.fade_layers + 1);
}

double resin_print_time(const ResinProfile& resin, int layers) {
    const int ramp = std::min(layers, resin.first_layers + resin.fade_layers);
    double seconds = (layers - ramp) * resin.exposure;
    for (int layer = 0; layer < ramp; ++layer) seconds += resin_exposure(resin, layer);
    return seconds + layers * resin.moves;
}

std::string machine_name(const PrinterProfile& profile) {
    return profile.resin.machine.empty() ? profile.name : profile.resin.machine;
}

std::string describe_resin(const ResinProfile& r) {
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {}", r.machine, r.material, r.exposure,
                       r.first_exposure, r.first_layers, r.fade_layers, r.moves, r.lift, r.lift_speed,
                       r.retract_speed, r.light, r.preview, r.notes);
}

}  // namespace lamella
