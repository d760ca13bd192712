// Exposures and print times of resin printers, used by several back-ends.
#pragma once

#include <string>

#include "printers/common/profile.h"

namespace lamella {

/// Throws InputError for values that no machine accepts.
void check_resin_profile(const ResinProfile& resin);

/// Returns the exposure of layer `index` (from 0), s: the first layers, then a linear ramp, then all others.
double resin_exposure(const ResinProfile& resin, int index);

/// Returns the time of exposures and moves of `layers` layers, s.
double resin_print_time(const ResinProfile& resin, int layers);

/// Returns the model that a file is made for; if the profile does not state it, the profile's name.
std::string machine_name(const PrinterProfile& profile);

/// Returns all settings in one line, for a job's stamp.
std::string describe_resin(const ResinProfile& resin);

}  // namespace lamella
