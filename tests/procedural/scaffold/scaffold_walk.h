// Walks a scaffold's layers as a printer would, on pictures of them: what hangs, floats, or lies in the part.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "procedural/scaffold/scaffold.h"
#include "procedural/scaffold/scaffold_field.h"
#include "tests/engine/surveys/overhang_scenes.h"
#include "tests/procedural/foam/layer_picture.h"

namespace lamella {

/// What is wrong with a scaffold, counted.
struct ScaffoldFindings {
    std::size_t hanging = 0;      ///< pixels of support that neither the layer below nor a bar carries
    std::size_t loose_bars = 0;   ///< ends of bars with nothing under them
    std::size_t floating = 0;     ///< pieces that stand neither on the bed nor on the part
    std::size_t in_part = 0;      ///< pixels in the part, or nearer than the clearance, away from contacts
    std::size_t long_bars = 0;    ///< bars longer than allowed
    std::size_t not_reached = 0;  ///< held points without a connector's tip
    double volume = 0;            ///< of the supports outside the part, mm^3
    std::string where;            ///< of the first finding
    std::size_t total() const { return hanging + loose_bars + floating + in_part + long_bars + not_reached; }
};

/// Pieces of a stack of layers, joined as pixels touch each other.
class StackPieces {
  public:
    static constexpr std::uint32_t none = UINT32_MAX;

    std::uint32_t add(dvec3 place) {
        const auto piece = static_cast<std::uint32_t>(parents_.size());
        parents_.push_back(piece);
        grounded_.push_back(false);
        places_.push_back(place);
        return piece;
    }
    std::uint32_t find(std::uint32_t n) {
        while (parents_[n] != n) n = parents_[n] = parents_[parents_[n]];
        return n;
    }
    /// The piece that both have become; one of them may be none yet.
    std::uint32_t join(std::uint32_t a, std::uint32_t b) {
        if (a == none) return find(b);
        a = find(a);
        b = find(b);
        const std::uint32_t first = std::min(a, b), second = std::max(a, b);
        if (first != second) grounded_[first] = grounded_[first] || grounded_[second];
        return parents_[second] = first;
    }
    void ground(std::uint32_t n) { grounded_[find(n)] = true; }
    /// Where pieces that are not grounded begin.
    std::vector<dvec3> floating() {
        std::vector<dvec3> places;
        for (std::uint32_t n = 0; n < parents_.size(); ++n) {
            if (parents_[n] == n && !grounded_[n]) places.push_back(places_[n]);
        }
        return places;
    }

  private:
    std::vector<std::uint32_t> parents_;
    std::vector<bool> grounded_;
    std::vector<dvec3> places_;
};

/// Allows for: what stands out over the layer below by at most `follow`; the first layer of
/// a bar between its ends; less room than the clearance about contacts, as far as a connector that leaves the
/// part at 24 degrees or more needs (of a pillar's cone: 35), from 0.5 mm on where a tip begins within the
/// part; 0.07 mm where the clearance is asked.
class ScaffoldWalk {
  public:
    /// part_layers are those of the grid, which must enclose part and scaffold. follow in mm.
    ScaffoldWalk(const Scaffold& scaffold, const Field& part, const LayerGrid& grid,
                 const std::vector<LayerPicture>& part_layers, double follow)
        : scaffold_(scaffold),
          part_(part),
          field_(make_scaffold_field(scaffold)),
          grid_(grid),
          part_layers_(part_layers),
          follow_(follow) {
        find_contacts();
    }

    ScaffoldFindings run() {
        check_bars();
        check_points();
        LayerPicture below;
        std::vector<std::uint32_t> below_labels;
        for (int i = 0; i < grid_.layers; ++i) {
            LayerPicture support = picture_of(*field_, grid_.plane(i), grid_.band);
            check_room(support, i);
            const LayerPicture& part = part_layers_[static_cast<std::size_t>(i)];
            part.visit([&](int x, int y) { support.set(x, y, false); });
            if (i > 0) check_carried(support, below, i);
            below_labels = label(support, below, below_labels, i);
            findings_.volume +=
                static_cast<double>(support.count()) * grid_.pixel * grid_.pixel * grid_.layer_height;
            below = std::move(support);
        }
        for (const dvec3& place : pieces_.floating()) {
            ++findings_.floating;
            note("floating piece", place);
        }
        return findings_;
    }

