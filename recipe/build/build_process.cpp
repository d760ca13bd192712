// Scales first, then offsets in the plane, so that offsets are lengths as printed.
#include "recipe/build/build_process.h"

#include "engine/morphology/in_plane_offset.h"
#include "engine/morphology/mended_outline.h"
#include "engine/solids/csg.h"

namespace lamella {

namespace {

/// Tolerance of in-plane offsets, mm; well below the pixels and toolpaths of any printer.
constexpr double outline_tolerance = 0.01;

void scale_part(Job& job, dvec3 scale) {
    if (scale == dvec3(1)) return;
    const Box before = job.bounds;
    const dvec3 middle = before.center();
    const dvec3 fixed{middle.x, middle.y, before.lo.z};
    const glm::dmat3 linear(dvec3(scale.x, 0, 0), dvec3(0, scale.y, 0), dvec3(0, 0, scale.z));
    job.part = make_transform(job.part, linear, fixed - scale * fixed);
    job.bounds = {fixed + (before.lo - fixed) * scale, fixed + (before.hi - fixed) * scale};
}

/// Sampled lines per thickness or gap.
constexpr double lines_in_a_thickness = 8;

void grow_bounds(Job& job, double by) {
    job.bounds.lo -= dvec3(by, by, 0);
    job.bounds.hi += dvec3(by, by, 0);
}

void mend_outlines(Job& job, const RepairRecipe& repair) {
    if (repair.thickness > 0) {
        job.part = make_thickened(job.part, repair.thickness, repair.thickness / lines_in_a_thickness);
        grow_bounds(job, repair.thickness / 2);
    }
    // Gaps come second: thickened walls may have narrowed them.
    if (repair.gap > 0) job.part = make_gaps_filled(job.part, repair.gap, repair.gap / lines_in_a_thickness);
}

void move_outlines(Job& job, const ProcessRecipe& process) {
    const double everywhere = process.xy_compensation, foot = process.elephant_foot;
    if (everywhere == 0 && foot == 0) return;
    const double bed = job.z0();
    const auto layers = static_cast<double>(process.elephant_foot_layers);
    const auto by = [=, plan = job.layers](double z) {
        const double layer = plan.layer_at(z - bed);
        return layer < layers ? everywhere - foot * (1 - layer / layers) : everywhere;
    };
    job.part = make_in_plane_offset(job.part, {by, {everywhere - foot, everywhere}}, outline_tolerance);
    grow_bounds(job, std::max(everywhere, 0.0));
}

}  // namespace

FieldPtr make_scaled(const Recipe& recipe, const Job& designed, const FieldPtr& solid) {
    Job job = designed;
    job.part = solid;
    if (recipe.process) scale_part(job, recipe.process->scale);
    return job.part;
}

LayerPlan designed_layers(const Recipe& recipe, const LayerPlan& printed) {
    return recipe.process ? printed.divided(recipe.process->scale.z) : printed;
}

Job make_scaled(const Recipe& recipe, const Job& designed, const LayerPlan& printed) {
    Job job = designed;
    job.layers = printed;
    if (recipe.process) scale_part(job, recipe.process->scale);
    return job;
}

Job make_processed(const Recipe& recipe, const Job& designed, const LayerPlan& printed) {
    Job job = make_scaled(recipe, designed, printed);
    if (recipe.repair) mend_outlines(job, *recipe.repair);
    if (recipe.process) move_outlines(job, *recipe.process);
    return job;
}

}  // namespace lamella
