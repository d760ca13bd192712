// VolumetricModel: solids and numbers that a 3MF file describes without triangles: level sets, beam lattices,
// volume properties and functions.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/field/field.h"
#include "engine/field/grading.h"
#include "engine/formula/formula.h"

namespace lamella {

/// A formula of a point (inputs 0 to 2: x, y, z, mm) and of gradings there (others[i] is input 3 + i).
struct PlacedFormula {
    Formula formula;
    std::vector<GradingPtr> others;
};

/// A 3MF file with the volumetric and implicit extensions (1.0) and the beam lattice extension (1.2). Level
/// sets, properties and functions become formulas; the meshes and images that these need become gradings.
/// Lengths are in mm and points in coordinates of the build platform: the model's unit, items and components
/// are applied. Colours, material mixtures and minimum feature sizes are not read. An object may be named by
/// its id. Every mistake in the file is an InputError that begins with the file's name. Not thread-safe; the
/// fields and gradings that it makes are.
class VolumetricModel {
  public:
    /// Reads the file, and checks all functions of its root part and of the objects in its build section. A
    /// function with a mistake is refused when it is used.
    explicit VolumetricModel(const std::string& path);
    /// Reads a file in memory.
    VolumetricModel(const std::string& name, std::string bytes);
    ~VolumetricModel();
    VolumetricModel(VolumetricModel&&) noexcept;

    /// Returns the union of all that the build section places: level sets, beam lattices and meshes. For
    /// level sets only signs are meaningful.
    FieldPtr built();
    /// Returns one object at all places where the build section puts it; if there is none, in its own
    /// coordinates.
    FieldPtr object(std::string_view which);
    /// Returns a function of the root part by name. Append ".output" unless it has a single scalar output,
    /// and ".x", ".y" or ".z" for a vector. The function is evaluated at its input pos, in its own
    /// coordinates, scaled by the model's unit; its result is not scaled.
    PlacedFormula function(std::string_view which);
    /// Returns a property as a grading in coordinates of the build platform. `name` may omit the prefix;
    /// append ".x", ".y" or ".z" for a vector. `object` may be empty if only one object has such a property.
    /// Throws InputError if the object is placed several times.
    GradingPtr property(std::string_view name, std::string_view object);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace lamella
