// A figure of each layer over the height: area, islands, time.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/jobs/served_job.h"

namespace lamella {

/// Each of these returns {"layers_a_value", ...} with at most `values` figures, evenly spread over the
/// layers. Throws Interrupted when cancelled.

/// The areas of layers, "area_mm2" and "support_area_mm2", to about a percent. Of several layers that share a
/// value the one in their middle is measured.
nlohmann::ordered_json area_curve(const ServedJob& job, int values, const PassControl& control);

/// How many pieces of a layer begin with nothing below them, neither the part nor a support within the gap
/// that supports keep, as "islands": all of the layers that share a value, and the first layer has none.
/// Layers are sampled in rows "pitch_mm" apart, as the print check's or at most 640: what is no farther than
/// a row from something below rests on it. Where something floats, six times as many rows are counted in.
nlohmann::ordered_json island_curve(const ServedJob& job, int values, const PassControl& control);

/// The time of layers as "seconds": by the motion model without the way to the layer's first path, as
/// layer_paths() has it; of resin, exposures and moves. Of several layers that share a value the one in their
/// middle is taken. Throws HttpError 400 for machines of which no time is known.
nlohmann::ordered_json time_curve(const ServedJob& job, int values, const PassControl& control);

}  // namespace lamella
