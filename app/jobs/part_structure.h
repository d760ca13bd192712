// Which places of a part are skin, frame, solid regions, and what is below them.
#pragma once

#include <string>
#include <vector>

#include "app/jobs/served_job.h"

namespace lamella {

/// Returns what a part is made of that can be told apart: "skin", "frame", "solid" and
/// last what lies in none of these, "foam", "skin" or "body"; and "supports". Empty for one of these alone,
/// and for several parts on a plate.
std::vector<std::string> structure_parts(const ServedJob& job);

/// Returns a JSON head as that of coverage_volume() with three channels, and for each voxel how far its
/// middle lies within the skin, a frame and a solid region: 128 at their boundary, 255 two voxels within, 1
/// two voxels outside, 0 away from the part. The skin is all of the part within its thickness of the
/// surface. "parts" of the head is structure_parts(). A place belongs to the last
/// of the three that it lies in; a frame below a closed skin lies in the skin. Throws HttpError 400 where
/// structure_parts() is empty, Interrupted when cancelled.
std::string structure_volume(const ServedJob& job, int longest, const PassControl& control);

}  // namespace lamella
