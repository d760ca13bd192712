// Exposures and print times of resin printers, used by several back-ends.
#pragma once

#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Throws InputError for values that no machine accepts, with layers up to this height, mm.
void check_resin_profile(const ResinProfile& resin, double greatest_height);

/// Returns the exposures of a resin for layers of some height, mm. Light fades exponentially with depth, so
/// a layer that is higher by the penetration depth takes e times as long (Jacobs, "Rapid Prototyping &
/// Manufacturing", 1992, chapter 4: the working curve).
ResinProfile resin_for_height(const ResinProfile& resin, double height);

/// Returns the exposure of layer `index` (from 0) of a height (mm), s: the first layers, then a linear ramp,
/// then all others.
double resin_exposure(const ResinProfile& resin, int index, double height);

/// Returns the time of exposures and moves of a print of these layers, s.
double resin_print_time(const ResinProfile& resin, const LayerPlan& layers, LayerRange range);

/// Returns the model that a file is made for; if the profile does not state it, the profile's name.
std::string machine_name(const PrinterProfile& profile);

/// Returns all settings in one line, for a job's stamp.
std::string describe_resin(const ResinProfile& resin);

}  // namespace lamella
