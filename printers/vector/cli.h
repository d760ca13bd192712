// Back-end: contours as a Common Layer Interface file (CLI 2.0), for powder-bed machines.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes one file: a header in ASCII, then the layers in ASCII or binary (the long
/// commands: 32-bit integers and floats, least significant byte first, directly after the header). A layer is
/// identified by the height of its top above the plate; x and y are the part's own. Contours are closed
/// polylines that repeat their first point: outer contours counter-clockwise (direction 1), holes clockwise
/// (direction 0). The part is number 1, supports are number 2. Coordinates are rounded to 0.1 um before they
/// are written in units of ExchangeProfile::cli_units. The file has no date, so that equal jobs give equal
/// bytes.
std::unique_ptr<Backend> make_cli(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
