// The modulus of a part's foam, place by place.
#pragma once

#include <functional>
#include <string>

#include "app/jobs/served_job.h"

namespace lamella {

/// Returns a JSON head as that of coverage_volume() with one channel, and for each voxel a code: 0 away from
/// the part, 1 where its foam is softer than asked, 2 where it is stiffer, 3 to 255 from the least predicted
/// modulus to the greatest on a logarithmic scale. "scale" of the head has the ends: {"lo_mpa", "hi_mpa",
/// "is_asked"}. Throws InputError for a foam of unknown modulus, HttpError 400 for several parts,
/// Interrupted when cancelled.
std::string modulus_volume(const ServedJob& job, int longest, const PassControl& control);

}  // namespace lamella
