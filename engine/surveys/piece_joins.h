// Join survey: finds short connections between the disconnected pieces of a part, in two streaming passes
// over a job's layers.
#pragma once

#include <vector>

#include "engine/layers/layer_stream.h"

namespace lamella {

/// A straight connection from a point of one piece to a point of another.
struct PieceJoin {
    dvec3 a{0}, b{0};  ///< mm
    double length() const { return glm::distance(a, b); }
};

struct JoinSurveyOptions : PassControl {
    double pitch = 0.1;              ///< mm from one surveyed row to the next
    std::size_t max_pieces = 10000;  ///< most pieces that can be joined
};

struct JoinSurvey {
    std::size_t pieces = 0;        ///< number of pieces of the part
    std::vector<PieceJoin> joins;  ///< one less than pieces: a spanning tree
};

/// Finds a spanning tree of short connections between the pieces of a job's part. Runs that overlap or touch,
/// in neighbouring rows and layers, corners included, belong to one piece.
///
/// The first pass represents the pieces by points about a 64th of the job's diagonal apart. These decide
/// which pieces are joined (Boruvka's tree). The second pass replaces each connection by the shortest one
/// between the runs around its ends.
///
/// A pure function of part, layers and pitch, independent of the number of threads. Memory depends on a few
/// layers' runs, on the runs around the joins and on the points, not on the number of layers. Throws
/// InputError when the pitch does not suit the job (see survey_pitch_range) or there are too many pieces,
/// Interrupted when cancelled.
JoinSurvey survey_joins(const Job& job, const JoinSurveyOptions& options);

}  // namespace lamella
