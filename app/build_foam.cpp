// Graded numbers first, kept within the printable range, then the foam of the kind asked for.
#include "app/build_foam.h"

#include "app/recipe_formulas.h"
#include "engine/error.h"
#include "procedural/strut_lattice.h"
#include "procedural/tpms.h"
#include "procedural/voronoi_foam.h"

namespace lamella {

namespace {

/// A Voronoi foam of seeds in a pattern.
void seeded(const FoamRecipe& foam, const Box& region, SeedPattern pattern, BuiltFoam& built) {
    FoamSettings settings;
    settings.cell = built.cell.made;
    settings.beam_radius = built.member.made;
    settings.seed = static_cast<std::uint64_t>(foam.seed);
    settings.pattern = pattern;
    settings.jitter = foam.jitter;
    if (foam.stretch != dvec3(1)) settings.stretch = Stretch(turned_axes(foam.turn), foam.stretch);
    settings.region = region;
    const auto made = make_voronoi_foam(settings);
    built.field = made;
    built.beams_touching = [made](const Box& box) { return made->beams_touching(box); };
    built.seeds_in = [made](const Box& box) { return made->seeds_in(box); };
    // The law was measured on jittered seeds in round cells.
    if (pattern != SeedPattern::jittered || !settings.stretch.identity()) return;
    built.volume_fraction = [made](dvec3 p) { return made->expected_volume_fraction(p); };
}

void voronoi(const FoamRecipe& foam, const Box& region, BuiltFoam& built) {
    seeded(foam, region, SeedPattern::jittered, built);
}

void kelvin(const FoamRecipe& foam, const Box& region, BuiltFoam& built) {
    seeded(foam, region, SeedPattern::bcc, built);
}

template <TpmsKind surface>
void periodic(const FoamRecipe& foam, const Box& region, BuiltFoam& built) {
    built.field = make_tpms({surface, foam.network, built.cell.made, built.member.made, region});
}

void lattice(const FoamRecipe& foam, const Box& region, BuiltFoam& built) {
    LatticeSettings settings;
    for (const auto& row : foam.struts) {
        settings.struts.push_back({{row[0], row[1], row[2]}, {row[3], row[4], row[5]}});
    }
    if (foam.struts.empty()) settings.struts = unit_cell(foam.unit_cell);
    settings.cell = built.cell.made;
    settings.beam = built.member.made;
    settings.region = region;
    const auto made = make_strut_lattice(settings);
    built.field = made;
    built.beams_touching = [made](const Box& box) { return made->beams_touching(box); };
}

/// A kind with the range of its cells and members among what it takes.
FoamBuilder kind(std::string word, std::string member, std::vector<std::string> needs,
                 std::vector<std::string> takes, void (*make)(const FoamRecipe&, const Box&, BuiltFoam&)) {
    needs.insert(needs.begin(), {"cell", member});
    takes.insert(takes.end(), {"cell_min", "cell_max", member + "_min", member + "_max"});
    return {{std::move(word), std::move(needs), std::move(takes)}, std::move(member), make};
}

}  // namespace

std::span<const FoamBuilder> foam_builders() {
    static const std::vector<FoamBuilder> list{
        kind("voronoi", "beam", {}, {"seed", "stretch", "turn"}, voronoi),
        kind("kelvin", "beam", {}, {"seed", "jitter", "stretch", "turn"}, kelvin),
        kind("gyroid", "wall", {}, {"network"}, periodic<TpmsKind::gyroid>),
        kind("schwarz-p", "wall", {}, {"network"}, periodic<TpmsKind::schwarz_p>),
        kind("schwarz-d", "wall", {}, {"network"}, periodic<TpmsKind::schwarz_d>),
        kind("neovius", "wall", {}, {"network"}, periodic<TpmsKind::neovius>),
        kind("lattice", "beam", {"unit_cell|struts"}, {}, lattice)};
    return list;
}

BuiltFoam build_foam(const FoamRecipe& foam, const Box& region, Gradings& gradings) {
    BuiltFoam built;
    built.cell = graded("foam.cell", foam.cell, {foam.cell_min, foam.cell_max}, gradings);
    const std::map<std::string, GradingPtr> cell{{std::string(cell_name), built.cell.made}};
    for (const FoamBuilder& builder : foam_builders()) {
        if (builder.kind.word != foam.kind) continue;
        built.member = builder.member == "wall"
                           ? graded("foam.wall", foam.wall, {foam.wall_min, foam.wall_max}, gradings, cell)
                           : graded("foam.beam", foam.beam, {foam.beam_min, foam.beam_max}, gradings, cell);
        try {
            builder.make(foam, region, built);
        } catch (const InputError& error) {
            throw InputError("foam (" + foam.kind + "): " + error.what());
        }
        return built;
    }
    throw InputError("foam.kind: " + foam.kind + " is unknown");
}

}  // namespace lamella
