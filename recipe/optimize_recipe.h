// The problem of a structural optimisation, as plain data: loads, anchors, and what is optimised.
#pragma once

#include <string>

#include "engine/base/geometry.h"
#include "recipe/number_rows.h"

namespace lamella {

/// What of the body a load or an anchor takes hold of. A checked recipe gives exactly one of: the inside of a
/// field, a box, the far side of a plane, a face.
struct PlaceRecipe {
    std::string where;  ///< where the entry begins, for messages
    std::string field;  ///< name of a [[field]]: what of the body lies inside it; empty: not given
    NumberRows box;     ///< two corners, mm; empty: not given
    dvec3 at{0};        ///< a point of the plane, mm
    dvec3 normal{0};    ///< side of the plane on which the place lies, of any length; zero: not given
    /// "-x", "+x", "-y", "+y", "-z" or "+z": the outermost layer of the body's elements in that direction;
    /// empty: not given.
    std::string face;
};

/// A load: a force or a pressure on a place.
struct LoadRecipe : PlaceRecipe {
    dvec3 force{0};  ///< total, spread evenly over the nodes of the body in the place, N; zero: not given
    double pressure = 0;  ///< on the body's surface in the place, inward along its normal, MPa; 0: not given
    std::string load_case = "1";  ///< loads of one case act together, cases one after another
    double weight = 1;            ///< of the case in the sum of compliances; all loads of a case have one
};

/// A place where the body is held.
struct AnchorRecipe : PlaceRecipe {
    std::string fix = "xyz";  ///< the axes along which it cannot move: letters x, y, z, each at most once
};

/// Least compliance at a bounded volume; or, at a bounded compliance, least volume or the looks of a picture.
enum class OptimizeKind : unsigned char { stiffness, lightness, appearance };

/// What the densities become: material or void, the foam's cell size or beam radius, or the [[field]] and
/// [[grading]] entries of kind `optimized` alone.
enum class OptimizeResult : unsigned char { solid, cell, beam, field };

/// Returns true if densities are those of the part's foam.
constexpr bool drives_foam(OptimizeResult result) {
    return result == OptimizeResult::cell || result == OptimizeResult::beam;
}

/// The update of densities: optimality criteria, or the method of moving asymptotes.
enum class OptimizeMethod : unsigned char { oc, mma };

/// What is optimised. The part is the design domain; regions that are solid or empty stay as they are.
struct OptimizeRecipe {
    static constexpr double whole_part = 0.999;  ///< the largest `volume`

    OptimizeKind kind = OptimizeKind::stiffness;
    OptimizeResult result = OptimizeResult::solid;
    double volume = 0.5;    ///< share of the part's volume, at most; without effect when `mass` is given
    double volume_min = 0;  ///< appearance: share of the part's volume, at least
    double mass = 0;        ///< at most, g; 0: `volume` holds
    /// At most: for lightness as a multiple of the full part's, for appearance of the least compliance.
    double compliance = 1.2;
    double element = 0;  ///< edge of the finite elements, mm; 0: not given
    int elements = 0;    ///< number along the part's longest side; 0: not given. Neither: 64 in 3D, 200 in 2D
    int dimensions = 3;  ///< 2: a plate in the xy plane in plane stress, as thick as the part is high
    double radius = 0;   ///< of the density filter, mm; 0: 1.5 elements
    double member = 0;   ///< least size of members, mm; 0: any. Above 0: robust formulation
    double gap = 0;      ///< least size of gaps, mm; 0: any. Above 0: robust formulation
    bool overhang = false;    ///< 3D: each layer of elements rests on the one below it, at 45 degrees
    std::string symmetry;     ///< axes across which a plane through the part's middle mirrors: "xy"
    dvec3 gravity{0};         ///< m/s^2; zero: no self-weight
    int iterations = 0;       ///< at most; 0: not given
    double tolerance = 0.01;  ///< largest change of a density in a step, at which it stops
    double penalty = 3;       ///< exponent of the modulus over the density (SIMP)
    double sharpness = 16;    ///< of the projection to 0 and 1 at the end; 0: no projection
    OptimizeMethod method = OptimizeMethod::oc;  ///< appearance: always mma
    std::string image;                           ///< appearance: path of a picture
    double image_size = 0;                       ///< appearance: length that its width covers, mm
    bool invert = false;                         ///< appearance: material where the picture is bright
    double threshold = 0;                        ///< appearance: luma from which it is bright; 0: not given
    int neighbourhood = 14;                      ///< appearance: edge of compared windows, elements
    double exponent = 1.2;                       ///< appearance: of differences of grey
    double spread = 20;                          ///< appearance: weight of an even use of the picture
    int levels = 3;                              ///< appearance: grids, each twice as fine as the one before
};

}  // namespace lamella