  private:
    /// Where a connector meets the part. Away from it the room is to grow by `slope` for each mm.
    struct Contact {
        dvec3 at;
        double radius, slope;
        double sunk;  ///< within the part, as far as a tip may begin there
    };

    void note(const std::string& what, dvec3 p) {
        if (findings_.where.empty()) {
            findings_.where =
                what + " at " + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z);
        }
    }
    bool held(std::size_t point) const {
        const auto& unheld = scaffold_.unheld;
        return std::find(unheld.begin(), unheld.end(), point) == unheld.end();
    }
    dvec3 tip_of(std::size_t point) const {
        const ScaffoldShape& shape = scaffold_.shape;
        const double lower = shape.gap > 0 ? shape.gap + shape.tip / 2 : 0;
        return scaffold_.points[point].at - dvec3(0, 0, lower);
    }

    void find_contacts() {
        constexpr double at_part = 0.1;
        constexpr double deepest = 0.5;
        const double thick = scaffold_.shape.bar_width / 2;
        const auto add = [&](dvec3 end, const Beam& beam) {
            const double room = part_.value(end);
            if (std::abs(room) > at_part + scaffold_.shape.gap + scaffold_.shape.tip / 2) return;
            const double widest = std::max(beam.ra, beam.rb), sunk = room < -0.03 ? deepest : 0;
            contacts_.push_back(widest > thick + 1e-9 ? Contact{end, widest, 0.7, sunk}
                                                      : Contact{end, thick, 0.4, sunk});
        };
        for (const Beam& beam : scaffold_.connectors) {
            add(beam.a, beam);
            add(beam.b, beam);
        }
    }

    void check_bars() {
        const ScaffoldShape& shape = scaffold_.shape;
        for (const ScaffoldBar& bar : scaffold_.bars) {
            if (glm::distance(bar.a, bar.b) > shape.bridge + 1e-9) {
                ++findings_.long_bars;
                note("long bar", bar.a);
            }
            for (const dvec3& end : {bar.a, bar.b}) {
                const dvec3 under = end - dvec3(0, 0, shape.bar_height + 0.25 * shape.layer_height);
                if (field_->value(under) >= 0 && part_.value(under) >= 0) {
                    ++findings_.loose_bars;
                    note("loose bar", end);
                }
            }
        }
    }

