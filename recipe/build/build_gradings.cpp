// The registry of grading kinds; makes gradings and those they depend on.
#include "recipe/build/build_gradings.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "engine/base/error.h"
#include "engine/field/turned_grading.h"
#include "engine/formula/formula_grading.h"
#include "engine/formula/formula_parser.h"
#include "procedural/grading/attractors.h"
#include "procedural/grading/attribute_grading.h"
#include "procedural/grading/region_grading.h"
#include "procedural/grading/table_grading.h"
#include "procedural/volume/volume_grading.h"
#include "procedural/volume/volumetric_model.h"
#include "recipe/recipe_formulas.h"
#include "recipe/result_dependents.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

dvec3 point(std::span<const double> numbers) { return {numbers[0], numbers[1], numbers[2]}; }

GradingPtr volume(const GradingRecipe& grading, Gradings& /*others*/) {
    VolumeSource source;
    source.path = grading.file;
    source.channel = static_cast<int>(grading.channel);
    if (!grading.box.empty()) source.box = Box{point(grading.box[0]), point(grading.box[1])};
    return make_volume_grading(source);
}

GradingPtr build_table(const GradingRecipe& grading, Gradings& others) {
    Table rows;
    for (const auto& row : grading.rows) rows.emplace_back(row[0], row[1]);
    if (!grading.file.empty()) rows = read_table(grading.file);
    return make_table_grading(others.resolve(grading.along), std::move(rows), grading.smooth);
}

GradingPtr package(const GradingRecipe& grading, Gradings& /*others*/) {
    VolumetricModel model(grading.file);
    if (!grading.property.empty()) return model.property(grading.property, grading.object);
    if (!grading.object.empty())
        throw InputError(
            "object cannot be combined with a function; accepted: object together with a property");
    PlacedFormula function = model.function(grading.function);
    return make_formula_grading(std::move(function.formula), std::move(function.others));
}

/// Makes an attribute grading; without a file, from the part's own mesh.
GradingPtr attribute(const GradingRecipe& grading, Gradings& others) {
    const PartRecipe& part = others.recipe().part;
    const std::string& file = grading.file.empty() ? part.mesh : grading.file;
    if (file.empty()) {
        throw InputError("there is no mesh to read `" + grading.attribute +
                         "` from; accepted: file with the path of a PLY mesh, or a PLY mesh as part.mesh");
    }
    return make_attribute_grading(file, grading.attribute, millimetres(part.unit) * part.scale, 1);
}

GradingPtr attractors(const GradingRecipe& grading, Gradings& /*others*/) {
    std::vector<Attractor> list;
    for (const auto& row : grading.points) list.push_back({Attractor::Kind::point, point(row), {}});
    for (const auto& row : grading.segments) {
        list.push_back({Attractor::Kind::segment, point(row), point(std::span(row).subspan(3))});
    }
    return make_falloff_grading(make_distance_grading(std::move(list)), grading.near_value, grading.far_value,
                                grading.radius, grading.falloff);
}

GradingPtr distance(Attractor from) { return make_distance_grading({from}); }

}  // namespace

std::span<const GradingBuilder> grading_builders() {
    using G = GradingRecipe;
    static const std::vector<GradingBuilder> list{
        {{"constant", {"value"}, {}}, [](const G& g, Gradings&) { return make_constant_grading(g.value); }},
        {{"formula", {"formula"}, {}},
         [](const G& g, Gradings& others) { return others.resolve(g.formula); }},
        {{"volume", {"file"}, {"box", "channel"}}, volume},
        {{"3mf", {"file", "property|function"}, {"object"}}, package},
        {{"table", {"along", "rows|file"}, {"smooth"}}, build_table},
        {{"attribute", {"attribute"}, {"file"}}, attribute},
        {{std::string(host_kind), {}, {}}, [](const G& g, Gradings&) { return g.host.pointer; }},
        {{std::string(optimized_kind), {}, {}},
         [](const G&, Gradings& others) { return others.result().density; }},
        {{"attractors", {"near", "far", "radius"}, {"points", "segments", "falloff"}}, attractors},
        {{"point", {"at"}, {}},
         [](const G& g, Gradings&) {
             return distance({Attractor::Kind::point, g.at, {}});
         }},
        {{"line", {"a", "b"}, {}},
         [](const G& g, Gradings&) {
             return distance({Attractor::Kind::segment, g.a, g.b});
         }},
        {{"plane", {"at", "normal"}, {}}, [](const G& g, Gradings&) {
             return distance({Attractor::Kind::plane, g.at, g.normal});
         }}};
    return list;
}

const SearchResult& Gradings::result() const {
    if (result_) return *result_;
    throw InputError(
        "the result of [optimize] is not there where this is needed; accepted: a number that does not depend "
        "on it");
}

void Gradings::set_body(FieldPtr body) {
    body_ = std::move(body);
    made_.erase(std::string(depth_name));
}

