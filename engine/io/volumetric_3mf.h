// Resources of 3MF's volumetric and implicit extensions (1.0), read from their XML and checked.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/graph_lowering.h"
#include "engine/io/model_3mf.h"

namespace lamella {

/// An output of a function, evaluated in an object's coordinates.
struct FunctionUse {
    std::int64_t function = 0;
    std::string channel;
    Transform3mf transform;  ///< from the object's coordinates to the function's
    double fallback = 0;     ///< value where the function is undefined
};

/// A <property> of a <volumedata>.
struct VolumeProperty {
    std::string name;  ///< as written in the file, perhaps with a prefix
    FunctionUse use;
};

/// A <levelset>: the object is the region where the function is negative, within a mesh or its bounding box.
/// The minimum feature size is a hint and is not read.
struct LevelSet {
    FunctionUse use;
    std::int64_t mesh = 0;  ///< object
    bool box_only = false;
};

/// An <image3d>, sheets from the lowest up.
struct ImageStack {
    std::int64_t rows = 0, columns = 0;
    std::vector<std::string> sheets;  ///< parts of the package
};

/// The functions, images and volumedata of one model part, by number.
struct VolumetricPart {
    std::map<std::int64_t, CheckedFunction> functions;
    std::map<std::int64_t, ImageStack> images;
    std::map<std::int64_t, std::vector<VolumeProperty>> volumes;
};

/// Limits on the function nodes, and on the sheets, read from one part.
inline constexpr std::size_t max_graph_nodes = 200'000;
inline constexpr std::size_t max_sheets = 1'000'000;

/// Reads the resources of a model part. Throws InputError that names the file and the place for content that
/// the extensions do not allow, or that is not supported. A faulty function is read with its `fault`.
VolumetricPart read_volumetric_part(const Model3mf& model, const ModelPart& part);

/// Return an object's level set, and the number of its volumedata; nothing when it has none.
std::optional<LevelSet> read_level_set(const Model3mf& model, const PlacedObject& object);
std::optional<std::int64_t> volume_of(const Model3mf& model, const PlacedObject& object);

}  // namespace lamella
