// The survey for joins: two streaming passes over a job's layers that find short ways between its pieces.
#pragma once

#include <vector>

#include "engine/layers/layer_stream.h"

namespace lamella {

/// A way from a point of one piece to a point of another.
struct PieceJoin {
    dvec3 a{0}, b{0};  ///< mm
    double length() const { return glm::distance(a, b); }
};

struct JoinSurveyOptions : PassControl {
    double pitch = 0.1;              ///< mm from one surveyed row to the next
    std::size_t max_pieces = 10000;  ///< that can be joined
};

struct JoinSurvey {
    std::size_t pieces = 0;        ///< of the part, the largest included
    std::vector<PieceJoin> joins;  ///< one less than there are pieces: with them all are one
};

/// Finds a spanning tree of short ways between the connected pieces of a job's part. Runs that overlap or
/// touch, in neighbouring rows and layers, corners included, are of one piece.
///
/// Pieces are first known by points about a 64th of the job's diagonal apart, which choose who is joined to
/// whom (Boruvka's tree); each way is then made the shortest there is between the runs about its ends. A pure
/// function of part, layers and pitch, the same by any number of threads. Memory depends on a few layers'
/// runs, on the runs about the joins and on those points, not on the number of layers. Throws InputError when
/// the pitch does not suit the job (survey_pitch_range says which do) or there are too many pieces,
/// Interrupted when cancelled.
JoinSurvey survey_joins(const Job& job, const JoinSurveyOptions& options);

}  // namespace lamella
