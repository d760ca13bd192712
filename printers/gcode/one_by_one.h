// Parts of a plate that are printed one after the other, each from the bed up.
#pragma once

#include "engine/layers/layer.h"
#include "printers/common/profile.h"

namespace lamella {

/// Throws InputError where the machine's gantry would hit a part that is done: all but the last are at most
/// as high as the room below it. Does nothing for other jobs.
void check_gantry(const Job& job, const PrinterProfile& profile);

}  // namespace lamella
