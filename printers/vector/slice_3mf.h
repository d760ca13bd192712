// Back-end: contours as a slice stack in a 3MF package (3MF slice extension 1.0.2), for powder-bed machines.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes one package. The model holds an object for the part and, if there are
/// supports, one for them. Their slices are in separate parts of the package with
/// ExchangeProfile::package_layers slices each, to which the model's slice stacks refer. Memory: one such
/// part, compressed. An interrupted run is resumed at the start of the last part.
///
/// The format requires a mesh for each object. It is the bounding box of the job, declared as low resolution,
/// so the package requires the extension. Slices use the part's own x and y, heights above the plate, and
/// points rounded to 0.1 um; the build item moves them to positive x and y.
std::unique_ptr<Backend> make_slice_3mf(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
