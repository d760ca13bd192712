// Walks a scaffold's layers as a printer would, on pictures of them: what hangs, floats, or lies in the part.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "procedural/scaffold.h"
#include "procedural/scaffold_field.h"
#include "tests/engine/plane_runs.h"

namespace lamella {

/// A layer as pixels.
struct LayerPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;
    bool at(int x, int y) const {
        return x >= 0 && y >= 0 && x < width && y < height &&
               pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)] != 0;
    }
};

inline LayerPicture picture_of(const Field& field, double z, const RowBand& band) {
    LayerPicture picture{band.hi, band.count, {}};
    picture.pixels.assign(static_cast<std::size_t>(band.hi) * static_cast<std::size_t>(band.count), 0);
    const SpanRows rows = runs_at(field, z, band);
    for (int y = 0; y < band.count; ++y) {
        for (const Run& run : rows.line(static_cast<std::size_t>(y))) {
            for (int x = (run.begin + run_unit / 2 - 1) / run_unit; x * run_unit + run_unit / 2 < run.end;
                 ++x) {
                picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(band.hi) +
                               static_cast<std::size_t>(x)] = 1;
            }
        }
    }
    return picture;
}

struct ScaffoldFindings {
    std::size_t hanging = 0;      ///< pixels of support that the layer below and no bar carries
    std::size_t loose_bars = 0;   ///< bars of which an end has nothing under it
    std::size_t floating = 0;     ///< pieces that stand neither on the bed nor on the part
    std::size_t in_part = 0;      ///< pixels in the part, or nearer than the clearance, away from contacts
    std::size_t long_bars = 0;    ///< bars longer than allowed
    std::size_t not_reached = 0;  ///< held points without a connector's tip
    double volume = 0;            ///< of the supports, mm^3
    std::string where;            ///< of the first finding
};

class ScaffoldWalk {
  public:
    /// follow: how far a layer may stand out over the one below, mm.
    ScaffoldWalk(const Scaffold& scaffold, const Field& part, double follow, double pixel = 0.15)
        : scaffold_(scaffold),
          part_(part),
          field_(make_scaffold_field(scaffold)),
          follow_(follow),
          pixel_(pixel) {
        Box box = unite(part.bounds(), field_->bounds());
        box.lo.z = scaffold.shape.bed;
        box_ = grown(box, 1);
        band_ = band_over(box_, pixel);
        for (const SupportPoint& point : scaffold.points) contacts_.push_back(point.at);
        for (const Beam& beam : scaffold.connectors) {
            if (beam.ra == scaffold.shape.tip / 2) contacts_.push_back(beam.a);
            if (beam.rb == scaffold.shape.tip / 2) contacts_.push_back(beam.b);
        }
    }

    ScaffoldFindings run() {
        check_pieces();
        const ScaffoldShape& shape = scaffold_.shape;
        const int layers =
            static_cast<int>(std::ceil((field_->bounds().hi.z - shape.bed) / shape.layer_height));
        LayerPicture below_support, below_part;
        std::vector<std::uint32_t> below_labels;
        for (int i = 0; i < layers; ++i) {
            const double z = shape.bed + (i + 0.5) * shape.layer_height;
            LayerPicture support = picture_of(*field_, z, band_);
            const LayerPicture part = picture_of(part_, z, band_);
            check_room(support, part, z);
            for (std::size_t k = 0; k < support.pixels.size(); ++k) {
                if (part.pixels[k]) support.pixels[k] = 0;
            }
            if (i > 0) check_carried(support, below_support, below_part, z);
            below_labels = join(support, below_support, below_labels, below_part, part, i == 0);
            for (const std::uint8_t p : support.pixels)
                findings_.volume += p * pixel_ * pixel_ * shape.layer_height;
            below_support = std::move(support);
            below_part = part;
        }
        for (std::uint32_t n = 0; n < parents_.size(); ++n) {
            if (parents_[n] == n && !grounded_[n]) {
                ++findings_.floating;
                note("floating piece", places_[n]);
            }
        }
        return findings_;
    }

