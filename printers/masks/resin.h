// Exposures and times of resin printers, which archives and files state alike.
#pragma once

#include <string>

#include "printers/common/profile.h"

namespace lamella {

/// Throws InputError for numbers that no machine takes.
void check_resin_profile(const ResinProfile& resin);

/// Exposure of layer `index`, counted from 0, s: the first ones, a linear ramp, then all others.
double resin_exposure(const ResinProfile& resin, int index);

/// Exposures and moves of so many layers, s.
double resin_print_time(const ResinProfile& resin, int layers);

/// The model that a file is for: the profile's own name where it does not say.
std::string machine_name(const PrinterProfile& profile);

/// All of it in one line, for a job's stamp.
std::string describe_resin(const ResinProfile& resin);

}  // namespace lamella
