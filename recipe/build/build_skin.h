// Windows and holes of a skin, from the recipe's [skin] and [[hole]]. fill_body.h makes the skin itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/cancel_token.h"
#include "procedural/elements/element_plan.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

/// What came of a skin's pattern.
struct PatternReport {
    std::string pattern;
    std::size_t windows = 0;       ///< cells of the pattern; 0 for a picture
    std::size_t closed = 0;        ///< cells too small for a window
    std::size_t islands = 0;       ///< solid parts of a picture that hang on nothing and were left out
    double open_share = 0;         ///< of a picture, or a pattern by example, that is window
    double picture_share = 0;      ///< by example: of the picture that is window
    std::uint64_t pieces = 0;      ///< by example: before bridges joined them
    std::uint64_t joins = 0;       ///< by example: bridges between pieces
    std::uint64_t bridges = 0;     ///< by example: bridges that make it sounder
    std::uint64_t cut_struts = 0;  ///< by example: left, as in BridgePlan
    std::uint64_t hanging = 0;     ///< by example: places left that begin in the air, if it supports itself
    std::uint64_t detours = 0;
    std::uint64_t dropped = 0;   ///< by example: pieces too small to keep
    double softness_before = 0;  ///< by example: as in SurfaceBricks
    double softness = 0;
    std::optional<ElementPlan> elements{};  ///< of a skin of elements
    double site = 0;        ///< by example: distance of the points that the pattern is computed on, mm
    std::size_t bytes = 0;  ///< by example: of the pattern in memory
};

/// A hole as it is drilled.
struct DrilledHole {
    dvec3 from{0}, to{0};  ///< ends of its axis, mm
    double radius = 0;     ///< mm
    bool through = false;
};

/// Whether the recipe's skin is more than a closed one.
bool has_cut_skin(const Recipe& recipe);

/// How a pattern by example is made.
struct PatternWork {
    std::filesystem::path plans{};        ///< folder for patterns; empty: none are read or kept
    int threads = 0;                      ///< 0: one per core
    const CancelToken* cancel = nullptr;  ///< may be null
    /// Called before a pattern is synthesised, which may take minutes; may be empty.
    std::function<void()> on_synthesis{};
};

/// A body that was turned about the origin by `axes`; gradings are those of the body before.
struct TurnedBody {
    const FieldPtr& field;
    const glm::dmat3& axes;
};

/// The shell cut by the windows of the recipe's pattern. `depth` is the thickest the shell is, mm. Throws
/// InputError for what the pattern refuses, Interrupted when cancelled.
FieldPtr cut_windows(const Recipe& recipe, FieldPtr shell, const TurnedBody& body, double depth,
                     Gradings& gradings, const PatternWork& work, std::optional<PatternReport>& report);

/// Where the recipe's holes are drilled through a skin at most `depth` mm thick.
std::vector<DrilledHole> drilled_holes(const Recipe& recipe, const TurnedBody& body, double depth);

/// A hole of the given radius into the body from the point of its surface nearest to `at`: in `direction`, or
/// at right angles to the surface where that is zero; `deep` mm, or where that is 0 as deep as a skin of
/// `depth` mm needs. Throws InputError when the direction points out of the body.
DrilledHole drill(const Field& body, dvec3 at, dvec3 direction, double radius, double deep, double depth);

/// The solid less the holes.
FieldPtr without_holes(FieldPtr solid, std::span<const DrilledHole> holes);

/// The inputs from which a pattern is made, and what came of it.
struct PatternBuildContext {
    const Recipe& recipe;
    const FieldPtr& shell;
    const FieldPtr& body;
    const glm::dmat3& axes;  ///< that turn the space of the gradings into that of the body
    double depth;            ///< mm
    Gradings& gradings;
    const PatternWork& work;
    PatternReport& report;
};

/// A pattern of the skin: its keys, and how the shell is cut by it; null for a closed skin.
struct PatternBuilder {
    Kind kind;
    FieldPtr (*cut)(PatternBuildContext& making);
};
std::span<const PatternBuilder> pattern_builders();

}  // namespace lamella
