// Makes each region's field once, turns its values into distances where needed, and combines it with the
// part.
#include "recipe/build/build_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/base/error.h"
#include "engine/field/solid_search.h"
#include "engine/solids/csg.h"
#include "procedural/grading/field_slope.h"
#include "recipe/build/build_fields.h"
#include "recipe/recipe_regions.h"
#include "recipe/result_dependents.h"

namespace lamella {

namespace {

/// Formulas without bounds are cut off this far outside the part, mm: too far to affect any blend.
constexpr double beyond_part = 1e6;

/// The fields of regions, each made on first use.
class RegionFields {
  public:
    RegionFields(Gradings& gradings, const Box& part, const glm::dmat3& axes, std::vector<std::string>& notes)
        : gradings_(gradings), part_(part), axes_(axes), notes_(notes) {}

    /// Returns the region's field; if the region blends, one whose values are distances.
    FieldPtr make(const RegionRecipe& region) {
        const auto field = std::find_if(gradings_.recipe().fields.begin(), gradings_.recipe().fields.end(),
                                        [&](const FieldRecipe& f) { return f.name == region.field; });
        if (field == gradings_.recipe().fields.end()) {
            throw InputError(region.where + ".field: no [[field]] is named \"" + region.field + "\"");
        }
        try {
            FieldPtr& made = made_[region.field];
            if (!made) made = make(*field);
            if (region.blend == 0 || made->metric() != Metric::sign) return made;
            FieldPtr& even = even_[region.field];
            if (!even) even = make_unit_slope(made, part_);
            return even;
        } catch (const LocatedError&) {
            throw;
        } catch (const InputError& error) {
            throw LocatedError(fmt::format("{}.field `{}`: {}", region.where, region.field, error.what()));
        }
    }

  private:
    FieldPtr make(const FieldRecipe& field) {
        std::optional<MeshReport> mesh;
        FieldPtr made = build_field(field, gradings_, grown(part_, beyond_part), mesh, axes_);
        if (!mesh) return made;
        for (const std::string& note : mesh->notes) notes_.push_back(mesh->path + ": " + note);
        return made;
    }

    Gradings& gradings_;
    Box part_;
    glm::dmat3 axes_;
    std::vector<std::string>& notes_;
    std::map<std::string, FieldPtr> made_, even_;
};

/// The volume that a region affects: its inside, and points less than `reach` outside it, within the body.
class Reach : public Field {
  public:
    Reach(FieldPtr region, double reach, FieldPtr body)
        : region_(std::move(region)), reach_(reach), body_(std::move(body)) {}
    double value(dvec3 p) const override { return std::max(region_->value(p) - reach_, body_->value(p)); }
    Interval range(const Box& box) const override {
        const Interval region = region_->range(box), body = body_->range(box);
        return {std::max(region.lo - reach_, body.lo), std::max(region.hi - reach_, body.hi)};
    }
    Metric metric() const override { return Metric::sign; }
    Box bounds() const override { return body_->bounds(); }

  private:
    FieldPtr region_;
    double reach_;
    FieldPtr body_;
};

bool changes_numbers(const BuiltRegion& region) {
    return region.make == RegionMake::foam || region.make == RegionMake::skin;
}

/// Returns true for regions that leave the part's solid as it is.
bool keeps_solid(const BuiltRegion& region) {
    return changes_numbers(region) || region.make == RegionMake::tool || region.make == RegionMake::layers;
}

/// Returns true for regions that only control supports, which stand outside the part.
bool rules_supports(const BuiltRegion& region) {
    return region.make == RegionMake::blocker || region.make == RegionMake::enforcer;
}

void warn_of_idle(const FieldPtr& body, bool filled, BuiltRegions& regions) {
    for (const BuiltRegion& region : regions.list) {
        if (rules_supports(region)) continue;
        const double reach = changes_numbers(region) ? region.blend / 2 : 0;
        const Reach acted_on(region.field, reach, body);
        const Box box = intersect(body->bounds(), grown(region.field->bounds(), reach));
        if (!find_solid_point(acted_on, box)) {
            regions.warnings.push_back(region.name + " does not touch the part and changes nothing");
        } else if (region.make == RegionMake::solid && !filled && region.tool.empty() &&
                   region.layer_height == 0) {
            regions.warnings.push_back(region.name + " is solid where the part is solid and changes nothing");
        }
    }
}

FieldPtr joined(FieldPtr part, const BuiltRegion& region) {
    if (region.make == RegionMake::solid) {
        return region.blend > 0 ? make_smooth_union(std::move(part), region.field, region.blend)
                                : make_union({std::move(part), region.field});
    }
    return region.blend > 0 ? make_smooth_difference(std::move(part), region.field, region.blend)
                            : make_difference(std::move(part), region.field);
}

/// Applies the regions in order. Added solids are clipped by the body before an empty region is subtracted.
FieldPtr sequence(FieldPtr part, const FieldPtr& body, const BuiltRegions& regions) {
    bool beyond_body = false;
    for (const BuiltRegion& region : regions.list) {
        if (keeps_solid(region) || rules_supports(region)) continue;
        if (region.make == RegionMake::empty && beyond_body) {
            part = make_intersection({body, std::move(part)});
            beyond_body = false;
        }
        part = joined(std::move(part), region);
        beyond_body = beyond_body || region.make == RegionMake::solid;
    }
    return beyond_body ? make_intersection({body, std::move(part)}) : part;
}

BuiltRegion built_region(int number, const RegionRecipe& region, const FieldPtr& field) {
    return {fmt::format("region {} (`{}`)", number, region.field),
            region.make,
            region.blend,
            field,
            region.tool,
            region.layer_height};
}

bool has(const BuiltRegions& regions, RegionMake make) {
    for (const BuiltRegion& region : regions.list) {
        if (region.make == make) return true;
    }
    return false;
}

}  // namespace

BuiltRegions build_regions(const Recipe& recipe, const Box& part, Gradings& gradings, WhichRegions which) {
    BuiltRegions built;
    RegionFields fields(gradings, part, glm::dmat3(1), built.warnings);
    const ResultDependents late(recipe);
    int number = 0;
    for (const RegionRecipe& region : recipe.regions) {
        ++number;
        if (which == WhichRegions::before_search && late.fields.contains(region.field)) continue;
        const FieldPtr field = fields.make(region);
        built.list.push_back(built_region(number, region, field));
        for (const RegionNumber& given : numbers_of(region)) {
            gradings.override_number(given.key, {field, region.blend, *given.number});
        }
    }
    return built;
}

BuiltRegions turned_regions(const Recipe& recipe, const Box& part, Gradings& gradings,
                            const glm::dmat3& axes) {
    BuiltRegions built;
    RegionFields fields(gradings, part, axes, built.warnings);
    int number = 0;
    for (const RegionRecipe& region : recipe.regions) {
        const FieldPtr field = fields.make(region);
        built.list.push_back(built_region(++number, region, field));
    }
    return built;
}

FieldPtr with_regions(FieldPtr part, const FieldPtr& body, bool filled, BuiltRegions& regions) {
    if (regions.list.empty()) return part;
    warn_of_idle(body, filled, regions);
    if (has(regions, RegionMake::empty) &&
        !find_solid_point(*sequence(body, body, regions), body->bounds())) {
        throw InputError(
            "region: the empty regions remove the whole part; accepted: regions that leave some of it");
    }
    return sequence(std::move(part), body, regions);
}

}  // namespace lamella
