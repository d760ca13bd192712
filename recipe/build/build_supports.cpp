// What is surveyed and kept clear of is the outer surface where there is one.
#include "recipe/build/build_supports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "printers/registry.h"
#include "procedural/scaffold/scaffold_field.h"
#include "procedural/scaffold/scaffold_synthesis.h"
#include "recipe/build/build_process.h"
#include "recipe/build/repair_job.h"
#include "recipe/identity.h"
#include "recipe/layering/plan_layers.h"

namespace lamella {

namespace {

constexpr double bead = 0.45;          // mm, of machines that have none of their own
constexpr double self_supporting = 1;  // mm below a body's surface from which its foam is left to itself

/// What lies more than a distance below a body's surface; for its sign alone.
class Depths : public Field {
  public:
    Depths(FieldPtr body, double depth) : body_(std::move(body)), depth_(depth) {}
    double value(dvec3 p) const override {
        if (body_->metric() != Metric::sign) return body_->value(p) + depth_;
        // Values say nothing of depths: what is deep has the body all about it.
        double least = body_->value(p);
        for (int k = 0; k < 27; ++k) {
            const dvec3 way(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            if (way == dvec3(0)) continue;
            least = std::max(least, body_->value(p + way * (depth_ / glm::length(way))));
        }
        return least;
    }
    Metric metric() const override { return Metric::sign; }
    Box bounds() const override { return body_->bounds(); }

  private:
    FieldPtr body_;
    double depth_;
};

/// Whether the part ends at its body's surface with solid material everywhere.
bool has_closed_surface(const Recipe& recipe, const BuiltJob& built) {
    if (has_cut_skin(recipe)) return false;
    for (const BuiltRegion& region : built.regions.list) {
        if (region.make == RegionMake::empty || region.make == RegionMake::skin) return false;
    }
    if (!recipe.skin) return false;
    const GradedNumber& thickness = recipe.skin->thickness;
    return thickness.is_formula() ? recipe.skin->thickness_min > 0 : thickness.number() > 0;
}

/// Everything about the machine that supports depend on.
struct Printing {
    bool filament = false;
    double width = bead;     ///< of a line, mm
    double overhang = 0;     ///< by which a layer may stand out, mm
    int layers_at_once = 1;  ///< that the survey takes together, where layers are thin
};

Printing printing(const Recipe& recipe, double layer_height) {
    Printing p;
    p.filament = makes_beads(recipe.printer);
    if (p.filament) p.width = recipe.printer.filament.line_width;
    p.overhang = printable_overhang(recipe.printer, layer_height);
    // Outlines are known to a part of the width; a step that is small against that says nothing.
    if (!p.filament) p.layers_at_once = std::max(1, static_cast<int>(std::lround(p.width / 2 / p.overhang)));
    return p;
}

std::string plan_hash(const Recipe& recipe, const Job& job) {
    const Printing p = printing(recipe, job.layers.least_height());
    Fnv128 hash;
    hash.add(job.identity);
    hash.add(fmt::format("supports 1 {} {} {}", p.filament, p.width, p.overhang));
    return hash.hex();
}

/// The [[region]]s of one make as one solid, scaled like the part; null when there are none.
FieldPtr regions_of(const Recipe& recipe, const BuiltJob& built, RegionMake make) {
    std::vector<FieldPtr> solids;
    for (const BuiltRegion& region : built.regions.list) {
        if (region.make == make) solids.push_back(region.field);
    }
    return solids.empty() ? nullptr : make_scaled(recipe, built.designed, make_union(std::move(solids)));
}

ScaffoldShape shape_of(const Recipe& recipe, const Job& job) {
    const SupportProfile& s = recipe.printer.support;
    const double height = job.layers.least_height();
    const Printing p = printing(recipe, height);
    ScaffoldShape shape;
    shape.bed = job.z0();
    shape.layer_height = height;
    shape.bridges = recipe.support == SupportKind::bridges;
    shape.bridge = s.bridge;
    shape.reach = s.reach;
    shape.lean = std::min(1.0, p.overhang / (p.filament ? job.layers.greatest_height() : height));
    shape.connector = s.connector;
    shape.longest_connector = s.longest_connector;
    shape.clearance = s.clearance;
    shape.gap = s.gap;
    shape.tip = s.tip;
    shape.pillar = s.pillar;
    shape.round_pillars = s.round_pillars;
    shape.wall = s.wall > 0 ? s.wall : p.width;
    shape.bar_width = s.bar_width;
    shape.bar_height = s.bar_height;
    shape.foot = s.foot;
    shape.foot_height = s.foot_height;
    return shape;
}

/// A survey that takes several layers together finds points too low or too high by some of them.
void settle(std::vector<SupportPoint>& points, const Job& job, int layers_at_once) {
    if (layers_at_once == 1) return;
    const double h = job.layers.least_height();
    for (SupportPoint& point : points) {
        const auto solid_above = [&] { return job.part->value(point.at + dvec3(0, 0, h / 2)) < 0; };
        const auto solid_below = [&] { return job.part->value(point.at - dvec3(0, 0, h / 2)) < 0; };
        for (int k = 0; k < layers_at_once && !solid_above(); ++k) point.at.z += h;
        for (int k = 0; k < layers_at_once && solid_below() && point.at.z - h > job.z0(); ++k) {
            point.at.z -= h;
        }
    }
}

SupportPlan make_plan(const Recipe& recipe, const BuiltJob& built, const Job& surveyed, FieldPtr blocked,
                      const SupportOptions& options) {
    const SupportProfile& s = recipe.printer.support;
    const Printing p = printing(recipe, surveyed.layers.least_height());
    OverhangSurveyOptions survey;
    survey.limits = {p.overhang * p.layers_at_once, p.width, s.spacing, s.free_stretch, s.own_bridge};
    survey.stability = StabilityLimits{};
    survey.stability->margin = s.margin;
    survey.stability->push = s.push;
    survey.stability->adhesion = s.adhesion;
    survey.stability->bond = s.bond;
    survey.stability->density = s.density;
    survey.stability->contact = 3.14159265358979323846 / 4 * s.tip * s.tip;
    survey.on_bed = s.lift == 0;
    survey.blocked = std::move(blocked);
    survey.enforced = regions_of(recipe, built, RegionMake::enforcer);
    survey.threads = options.threads;
    survey.on_progress = options.on_progress;
    survey.cancel = options.cancel;
    const ScaffoldShape shape = shape_of(recipe, surveyed);
    // Beads stand out by as much over a thin layer as over a thick one; resin's limit is a slope.
    Job coarse = surveyed;
    if (!p.filament) {
        const double height = surveyed.layers.least_height() * p.layers_at_once;
        coarse.layers = equal_layers(coarse.bounds.size().z, height);
    }
    SupportPlan plan;
    plan.survey = survey_overhangs(coarse, survey);
    settle(plan.survey.points, surveyed, p.layers_at_once);
    plan.scaffold =
        build_scaffold(plan.survey.points, *surveyed.part, shape, {options.threads, {}, options.cancel});
    return plan;
}

/// The bed comes to lie lower, by whole layers, so that the part is cut where it was.
void lift(Job& job, const LayerPlan& below) {
    job.bounds.lo.z -= below.total();
    job.layers = job.layers.raised(below);
}

}  // namespace

std::optional<BuiltSupports> add_supports(const Recipe& recipe, BuiltJob& built,
                                          const SupportOptions& options) {
    if (recipe.support == SupportKind::none) return std::nullopt;
    const bool closed = has_closed_surface(recipe, built), plain = !recipe.foam && !recipe.skin;
    // Cavities have roofs that need no supports.
    const FieldPtr whole = built.before_cavities ? built.before_cavities : built.designed.part;
    const FieldPtr outer = closed ? built.outside : whole;
    FieldPtr blocked = regions_of(recipe, built, RegionMake::blocker);
    if (!closed && !plain) {
        const FieldPtr deep =
            std::make_shared<Depths>(make_scaled(recipe, built.designed, built.body), self_supporting);
        blocked = blocked ? make_union({blocked, deep}) : deep;
    }
    Job& job = built.job;
    lift(job, lift_layers(recipe));
    Job surveyed = job;
    surveyed.part = without_tips(make_scaled(recipe, built.designed, outer), built);

    BuiltSupports supports;
    const std::string hash = plan_hash(recipe, job);
    if (auto known = read_plan(options.plans, hash)) {
        supports.plan = std::move(*known);
        supports.plan.scaffold.shape = in_whole_layers(shape_of(recipe, surveyed));
        supports.was_planned = true;
    } else {
        supports.plan = make_plan(recipe, built, surveyed, std::move(blocked), options);
        keep_plan(options.plans, hash, supports.plan);
    }
    const FieldPtr scaffold = make_scaffold_field(supports.plan.scaffold);
    if (scaffold->bounds().empty()) return supports;
    Job printed = built.designed;
    printed.part = outer;
    const FieldPtr under_bed = make_half_space({0, 0, 1}, job.z0());
    const auto beside = [&](const FieldPtr& part) {
        return make_difference(scaffold, make_union({part, under_bed}));
    };
    job.supports = beside(without_tips(make_processed(recipe, printed, built.layers.plan).part, built));
    supports.before_offsets = beside(surveyed.part);
    const Box box = unite(job.bounds, scaffold->bounds());
    job.bounds = {{box.lo.x, box.lo.y, job.bounds.lo.z}, {box.hi.x, box.hi.y, job.bounds.hi.z}};
    return supports;
}

double support_volume(const Job& job) {
    constexpr double pitch = 0.2;
    if (!job.supports) return 0;
    const Box box = job.supports->bounds();
    RowBand band;
    band.along_origin = box.lo.x;
    band.across_origin = box.lo.y;
    band.along_pitch = band.across_pitch = pitch;
    band.count = static_cast<int>(box.size().y / pitch) + 1;
    band.hi = static_cast<int>(box.size().x / pitch) + 1;
    double volume = 0;
    for (int i = 0; i < job.layers.count() && job.plane(i) <= box.hi.z; ++i) {
        SliceContext context;
        Scratch scratch;
        const auto rows = scratch.rows();
        context.slice(*job.supports, job.plane(i)).runs(band, scratch, *rows);
        volume += static_cast<double>(rows->total_length()) / run_unit * pitch * pitch * job.layers.height(i);
    }
    return volume;
}

std::string supports_text(const BuiltSupports& supports) {
    const OverhangSurvey& survey = supports.plan.survey;
    const Scaffold& scaffold = supports.plan.scaffold;
    const auto count = [](std::size_t n, const char* what) {
        return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
    };
    std::string text =
        scaffold.points.empty()
            ? std::string("nothing needs support")
            : fmt::format("{} on {} and {}", count(scaffold.points.size(), "point"),
                          count(scaffold.bars.size(), "bridge"), count(scaffold.pillars.size(), "pillar"));
    if (supports.was_planned) text += ", as planned before";
    text += "\n";
    if (!scaffold.unheld.empty()) {
        const dvec3 p = scaffold.points[scaffold.unheld.front()].at;
        text += fmt::format(
            "{} cannot be reached without touching the part, the lowest at ({:.2f}, {:.2f}, "
            "{:.2f}) mm\n",
            count(scaffold.unheld.size(), "point"), p.x, p.y, p.z);
    }
    if (survey.topples_at) {
        text +=
            fmt::format("the print may topple from {:.1f} mm over the bed on, and no further point helps\n",
                        *survey.topples_at);
    }
    if (survey.blocked > 0) {
        text += fmt::format("{} left out: in a blocker, or in foam more than {} mm below the surface\n",
                            count(survey.blocked, "point"), self_supporting);
    }
    return text;
}

}  // namespace lamella
