// `lamella dump`: prints seeds, beams or elements as lines of numbers.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "engine/base/error.h"
#include "recipe/build/build_job.h"
#include "recipe/build/support_plan.h"
#include "recipe/output/beam_output.h"
#include "recipe/settings.h"
#include "recipe/structure/element_copies.h"

namespace lamella {

namespace {

struct DumpOptions {
    RecipeOptions recipe;
    std::string what;
    std::string box;
    std::string format = "csv";
    std::string output;
    bool header = false;
};

Box parse_box(const std::string& text) {
    const auto numbers = parse_numbers(text, 6);
    const auto refuse = [&](const std::string& wrong) {
        throw InputError(
            "--box: " + wrong +
            "; accepted: six finite numbers x0,y0,z0,x1,y1,z1 in mm, with x0 < x1, y0 < y1 and z0 < z1");
    };
    if (!numbers) refuse("\"" + text.substr(0, 96) + "\" is not six numbers");
    for (const double v : *numbers) {
        if (!std::isfinite(v)) refuse(fmt::format("{} is not a finite number", v));
    }
    const auto& n = *numbers;
    const Box box{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    if (box.empty()) refuse("a coordinate of the first corner is above that of the second");
    return box;
}

void write_seeds(const BuiltFoam& foam, const Box& box, TextOutput& out) {
    for (const Seed& s : foam.seeds_in(box)) {
        out.write(fmt::format("{},{},{}\n", s.position.x, s.position.y, s.position.z));
    }
}

void write_beams(const BuiltFoam& foam, const Box& box, TextOutput& out) {
    for (const Beam& b : foam.beams_touching(box)) {
        out.write(
            fmt::format("{},{},{},{},{},{},{},{}\n", b.a.x, b.a.y, b.a.z, b.ra, b.b.x, b.b.y, b.b.z, b.rb));
    }
}

void need_file(const DumpOptions& options) {
    if (options.output.empty() || options.output == "-")
        throw InputError("--output: missing; accepted: the path of the 3MF file to write");
}

void write_lattice(const BuiltFoam& foam, const Box& box, const DumpOptions& options,
                   const std::string& name) {
    if (options.what != "beams")
        throw InputError(
            "--format: 3mf files hold beams or elements; accepted: `dump beams`, `dump elements`, or csv");
    need_file(options);
    const BeamLatticeReport report = write_beam_lattice(options.output, foam.beams_touching(box), name);
    std::fputs((lattice_text(options.output, report) + "\n").c_str(), stderr);
}

/// Writes the discrete elements of the part.
void dump_elements(const Recipe& recipe, const DumpOptions& options) {
    if (!recipe.elements)
        throw InputError("elements: the recipe has none; accepted: a recipe with [[element]] and [elements]");
    if (!options.box.empty())
        throw InputError("--box: elements are written all; accepted: `dump elements` without it");
    const bool is_package = options.format == "3mf";
    if (is_package) need_file(options);
    const BuiltJob built = build_job(recipe, with_kept_plans(false));
    if (is_package) {
        const Box& bounds = built.designed.bounds;
        const ElementCopies made = element_copies(recipe, *built.elements, {bounds.lo.z, bounds.hi.z});
        return write_component_package(options.output, made.meshes, made.copies, recipe.part.name);
    }
    TextOutput out(options.output);
    if (options.header) out.write("shape,x,y,z,qw,qx,qy,qz,scale\n");
    std::ostringstream lines;
    std::vector<PlacedElement> elements = built.elements->elements;
    const auto shapes = static_cast<std::uint32_t>(recipe.element_shapes.size());
    for (PlacedElement& element : elements) element.shape %= shapes;  // whatever their thickness
    write_elements(lines, elements);
    out.write(lines.str());
    out.close();
}

void run(const DumpOptions& options) {
    const Recipe recipe = options.recipe.read(options.what == "elements");
    note_unused(options.recipe, recipe);
    if (options.what == "elements") return dump_elements(recipe, options);
    if (!recipe.foam)
        throw InputError(
            "foam: the recipe has no foam; accepted: --cell and --beam, or a recipe with [foam]");
    const bool has_body =
        !recipe.part.mesh.empty() || !recipe.part.field.empty() || recipe.part.shape != Shape::none;
    if (options.box.empty() && !has_body)
        throw InputError(
            "--box: missing, since there is no part; accepted: x0,y0,z0,x1,y1,z1 in mm, or a recipe with a "
            "part");
    std::optional<Box> box;
    if (!options.box.empty()) box = parse_box(options.box);
    BuiltFoam foam;
    if (has_body) {
        BuiltJob built = build_job(recipe, with_kept_plans(false));
        foam = std::move(*built.foam);
        if (!box) box = built.designed.bounds;
    } else {
        foam = build_foam_alone(recipe, *box);
    }
    const bool seeds = options.what == "seeds";
    if (seeds ? !foam.seeds_in : !foam.beams_touching) {
        throw InputError(fmt::format("foam.kind: {} has no {}; accepted: another kind of foam",
                                     recipe.foam->kind, options.what));
    }
    if (options.format == "3mf") return write_lattice(foam, *box, options, recipe.part.name);
    TextOutput out(options.output);
    if (options.header) out.write(seeds ? "x,y,z\n" : "x0,y0,z0,r0,x1,y1,z1,r1\n");
    seeds ? write_seeds(foam, *box, out) : write_beams(foam, *box, out);
    out.close();
}

}  // namespace

void add_dump_command(CLI::App& root) {
    auto options = std::make_shared<DumpOptions>();
    CLI::App& command = *root.add_subcommand(
        "dump", "Write the foam's seeds in a box, the beams that touch it, or the elements");
    command
        .add_option("WHAT", options->what,
                    "seeds (x,y,z), beams (x0,y0,z0,r0,x1,y1,z1,r1), or elements "
                    "(shape,x,y,z,qw,qx,qy,qz,scale), mm")
        ->required()
        ->check(CLI::IsMember({"seeds", "beams", "elements"}))
        ->type_name("");
    options->recipe.add_to(command);
    command.add_option("--box", options->box, "Corners in mm, part coordinates; default: the part's bounds")
        ->type_name("x0,y0,z0,x1,y1,z1");
    command
        .add_option("--format", options->format,
                    "csv: one line each, with numbers that read back exactly; 3mf: beams as a beam lattice, "
                    "elements as components of one object, not cut by the part")
        ->check(CLI::IsMember({"csv", "3mf"}))
        ->type_name("WORD");
    command.add_option("-o,--output", options->output, "File; default: standard output")->type_name("FILE");
    command.add_flag("--header", options->header, "Write the names of the columns in the first line");
    finish_command(command,
                   "  lamella dump beams --cell 3 --beam 0.5 --box 0,0,0,20,20,20 > beams.csv\n"
                   "  lamella dump beams insole.toml --format 3mf -o foam.3mf\n"
                   "  lamella dump seeds insole.toml --header -o seeds.csv\n"
                   "  lamella dump elements bracket.toml > elements.csv\n"
                   "  lamella dump elements bracket.toml --format 3mf -o elements.3mf");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