/// Returns the grading behind a name other than x, y and z.
GradingPtr Gradings::named(const std::string& name) {
    if (const auto made = made_.find(name); made != made_.end()) return made->second;
    if (name == depth_name) {
        if (!body_)
            throw InputError(
                "the depth `d` is measured from the part's surface, but there is no part; accepted: a "
                "formula without `d`, or a recipe with [part]");
        return made_[name] = make_depth_grading(body_);
    }
    for (const GradingRecipe& grading : recipe_.gradings) {
        if (grading.name != name) continue;
        for (const GradingBuilder& builder : grading_builders()) {
            if (builder.kind.word != grading.kind) continue;
            try {
                return made_[name] = builder.make(grading, *this);
            } catch (const LocatedError&) {
                throw;
            } catch (const InputError& error) {
                throw LocatedError(grading.where + " `" + name + "`: " + error.what());
            }
        }
    }
    throw InputError("no [[grading]] is named `" + name + "`");
}

GradedFormula Gradings::formula_of(const GradedNumber& number,
                                   const std::map<std::string, GradingPtr>& more) {
    std::vector<std::string> names{"x", "y", "z"};
    std::vector<GradingPtr> others;
    try {
        for (const std::string& name : names_beyond_place(number.formula())) {
            const auto extra = more.find(name);
            others.push_back(extra == more.end() ? named(name) : extra->second);
            names.push_back(name);
        }
        return {parse_formula(number.formula(), names), std::move(others)};
    } catch (const LocatedError&) {
        throw;
    } catch (const InputError& error) {
        throw LocatedError(number.where + ": " + error.what());
    }
}

GradingPtr Gradings::resolve(const GradedNumber& number, const std::map<std::string, GradingPtr>& more) {
    if (!number.is_formula()) return make_constant_grading(number.number());
    GradedFormula graded = formula_of(number, more);
    return make_formula_grading(std::move(graded.formula), std::move(graded.others));
}

GradedUse turned(GradedUse use, const glm::dmat3& axes) {
    use.asked = make_turned_grading(std::move(use.asked), axes);
    use.made = make_turned_grading(std::move(use.made), axes);
    return use;
}

void Gradings::override_number(const std::string& key, RegionalNumber number) {
    overrides_[key].push_back(std::move(number));
}

std::span<const RegionalNumber> Gradings::overrides(const std::string& key) const {
    const auto found = overrides_.find(key);
    return found == overrides_.end() ? std::span<const RegionalNumber>() : found->second;
}

namespace {

/// Returns the recipe's key for the upper limit of another key; null when there is none.
const Setting* upper_limit(const std::string& key) {
    const std::size_t dot = key.find('.');
    return find_setting(key.substr(0, dot), key.substr(dot + 1) + "_max");
}

/// Returns the number used where a formula is undefined, for a body in which it should be defined.
double greatest_of(const GradedUse& use, const std::string& where, const Field& body) {
    const Setting* key = upper_limit(use.key);
    const bool stated = key && use.limits.hi < key->limits.hi;
    if (stated || use.asked->range(body.bounds()).hi < infinity) return use.limits.hi;
    const GradingSurvey found = survey_grading(*use.asked, body, use.limits);
    if (found.undefined == 0) {
        const double twice = 2 * found.asked.hi;
        return twice > use.limits.lo ? std::min(use.limits.hi, twice) : use.limits.hi;
    }
    const std::string remedy = key ? fmt::format(", or {} / {}, which is used where the formula is undefined",
                                                 key->name(), key->flag)
                                   : "";
    throw LocatedError(
        fmt::format("{}: the formula is undefined in {:.3g} % of the part; accepted: a formula that is "
                    "defined at every point of the part{}",
                    where, 100.0 * found.undefined / found.points, remedy));
}

}  // namespace

GradedUse graded(const std::string& key, const GradedNumber& number, Interval limits, Gradings& gradings,
                 const std::map<std::string, GradingPtr>& more) {
    const Setting* setting = find_setting(key.substr(0, key.find('.')), key.substr(key.find('.') + 1));
    GradedUse use{key, gradings.resolve(number, more), nullptr, limits, setting ? setting->unit : ""};
    std::string where = number.where;
    for (const RegionalNumber& other : gradings.overrides(key)) {
        if (!number.is_formula() && other.number.is_formula()) where = other.number.where;
        use.asked =
            make_region_grading(use.asked, gradings.resolve(other.number, more), other.region, other.blend);
    }
    use.made = use.asked;
    if (!number.is_formula() && gradings.overrides(key).empty()) return use;
    if (gradings.body()) use.limits.hi = greatest_of(use, where, *gradings.body());
    Interval applied = use.limits;
    if (gradings.body()) {
        // A foam's cells reach out of the part; there a formula may give what it gives nowhere inside.
        const Interval inside = range_in(*gradings.body(), *use.asked);
        const Interval asked{std::clamp(inside.lo, applied.lo, applied.hi),
                             std::clamp(inside.hi, applied.lo, applied.hi)};
        if (!asked.empty()) applied = asked;
    }
    use.made = make_clamped_grading(use.asked, applied);
    return use;
}

}  // namespace lamella
