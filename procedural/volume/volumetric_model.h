// Solids and numbers that a 3MF file describes by functions: level sets, properties of volumes, functions.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/field/field.h"
#include "engine/field/grading.h"
#include "engine/formula/formula.h"

namespace lamella {

/// A formula over a place (inputs 0 to 2: x, y, z, mm) and gradings there (others[i] feeds input 3 + i).
struct PlacedFormula {
    Formula formula;
    std::vector<GradingPtr> others;
};

/// A 3MF file with the volumetric and implicit extensions (1.0). Level sets, properties and functions become
/// formulas; meshes and images that these ask for become gradings. Lengths are mm and places those of the
/// build platform: the model's unit, items and components are applied. Colours, mixtures of materials and
/// least sizes of features are not read. Names of things may be their numbers. Every mistake in the file is
/// an InputError that begins with its name. Not thread-safe; what it makes is.
class VolumetricModel {
  public:
    /// Reads the file and checks all functions of its root part and of what it builds.
    explicit VolumetricModel(const std::string& path);
    /// The same for a file in memory.
    VolumetricModel(const std::string& name, std::string bytes);
    ~VolumetricModel();
    VolumetricModel(VolumetricModel&&) noexcept;

    /// All that the build section places, level sets and meshes, united. Level sets know signs alone.
    FieldPtr built();
    /// One object, wherever the build section places it; where it does not, in its own coordinates.
    FieldPtr object(std::string_view which);
    /// A function of the root part by name, with ".output" unless it has one scalar, and ".x", ".y" or
    /// ".z" behind the name of a vector. It is asked at its input pos, in the function's own coordinates,
    /// scaled by the model's unit; its number is as it is.
    PlacedFormula function(std::string_view which);
    /// A property's number in the coordinates of the build platform, by its name with or without a prefix,
    /// with ".x", ".y" or ".z" where it is a vector. The object may be left out where one alone has such a
    /// property; InputError where it is placed several times.
    GradingPtr property(std::string_view name, std::string_view object);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace lamella