  private:
    dvec3 place(int x, int y, double z) const {
        return {box_.lo.x + (x + 0.5) * pixel_, box_.lo.y + (y + 0.5) * pixel_, z};
    }
    void note(const std::string& what, dvec3 p) {
        if (findings_.where.empty()) {
            findings_.where =
                what + " at " + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z);
        }
    }
    double from_contact(dvec3 p) const {
        double nearest = infinity;
        for (const dvec3& contact : contacts_) nearest = std::min(nearest, glm::distance(contact, p));
        return nearest;
    }
    /// Whether any pixel within `reach` mm of (x, y) is set.
    bool near(const LayerPicture& picture, int x, int y, double reach) const {
        const int r = static_cast<int>(std::ceil(reach / pixel_));
        for (int j = -r; j <= r; ++j) {
            for (int i = -r; i <= r; ++i) {
                if (std::sqrt(double(i * i + j * j)) * pixel_ <= reach + 0.71 * pixel_ &&
                    picture.at(x + i, y + j)) {
                    return true;
                }
            }
        }
        return false;
    }

    void check_pieces() {
        const ScaffoldShape& shape = scaffold_.shape;
        for (const ScaffoldBar& bar : scaffold_.bars) {
            if (glm::distance(bar.a, bar.b) > shape.bridge + 1e-9) ++findings_.long_bars;
            // What lies directly under an end: sampled right below the bar.
            for (const dvec3& end : {bar.a, bar.b}) {
                const dvec3 under = end - dvec3(0, 0, shape.bar_height + 0.25 * shape.layer_height);
                if (field_->value(under) >= 0 && part_.value(under) >= 0) {
                    ++findings_.loose_bars;
                    note("loose bar", end);
                }
            }
        }
        for (std::size_t k = 0; k < scaffold_.points.size(); ++k) {
            if (std::find(scaffold_.unheld.begin(), scaffold_.unheld.end(), k) != scaffold_.unheld.end()) {
                continue;
            }
            dvec3 tip = scaffold_.points[k].at;
            if (shape.gap > 0) tip.z -= shape.gap + shape.tip / 2;
            const bool reached =
                std::any_of(scaffold_.connectors.begin(), scaffold_.connectors.end(), [&](const Beam& beam) {
                    return glm::distance(beam.a, tip) < 1e-9 || glm::distance(beam.b, tip) < 1e-9;
                });
            if (!reached) {
                ++findings_.not_reached;
                note("point not reached", tip);
            }
        }
    }

    void check_room(const LayerPicture& support, const LayerPicture& part, double z) {
        constexpr double about_contact = 3.2;  // mm, where a connector has come as far away as it must
        constexpr double slack = 0.07;
        const double clearance = scaffold_.shape.clearance;
        for (int y = 0; y < support.height; ++y) {
            for (int x = 0; x < support.width; ++x) {
                if (!support.at(x, y)) continue;
                if (!near(part, x, y, clearance)) continue;
                const dvec3 p = place(x, y, z);
                if (part_.value(p) >= clearance - slack || from_contact(p) < about_contact) continue;
                ++findings_.in_part;
                note("too near to the part", p);
            }
        }
    }

    bool in_new_bar(dvec3 p) const {
        const ScaffoldShape& shape = scaffold_.shape;
        return std::any_of(scaffold_.bars.begin(), scaffold_.bars.end(), [&](const ScaffoldBar& bar) {
            const double above = p.z - (bar.a.z - shape.bar_height);
            if (above < 0 || above > shape.layer_height) return false;
            const dvec2 way = dvec2(bar.b) - dvec2(bar.a);
            const double length = std::sqrt(glm::dot(way, way));
            const dvec2 u = way / length, d = dvec2(p) - dvec2(bar.a);
            const double along = glm::dot(d, u), across = glm::dot(d, dvec2(-u.y, u.x));
            const double half = shape.bar_width / 2 + pixel_;
            return std::abs(across) <= half && along >= -half && along <= length + half;
        });
    }

    void check_carried(const LayerPicture& support, const LayerPicture& below_support,
                       const LayerPicture& below_part, double z) {
        for (int y = 0; y < support.height; ++y) {
            for (int x = 0; x < support.width; ++x) {
                if (!support.at(x, y) || below_support.at(x, y) || below_part.at(x, y)) continue;
                if (near(below_support, x, y, follow_) || near(below_part, x, y, follow_)) continue;
                const dvec3 p = place(x, y, z);
                if (in_new_bar(p)) continue;
                ++findings_.hanging;
                note("hanging support", p);
            }
        }
    }

    std::uint32_t find(std::uint32_t n) {
        while (parents_[n] != n) n = parents_[n] = parents_[parents_[n]];
        return n;
    }
    void unite_labels(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a == b) return;
        parents_[std::max(a, b)] = std::min(a, b);
        grounded_[std::min(a, b)] = grounded_[std::min(a, b)] || grounded_[std::max(a, b)];
    }
    /// Labels a layer's pixels by the piece that they belong to, and joins pieces with those below.
    std::vector<std::uint32_t> join(const LayerPicture& support, const LayerPicture& below,
                                    const std::vector<std::uint32_t>& below_labels,
                                    const LayerPicture& below_part, const LayerPicture& part, bool on_bed) {
        std::vector<std::uint32_t> labels(support.pixels.size(), UINT32_MAX);
        const auto index = [&](int x, int y) {
            return static_cast<std::size_t>(y) * static_cast<std::size_t>(support.width) +
                   static_cast<std::size_t>(x);
        };
        for (int y = 0; y < support.height; ++y) {
            for (int x = 0; x < support.width; ++x) {
                if (!support.at(x, y)) continue;
                std::uint32_t& label = labels[index(x, y)];
                for (const auto& [i, j] :
                     {std::pair(-1, 0), std::pair(0, -1), std::pair(-1, -1), std::pair(1, -1)}) {
                    if (!support.at(x + i, y + j)) continue;
                    const std::uint32_t other = labels[index(x + i, y + j)];
                    if (label == UINT32_MAX) {
                        label = find(other);
                    } else {
                        unite_labels(label, other);
                    }
                }
                for (const auto& [i, j] : {std::pair(0, 0), std::pair(1, 0), std::pair(-1, 0),
                                           std::pair(0, 1), std::pair(0, -1)}) {
                    if (!below.at(x + i, y + j)) continue;
                    const std::uint32_t other = below_labels[index(x + i, y + j)];
                    if (label == UINT32_MAX) {
                        label = find(other);
                    } else {
                        unite_labels(label, other);
                    }
                }
                if (label == UINT32_MAX) {
                    label = static_cast<std::uint32_t>(parents_.size());
                    parents_.push_back(label);
                    grounded_.push_back(false);
                    places_.push_back(place(x, y, 0));
                }
                const bool touches = near(part, x, y, 0) || near(below_part, x, y, pixel_);
                if (on_bed || touches) grounded_[find(label)] = true;
            }
        }
        return labels;
    }

    const Scaffold& scaffold_;
    const Field& part_;
    FieldPtr field_;
    double follow_, pixel_;
    Box box_;
    RowBand band_;
    std::vector<dvec3> contacts_;
    ScaffoldFindings findings_;
    std::vector<std::uint32_t> parents_;
    std::vector<bool> grounded_;
    std::vector<dvec3> places_;
};

}  // namespace lamella
