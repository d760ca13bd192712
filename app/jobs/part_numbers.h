// The graded numbers of a part, place by place: those of its foam and skin, and the recipe's gradings.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/jobs/served_job.h"

namespace lamella {

/// Returns [{"name", "unit"}] of the numbers that vary over a part: "foam.cell" and other keys of foam and
/// skin, as they are made, in "mm" or without a unit; then the recipe's [[grading]] entries by their names,
/// whose unit is not known. None for several parts on a plate.
nlohmann::ordered_json varying_numbers(const ServedJob& job);

/// Returns a JSON head as that of coverage_volume() with one channel, and for each voxel a code of the number
/// with this name: 0 away from the part and where it is undefined, 3 to 255 evenly from the least number in
/// the body to the greatest, as "scale" of the head says: {"lo", "hi", "unit"}. Throws HttpError 400 for a
/// name that varying_numbers() does not have, InputError for a grading that cannot be made, Interrupted when
/// cancelled.
std::string number_volume(const ServedJob& job, const std::string& name, int longest,
                          const PassControl& control);

}  // namespace lamella