    void check_points() {
        for (std::size_t k = 0; k < scaffold_.points.size(); ++k) {
            if (!held(k)) continue;
            const dvec3 tip = tip_of(k);
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

    /// How far from the part a piece of support must be at p.
    double room_needed(dvec3 p) const {
        constexpr double slack = 0.07, sure = 0.1;
        double needed = scaffold_.shape.clearance;
        for (const Contact& contact : contacts_) {
            // The nearest place of its axis is as much nearer to the contact as the connector is thick.
            const double along = glm::distance(contact.at, p) - contact.radius - contact.sunk - sure;
            needed = std::min(needed, contact.slope * along - contact.radius);
        }
        return needed - slack;
    }

    void check_room(const LayerPicture& support, int layer) {
        const double clearance = scaffold_.shape.clearance;
        support.visit([&](int x, int y) {
            const dvec3 p = grid_.place(x, y, grid_.plane(layer));
            const double room = part_.value_within(p, clearance);
            if (room >= clearance || room >= room_needed(p)) return;
            ++findings_.in_part;
            note("too near to the part", p);
        });
    }

    /// In a layer's lowest bead of a bar, which is laid from end to end.
    bool in_new_bar(dvec3 p) const {
        const ScaffoldShape& shape = scaffold_.shape;
        return std::any_of(scaffold_.bars.begin(), scaffold_.bars.end(), [&](const ScaffoldBar& bar) {
            const double above = p.z - (bar.a.z - shape.bar_height);
            if (above < 0 || above > shape.layer_height) return false;
            const dvec2 way = dvec2(bar.b) - dvec2(bar.a);
            const double length = std::sqrt(glm::dot(way, way));
            const dvec2 u = way / length, d = dvec2(p) - dvec2(bar.a);
            const double along = glm::dot(d, u), across = glm::dot(d, dvec2(-u.y, u.x));
            const double half = shape.bar_width / 2 + grid_.pixel;
            return std::abs(across) <= half && along >= -half && along <= length + half;
        });
    }

    void check_carried(const LayerPicture& support, const LayerPicture& below, int layer) {
        const LayerPicture& part_below = part_layers_[static_cast<std::size_t>(layer - 1)];
        support.visit([&](int x, int y) {
            if (grid_.near(below, x, y, follow_) || grid_.near(part_below, x, y, follow_)) return;
            const dvec3 p = grid_.place(x, y, grid_.plane(layer));
            if (in_new_bar(p)) return;
            // What is thinner than pixels can show is asked of the field, whose values outside are distances.
            const double below_z = grid_.plane(layer - 1);
            if (field_->value({p.x, p.y, below_z}) <= follow_ &&
                overhangs::disc_meets(*field_, dvec2(p), below_z, follow_)) {
                return;
            }
            ++findings_.hanging;
            note("hanging support", p);
        });
    }

    /// Labels a layer's pixels by the piece that they belong to, and joins pieces with those below.
    std::vector<std::uint32_t> label(const LayerPicture& support, const LayerPicture& below,
                                     const std::vector<std::uint32_t>& below_labels, int layer) {
        constexpr PixelPlace before[] = {{-1, 0}, {0, -1}, {-1, -1}, {1, -1}};
        constexpr PixelPlace under[] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
        const LayerPicture& part = part_layers_[static_cast<std::size_t>(layer)];
        std::vector<std::uint32_t> labels(
            static_cast<std::size_t>(support.width()) * static_cast<std::size_t>(support.height()),
            StackPieces::none);
        support.visit([&](int x, int y) {
            std::uint32_t& label = labels[support.number(x, y)];
            for (const auto& [i, j] : before) {
                if (support.at(x + i, y + j)) {
                    label = pieces_.join(label, labels[support.number(x + i, y + j)]);
                }
            }
            for (const auto& [i, j] : under) {
                if (below.at(x + i, y + j)) {
                    label = pieces_.join(label, below_labels[below.number(x + i, y + j)]);
                }
            }
            if (label == StackPieces::none) label = pieces_.add(grid_.place(x, y, grid_.plane(layer)));
            const bool on_part =
                layer > 0 && grid_.near(part_layers_[static_cast<std::size_t>(layer - 1)], x, y, grid_.pixel);
            if (layer == 0 || on_part || grid_.near(part, x, y, 0)) pieces_.ground(label);
        });
        return labels;
    }

    const Scaffold& scaffold_;
    const Field& part_;
    FieldPtr field_;
    const LayerGrid& grid_;
    const std::vector<LayerPicture>& part_layers_;
    double follow_;
    std::vector<Contact> contacts_;
    ScaffoldFindings findings_;
    StackPieces pieces_;
};

/// A grid about a part and its scaffold.
inline LayerGrid grid_about(const Field& part, const Scaffold& scaffold, double pixel) {
    const Box box = unite(part.bounds(), make_scaffold_field(scaffold)->bounds());
    return {grown(box, 5 * pixel), scaffold.shape.bed, scaffold.shape.layer_height, pixel};
}

/// The walk with all that it needs.
inline ScaffoldFindings walk_scaffold(const Scaffold& scaffold, const Field& part, double follow = 0.225,
                                      double pixel = 0.15) {
    const LayerGrid grid = grid_about(part, scaffold, pixel);
    return ScaffoldWalk(scaffold, part, grid, pictures_of(part, grid), follow).run();
}

}  // namespace lamella
