// Labels by the firmware's dialect, and the nearest part of a point.
#include "printers/gcode/object_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/number_format.h"

namespace lamella {

namespace {

/// Returns a name of letters, digits and underscores, as Klipper wants it.
std::string plain_name(const std::string& name) {
    constexpr std::size_t most = 48;
    std::string plain;
    const bool is_long = name.size() > most;
    for (const char c : is_long ? name.substr(name.size() - most) : name) {
        const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        plain += is_plain ? c : '_';
    }
    return plain;
}

std::string point_text(dvec2 p) { return format_number(p.x, 3) + "," + format_number(p.y, 3); }

}  // namespace

ObjectLabels::ObjectLabels(const Job& job, Flavour flavour, dvec2 shift) : flavour_(flavour), shift_(shift) {
    labels_.reserve(job.objects.size());
    for (const JobObject& object : job.objects) labels_.push_back({object, plain_name(object.name)});
}

std::string ObjectLabels::definitions() const {
    if (labels_.empty()) return "";
    if (flavour_ != Flavour::klipper) return fmt::format("M486 T{}\n", labels_.size());
    std::string text;
    for (const Label& label : labels_) {
        const Rect rect{label.object.covers.lo + shift_, label.object.covers.hi + shift_};
        std::string outline;
        for (const dvec2 corner :
             {rect.lo, dvec2(rect.hi.x, rect.lo.y), rect.hi, dvec2(rect.lo.x, rect.hi.y)})
            outline += fmt::format("{}[{}]", outline.empty() ? "" : ",", point_text(corner));
        text += fmt::format("EXCLUDE_OBJECT_DEFINE NAME={} CENTER={} POLYGON=[{}]\n", label.name,
                            point_text(rect.center()), outline);
    }
    return text;
}

int ObjectLabels::object_at(dvec3 p) const {
    // Beads on an outline lie on its border, and feet of supports may stand out.
    constexpr double beside = 1;  // mm
    int nearest = -1;
    double least = infinity;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
        const JobObject& object = labels_[i].object;
        const Rect rect = grown(object.covers, beside);
        if (p.x < rect.lo.x || p.y < rect.lo.y || p.x > rect.hi.x || p.y > rect.hi.y) continue;
        double value = object.part->value(p);
        if (object.supports) value = std::min(value, object.supports->value(p));
        if (value >= least) continue;
        least = value;
        nearest = static_cast<int>(i);
    }
    return nearest;
}

std::string ObjectLabels::change(int from, int to) const {
    if (from == to) return "";
    const auto name = [&](int object) { return labels_[static_cast<std::size_t>(object)].name; };
    if (flavour_ == Flavour::klipper) {
        std::string text;
        if (from >= 0) text += fmt::format("EXCLUDE_OBJECT_END NAME={}\n", name(from));
        if (to >= 0) text += fmt::format("EXCLUDE_OBJECT_START NAME={}\n", name(to));
        return text;
    }
    if (flavour_ == Flavour::reprapfirmware && to >= 0)
        return fmt::format("M486 S{} A\"{}\"\n", to, name(to));
    return fmt::format("M486 S{}\n", to);
}

}  // namespace lamella
