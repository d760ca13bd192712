// Back-end: contours as a slice stack in a 3MF package (3MF slice extension 1.0.2), for powder-bed machines.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Writes one package. The model holds an object for the part and, where there are supports, one for them;
/// their slices stand in parts of the package with ExchangeProfile::package_layers slices each, to which the
/// model's slice stacks refer. What is held in memory is one such part, compressed, and a run that was
/// stopped is continued where the last one begins.
///
/// The format wants a mesh of each object: it is the box around the job, declared to be of low resolution, so
/// the package requires the extension. Slices have the part's own x and y, heights over the plate, and points
/// rounded to 0.1 um; the build item moves them to where x and y are positive.
std::unique_ptr<Backend> make_slice_3mf(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
