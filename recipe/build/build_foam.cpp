// Makes graded numbers, clamped to the printable range, then the foam of the requested kind.
#include "recipe/build/build_foam.h"

#include "engine/base/box_image.h"
#include "engine/base/error.h"
#include "engine/field/turned_grading.h"
#include "engine/solids/csg.h"
#include "procedural/foam/beam_box.h"
#include "procedural/foam/closed_foam.h"
#include "procedural/foam/nearest_foam.h"
#include "procedural/foam/voronoi_foam.h"
#include "procedural/lattice/strut_lattice.h"
#include "procedural/lattice/tpms.h"
#include "recipe/recipe_formulas.h"

namespace lamella {

namespace {

/// Returns a grading of the part where the cells are made.
GradingPtr among_cells(const FoamBuildContext& making, const GradingPtr& grading) {
    return make_turned_grading(grading, making.place.from_part);
}

/// Records a further graded number with the foam and returns its grading as made, where the cells are made.
GradingPtr further(FoamBuildContext& making, const char* key, const GradedNumber& number, Interval limits) {
    making.built.others.push_back(graded(key, number, limits, making.gradings, making.names));
    return among_cells(making, making.built.others.back().made);
}

/// Returns a foam, which is sampled once it is turned, in the job's space.
FieldPtr in_job(const FoamBuildContext& making, FieldPtr foam) {
    const glm::dmat3& axes = making.place.to_job;
    return axes == glm::dmat3(1) ? foam : make_transform(std::move(foam), axes, dvec3(0));
}

/// Makes the cells of seeds in a pattern, with a uniform stretch.
FoamSettings seeded(FoamBuildContext& making, SeedPattern pattern) {
    const FoamRecipe& foam = making.recipe;
    FoamSettings settings;
    settings.cell = among_cells(making, making.built.cell.made);
    settings.beam_radius = among_cells(making, making.built.member.made);
    settings.seed = static_cast<std::uint64_t>(foam.seed);
    settings.pattern = pattern;
    settings.jitter = foam.jitter;
    settings.repeats_after = making.repeats_after;
    settings.region = making.place.region;
    settings.turn = {making.place.to_job, making.place.job_region};
    const dvec3 stretch = constant(foam.stretch).value_or(dvec3(1));
    if (stretch != dvec3(1)) {
        settings.stretch = Stretch(turned_axes(constant(foam.turn).value_or(dvec3(0))), stretch);
    }
    if (const auto& frame = making.gradings.recipe().frame; frame && making.gradings.body()) {
        settings.frame = {making.place.job_body ? making.place.job_body : making.gradings.body(),
                          further(making, "frame.beam", frame->beam, {frame->beam_min, frame->beam_max}),
                          frame->interior};
    }
    return settings;
}

/// Returns the period of a foam on such seeds, mm.
double period_of(const FoamSettings& settings) {
    const bool alike = settings.cell->constant() && settings.stretch.identity();
    if (settings.repeats_after == 0 || !alike) return 0;
    return prepare_foam(settings).tree->coarse_side() * static_cast<double>(settings.repeats_after);
}

/// Makes beams along the edges of the seeds' cells.
void edges(FoamBuildContext& making, SeedPattern pattern) {
    const FoamSettings settings = seeded(making, pattern);
    BuiltFoam& built = making.built;
    const auto made = make_voronoi_foam(settings);
    built.field = made;
    built.period = period_of(settings);
    built.beams_touching = [made](const Box& box) { return made->beams_touching(box); };
    built.seeds_in = [made](const Box& box) { return made->seeds_in(box); };
    // The law was measured on jittered seeds in round cells.
    if (pattern != SeedPattern::jittered || !settings.stretch.identity()) return;
    built.volume_fraction = [made](dvec3 p) { return made->expected_volume_fraction(p); };
}

void voronoi(FoamBuildContext& making) { edges(making, SeedPattern::jittered); }

void kelvin(FoamBuildContext& making) { edges(making, SeedPattern::bcc); }

void closed(FoamBuildContext& making) {
    const FoamRecipe& foam = making.recipe;
    ClosedFoamSettings settings;
    settings.foam = seeded(making, SeedPattern::jittered);
    settings.wall = further(making, "foam.wall", foam.wall, {foam.wall_min, foam.wall_max});
    settings.window = further(making, "foam.window", foam.window, {0, 1});
    const auto made = make_closed_foam(settings);
    making.built.field = made;
    making.built.period = period_of(settings.foam);
    making.built.beams_touching = [made](const Box& box) {
        std::vector<Beam> beams;
        for (const FoamPiece& piece : made->pieces_touching(box)) {
            if (const auto* beam = std::get_if<Beam>(&piece)) beams.push_back(*beam);
        }
        return beams;
    };
    making.built.seeds_in = [ground = prepare_foam(settings.foam)](const Box& box) {
        return ground.seeds_in(box);
    };
}

void nearest_seeds(FoamBuildContext& making) {
    const FoamRecipe& foam = making.recipe;
    NearestFoamSettings settings;
    settings.foam.cell = among_cells(making, making.built.cell.made);
    settings.foam.beam_radius = among_cells(making, making.built.member.made);
    settings.foam.seed = static_cast<std::uint64_t>(foam.seed);
    settings.foam.repeats_after = making.repeats_after;
    settings.foam.region = making.place.region;
    settings.foam.turn = {making.place.to_job, making.place.job_region};
    settings.neighbours = static_cast<int>(foam.neighbours);
    for (std::size_t i = 0; i < 3; ++i) {
        settings.stretch[i] = further(making, "foam.stretch", foam.stretch[i], nearest_factors);
        settings.turn[i] = among_cells(making, making.gradings.resolve(foam.turn[i], making.names));
    }
    const auto made = std::make_shared<const NearestFoam>(settings);
    making.built.field = made;
    if (constant(foam.stretch) == dvec3(1)) making.built.period = period_of(settings.foam);
    making.built.beams_touching = [made](const Box& box) { return made->beams_touching(box); };
    making.built.seeds_in = [made](const Box& box) { return made->seeds_in(box); };
}

template <TpmsKind surface>
void periodic(FoamBuildContext& making) {
    BuiltFoam& built = making.built;
    built.period = built.cell.made->constant().value_or(0);
    built.field =
        in_job(making, make_tpms({surface, making.recipe.network, among_cells(making, built.cell.made),
                                  among_cells(making, built.member.made), making.place.region}));
}

void lattice(FoamBuildContext& making) {
    const FoamRecipe& foam = making.recipe;
    LatticeSettings settings;
    for (const auto& row : foam.struts) {
        settings.struts.push_back({{row[0], row[1], row[2]}, {row[3], row[4], row[5]}});
    }
    if (foam.struts.empty()) settings.struts = unit_cell(foam.unit_cell);
    settings.cell = among_cells(making, making.built.cell.made);
    settings.beam = among_cells(making, making.built.member.made);
    settings.region = making.place.region;
    const auto made = make_strut_lattice(settings);
    making.built.field = in_job(making, made);
    if (settings.cell->constant()) making.built.period = made->cells().coarse_side();
    const glm::dmat3 axes = making.place.to_job;
    making.built.beams_touching = [made, axes](const Box& box) {
        if (axes == glm::dmat3(1)) return made->beams_touching(box);
        std::vector<Beam> beams = made->beams_touching(image_of(box, glm::transpose(axes)));
        for (Beam& beam : beams) beam = {axes * beam.a, beam.ra, axes * beam.b, beam.rb};
        std::erase_if(beams, [&](const Beam& beam) { return !touches(beam, box); });
        return beams;
    };
}

/// Turns the numbers of a foam into the job's space.
void turn(BuiltFoam& built, const glm::dmat3& axes) {
    built.cell = turned(std::move(built.cell), axes);
    built.member = turned(std::move(built.member), axes);
    for (GradedUse& other : built.others) other = turned(std::move(other), axes);
    if (!built.modulus) return;
    if (built.modulus->asked) built.modulus->asked = turned(std::move(*built.modulus->asked), axes);
    if (built.modulus->made) built.modulus->made = make_turned_grading(built.modulus->made, axes);
}

/// Returns a kind with the limits of its cells and members added to its optional keys.
FoamBuilder kind(std::string word, std::string member, std::vector<std::string> needs,
                 std::vector<std::string> takes, void (*make)(FoamBuildContext&), FoamTraits traits = {}) {
    needs.insert(needs.begin(), {"cell", member});
    takes.insert(takes.end(), {"cell_min", "cell_max", member + "_min", member + "_max"});
    return {{std::move(word), std::move(needs), std::move(takes)}, std::move(member), make, traits};
}

}  // namespace

std::span<const FoamBuilder> foam_builders() {
    static const std::vector<FoamBuilder> list{
        kind("voronoi", "beam", {}, {"seed", "stretch", "turn"}, voronoi, {.has_faces = true}),
        kind("kelvin", "beam", {}, {"seed", "jitter", "stretch", "turn"}, kelvin, {.has_faces = true}),
        kind("closed", "beam", {"wall"}, {"wall_min", "wall_max", "window", "seed", "stretch", "turn"},
             closed, {.has_faces = true, .is_closed = true}),
        kind("k-nearest", "beam", {}, {"neighbours", "seed", "stretch", "turn"}, nearest_seeds,
             {.graded_stretch = nearest_factors}),
        kind("gyroid", "wall", {}, {"network"}, periodic<TpmsKind::gyroid>),
        kind("schwarz-p", "wall", {}, {"network"}, periodic<TpmsKind::schwarz_p>),
        kind("schwarz-d", "wall", {}, {"network"}, periodic<TpmsKind::schwarz_d>),
        kind("neovius", "wall", {}, {"network"}, periodic<TpmsKind::neovius>),
        kind("lattice", "beam", {"unit_cell|struts"}, {}, lattice)};
    return list;
}

std::vector<std::string> foams_with(const std::function<bool(const FoamTraits&)>& has) {
    std::vector<std::string> words;
    for (const FoamBuilder& builder : foam_builders()) {
        if (has(builder.traits)) words.push_back(builder.kind.word);
    }
    return words;
}

const FoamBuilder& builder_of(const FoamRecipe& foam) {
    for (const FoamBuilder& builder : foam_builders()) {
        if (builder.kind.word == foam.kind) return builder;
    }
    throw InputError("foam.kind: " + foam.kind + " is unknown");
}

BuiltFoam build_foam(const FoamRecipe& foam, const FoamPlace& place, Gradings& gradings,
                     std::int64_t repeats_after) {
    BuiltFoam built;
    FoamSizes sizes = foam_sizes(foam, gradings, built.modulus);
    built.cell = std::move(sizes.cell);
    built.member = std::move(sizes.member);
    const std::map<std::string, GradingPtr> cell{{std::string(cell_name), built.cell.made}};
    try {
        FoamBuildContext making{foam, place, gradings, cell, repeats_after, built};
        builder_of(foam).make(making);
    } catch (const LocatedError&) {
        throw;
    } catch (const InputError& error) {
        throw InputError("foam (" + foam.kind + "): " + error.what());
    }
    turn(built, place.to_job * place.from_part);
    return built;
}

}  // namespace lamella
