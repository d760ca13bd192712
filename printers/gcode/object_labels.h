// ObjectLabels: says which part of a plate lines belong to, so that a failed one can be cancelled.
#pragma once

#include <string>

#include "engine/layers/layer.h"
#include "printers/common/gcode_profile.h"

namespace lamella {

/// The labels of a job's parts: M486 for Marlin and RepRapFirmware, EXCLUDE_OBJECT for Klipper. Without parts
/// there are none.
class ObjectLabels {
  public:
    ObjectLabels() = default;
    /// `shift` moves points of the job to the bed, mm.
    ObjectLabels(const Job& job, Flavour flavour, dvec2 shift);

    /// Returns the lines that announce all parts.
    std::string definitions() const;
    /// Returns the part that a point of the job belongs to; -1 for none.
    int object_at(dvec3 p) const;
    /// Returns the lines between those of one part and those of another; -1 stands for none.
    std::string change(int from, int to) const;

  private:
    struct Label {
        JobObject object;
        std::string name;
    };
    std::vector<Label> labels_;
    Flavour flavour_ = Flavour::marlin;
    dvec2 shift_{0};
};

}  // namespace lamella
