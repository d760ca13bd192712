// WindowPattern: where a skin has struts and where windows, and the skin that is cut so.
#pragma once

#include <cstdint>

#include "engine/field/field.h"

namespace lamella {

/// A pattern of windows: a field that is solid where a skin keeps its struts and void where it has windows,
/// through its whole thickness. Its value never exceeds the distance to where struts begin or end.
class WindowPattern : public Field {
  public:
    double value(dvec3 p) const final {
        std::uint32_t hint = 0;
        return value_near(p, hint);
    }
    /// The value; `hint` is what the pattern notes for itself between calls for neighbouring points, 0 at
    /// first. It changes the time, never the value.
    virtual double value_near(dvec3 p, std::uint32_t& hint) const = 0;
    Interval range(const Box& box) const override;
    Metric metric() const override { return Metric::bound; }
    Box bounds() const override { return {dvec3(-infinity), dvec3(infinity)}; }
};

/// The shell without the pattern's windows. Its runs are the shell's, cut where the pattern's value changes
/// sign: samples lie at quarter pitches, and those are left out that a value proves to be like it.
FieldPtr make_patterned_shell(FieldPtr shell, std::shared_ptr<const WindowPattern> pattern);

}  // namespace lamella
