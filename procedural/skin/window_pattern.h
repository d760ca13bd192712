// WindowPattern: struts and windows of a skin, as a field, and the skin cut by them.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// A pattern of windows: a field that is solid where a skin keeps its struts and void where it has windows,
/// through the skin's whole thickness. The magnitude of its value never exceeds the distance to the border of
/// the struts.
class WindowPattern : public Field {
  public:
    double value(dvec3 p) const final {
        std::uint32_t hint = 0;
        return value_near(p, hint);
    }
    /// Returns the value. `hint` is private to the pattern; pass 0 first, and keep it between calls for
    /// nearby points. It affects only the time, never the value.
    virtual double value_near(dvec3 p, std::uint32_t& hint) const = 0;
    /// A value, and a length of the line onward on which its sign stays, mm.
    struct Stretch {
        double value, same;
    };
    /// Returns the value at a point, and how far its sign stays at least on the line along an axis (0 to 2),
    /// towards greater coordinates if `ascending`. `hint` as in value_near().
    virtual Stretch stretch_near(dvec3 p, int /*axis*/, bool /*ascending*/, std::uint32_t& hint) const {
        const double v = value_near(p, hint);
        return {v, std::abs(v)};
    }
    /// Appends the parts of a line that lie in windows, ascending, and returns true; false where the pattern
    /// has no closed form for them. The line runs through p along an axis (0 to 2), and `part` bounds its
    /// coordinate, mm. `hint` as in value_near().
    virtual bool windows_on(dvec3 /*p*/, int /*axis*/, Interval /*part*/, std::uint32_t& /*hint*/,
                            std::vector<Interval>& /*out*/) const {
        return false;
    }
    Interval range(const Box& box) const override;
    Metric metric() const override { return Metric::bound; }
    Box bounds() const override { return {dvec3(-infinity), dvec3(infinity)}; }
};

/// Returns the shell without the pattern's windows. Its runs are those of the shell, cut by the pattern's
/// windows along them, or else where the pattern's value changes sign. Samples are a quarter of a pixel apart
/// then; those whose sign follows from an earlier sample are skipped.
FieldPtr make_patterned_shell(FieldPtr shell, std::shared_ptr<const WindowPattern> pattern);

}  // namespace lamella
