// The skin: its thickness, a closed one in closed form, and one cut by windows, holes and drains.
#include "recipe/build/fill_body.h"

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/shell.h"

namespace lamella {
namespace {

/// The thickness of a skin: a number, or a grading (BuiltJob::skin).
struct SkinThickness {
    double number = 0;  ///< mm
    const GradedUse* graded = nullptr;

    /// Returns the thickest that the skin of a body becomes, mm.
    double thickest(const Field& body) const {
        return graded != nullptr ? graded->made->range(body.bounds()).hi : number;
    }
};

SkinThickness skin_thickness(const SkinRecipe& skin, BuiltJob& built, Gradings& gradings) {
    if (!skin.thickness.is_formula() && gradings.overrides("skin.thickness").empty())
        return {skin.thickness.number()};
    built.skin =
        turned(graded("skin.thickness", skin.thickness, {skin.thickness_min, skin.thickness_max}, gradings),
               built.axes);
    return {0, &*built.skin};
}

/// A skin without openings. The body is asked for its distance once a point.
FieldPtr under_closed_skin(const BuiltJob& built, const FieldPtr& foam, const SkinThickness& thickness,
                           SkinSide side) {
    if (thickness.graded == nullptr) return make_filled_body(built.body, foam, thickness.number, side);
    return make_filled_body(built.body, foam, thickness.graded->asked, thickness.graded->limits, side);
}

/// The body filled with foam, under a shell with holes.
FieldPtr drilled(const BuiltJob& built, const FieldPtr& foam, FieldPtr shell,
                 const std::vector<DrilledHole>& holes) {
    shell = without_holes(std::move(shell), holes);
    FieldPtr inside = foam ? make_union({foam, std::move(shell)}) : std::move(shell);
    std::vector<DrilledHole> through = holes;
    std::erase_if(through, [](const DrilledHole& hole) { return !hole.through; });
    return without_holes(make_intersection({built.body, std::move(inside)}), through);
}

/// A skin with windows and holes; drains are placed once all else is there.
FieldPtr under_cut_skin(const Recipe& recipe, BuiltJob& built, const FieldPtr& foam,
                        const SkinThickness& thickness, Gradings& gradings, const PatternWork& work) {
    FieldPtr shell = thickness.graded == nullptr
                         ? make_shell(built.body, thickness.number)
                         : make_shell(built.body, thickness.graded->asked, thickness.graded->limits);
    const double depth = thickness.thickest(*built.body);
    shell =
        cut_windows(recipe, std::move(shell), {built.body, built.axes}, depth, gradings, work, built.pattern);
    built.holes = drilled_holes(recipe, {built.body, built.axes}, depth);
    FieldPtr part = drilled(built, foam, shell, built.holes);
    if (recipe.skin->drains == 0) return part;
    Job job = built.designed;
    job.part = part;
    built.drains = place_drains(recipe, job, *built.body, depth);
    std::vector<DrilledHole> holes = built.holes;
    holes.insert(holes.end(), built.drains->holes.begin(), built.drains->holes.end());
    return drilled(built, foam, shell, holes);
}

}  // namespace

FieldPtr fill_body(const Recipe& recipe, BuiltJob& built, Gradings& gradings, const PatternWork& work) {
    const FieldPtr foam = built.foam ? built.foam->field : nullptr;
    if (!recipe.skin) return foam ? make_filled_body(built.body, foam, 0) : built.body;
    const std::string& where = recipe.skin->thickness.where;
    try {
        const SkinThickness thickness = skin_thickness(*recipe.skin, built, gradings);
        if (has_cut_skin(recipe)) return under_cut_skin(recipe, built, foam, thickness, gradings, work);
        return under_closed_skin(built, foam, thickness, recipe.skin->side);
    } catch (const LocatedError&) {
        throw;
    } catch (const InputError& error) {
        throw InputError((where.empty() ? "skin.thickness" : where) + ": " + error.what() +
                         "; accepted: a mesh, or another shape than this one");
    }
}

}  // namespace lamella
