// Rules that relate several settings, each of which is valid alone.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "printers/gcode/gcode_script.h"
#include "printers/registry.h"
#include "procedural/lattice/tpms.h"
#include "recipe/base_material.h"
#include "recipe/build/build_foam.h"
#include "recipe/keys/settings_rows.h"
#include "recipe/recipe_draft.h"

namespace lamella {

/// Checks a foam's stretch and turn against its kind.
void RecipeDraft::check_stretch(const FoamRecipe& foam) {
    const auto stretch = constant(foam.stretch);
    if (entry("foam", "turn") && stretch == dvec3(1)) {
        refuse(0,
               fmt::format("{}: has no effect without a stretch; accepted: foam.stretch / --stretch as well",
                           where("foam", "turn")));
    }
    if (const auto& factors = builder_of(foam).traits.graded_stretch) {
        for (const GradedNumber& factor : foam.stretch) {
            if (factor.is_formula() || factors->contains(factor.number())) continue;
            refuse(0,
                   fmt::format("{}: {} is too {} for kind {}; accepted: {} to {}", where("foam", "stretch"),
                               factor.number(), factor.number() < factors->lo ? "small" : "large", foam.kind,
                               factors->lo, factors->hi));
        }
        return;
    }
    for (const auto& [key, given] : {std::pair("stretch", stretch), std::pair("turn", constant(foam.turn))}) {
        if (given) continue;
        refuse(0, fmt::format(
                      "{}: must be constant for kind {}; accepted: three numbers, or kind {} with formulas",
                      where("foam", key), foam.kind,
                      fmt::join(foams_with([](const FoamTraits& t) { return t.graded_stretch.has_value(); }),
                                ", ")));
    }
}

/// Checks a graded number against its limits.
void RecipeDraft::check_limits(const std::string& section, const std::string& key, const GradedNumber& number,
                               double least, double most) {
    const std::string low = key + "_min", high = key + "_max";
    if (least > most) {
        refuse(0, fmt::format("{}: {} mm is more than {}, {} mm; accepted: a minimum not above the maximum",
                              where(section, low), least, where(section, high), most));
    } else if (!number.is_formula() && (number.number() < least || number.number() > most)) {
        refuse(0,
               fmt::format("{}: {} mm lies outside {}.{} and {}.{}; accepted: {} to {} mm",
                           where(section, key), number.number(), section, low, section, high, least, most));
    }
}

/// Checks the numbers of a foam against each other.
void RecipeDraft::check_foam(const FoamRecipe& foam) {
    check_stretch(foam);
    if (entry("foam", "cell")) check_limits("foam", "cell", foam.cell, foam.cell_min, foam.cell_max);
    if (entry("foam", "wall")) check_limits("foam", "wall", foam.wall, foam.wall_min, foam.wall_max);
    if (!entry("foam", "beam")) return;
    check_limits("foam", "beam", foam.beam, foam.beam_min, foam.beam_max);
    if (foam.cell.is_formula() || foam.beam.is_formula() || !entry("foam", "cell")) return;
    if (foam.beam.number() >= foam.cell.number() / 2) {
        refuse(0, fmt::format("{}: {} mm fills cells of {} mm; accepted: less than half the cell, {} mm",
                              where("foam", "beam"), foam.beam.number(), foam.cell.number(),
                              foam.cell.number() / 2));
    }
}

/// Checks that a modulus replaces either the cells or the members.
void RecipeDraft::check_modulus(const Recipe& recipe) {
    const FoamRecipe& foam = *recipe.foam;
    if (!entry("foam", "modulus")) {
        const bool is_driven = recipe.optimize && drives_foam(recipe.optimize->result);
        if (!entry("foam", "law") || recipe.material || is_driven) return;
        return refuse(0, fmt::format("{}: has no effect without a material; accepted: [material] as well, or "
                                     "foam.modulus / --modulus",
                                     where("foam", "law")));
    }
    const std::string member = member_of(foam);
    const bool is_closed = builder_of(foam).traits.is_closed;
    const bool has_cell = entry("foam", "cell") != nullptr, has_member = entry("foam", member) != nullptr;
    if (has_cell && has_member) {
        refuse(
            0,
            fmt::format(
                "{}: conflicts with the given cells and members, which determine the modulus; accepted: {}",
                where("foam", "modulus"),
                is_closed ? "foam.modulus without foam.cell"
                          : "foam.modulus with foam.cell or foam." + member + ", not both"));
    } else if (!has_cell && !has_member) {
        refuse(0, fmt::format("{}: determines cells or members from the other one, and neither is given; "
                              "accepted: foam.{} / --{} as well{}",
                              where("foam", "modulus"), member, member,
                              is_closed ? "" : ", or foam.cell / --cell"));
    } else if (is_closed && (has_cell || !entry("foam", "wall"))) {
        refuse(0, fmt::format("{}: determines the size of closed cells from their beams and walls; accepted: "
                              "foam.beam and foam.wall as well, and no foam.cell",
                              where("foam", "modulus")));
    }
    if (constant(foam.stretch) != dvec3(1)) {
        refuse(
            0,
            fmt::format(
                "{}: there is no stiffness law for stretched cells; accepted: foam.modulus without a stretch",
                where("foam", "stretch")));
    }
    if (recipe.material && has_modulus(*recipe.material)) return;
    refuse(
        0,
        fmt::format(
            "{}: needs a material; accepted: material.name / --material or material.young / --young as well",
            where("foam", "modulus")));
}

/// Checks the keys of a material against each other.
void RecipeDraft::check_material(const Recipe& recipe) {
    const MaterialRecipe& material = *recipe.material;
    const auto refuse_idle = [&](const char* key, const char* wanted) {
        if (!entry("material", key)) return;
        refuse(0, fmt::format("{0}: has no effect without {1}; accepted: {1} as well", where("material", key),
                              wanted));
    };
    if (material.name.empty()) refuse_idle("table", "material.name / --material");
    if (!recipe.foam) refuse_idle("tests", "[foam]");
}

void RecipeDraft::check_frame(const Recipe& recipe) {
    const FrameRecipe& frame = *recipe.frame;
    if (!recipe.foam || !builder_of(*recipe.foam).traits.has_faces) {
        refuse(0,
               fmt::format(
                   "{}: a frame needs a foam whose cells have faces, and {}; accepted: foam.kind = one of {}",
                   where("frame", "beam"),
                   recipe.foam ? "kind " + recipe.foam->kind + " has none" : "there is no foam",
                   fmt::join(foams_with(&FoamTraits::has_faces), ", ")));
    }
    check_limits("frame", "beam", frame.beam, frame.beam_min, frame.beam_max);
}

void RecipeDraft::check_output(const OutputRecipe& output) {
    if (output.beams.empty()) {
        if (output.beams_box.empty()) return;
        return refuse(0, fmt::format("{}: has no effect without a file for the beams; accepted: output.beams "
                                     "/ --output-beams as well",
                                     where("output", "beams_box")));
    }
    if (!output.beams.ends_with(".3mf")) {
        refuse(0, fmt::format("{}: \"{}\" does not end in .3mf; accepted: the path of a 3MF file",
                              where("output", "beams"), output.beams));
    }
    if (!output.beams_box.empty() && box_of(output.beams_box).empty()) {
        refuse(0, fmt::format("{}: a coordinate of the first corner is above that of the second; accepted: "
                              "the lower corner first",
                              where("output", "beams_box")));
    }
}

/// Checks the sizes of a scaffold, from the recipe or the printer's profile.
void RecipeDraft::check_support(const PrinterProfile& printer) {
    const SupportProfile& s = printer.support;
    const auto at_most = [&](const char* key, double size, const char* other, double most, const char* why) {
        if (size <= most) return;
        refuse(0, fmt::format("{0}: {1} mm {2} support.{3}, {4} mm; accepted: at most {4} mm",
                              where("support", key), size, why, other, most));
    };
    at_most("tip", s.tip, "pillar", s.pillar, "is wider than");
    at_most("pillar", s.pillar, "foot", s.foot, "is wider than");
    at_most("gap", s.gap, "connector", s.connector, "leaves nothing of");
    if (s.connector >= s.longest_connector) {
        refuse(
            0,
            fmt::format(
                "{0}: {1} mm is not less than support.longest_connector, {2} mm; accepted: less than {2} mm",
                where("support", "connector"), s.connector, s.longest_connector));
    }
    at_most("bar_width", s.bar_width, "bridge", s.bridge, "is more than");
    const double wall = s.wall > 0 ? s.wall : printer.filament.line_width;
    if (!s.round_pillars && wall >= s.pillar) {
        refuse(0,
               fmt::format("{0}: {1} mm{2} is too thick for crosses with arms of support.pillar, {3} mm; "
                           "accepted: less than {3} mm, or support.round_pillars = true",
                           where("support", "wall"), wall, s.wall > 0 ? "" : " (a line's width)", s.pillar));
    }
}

/// Checks the scripts of a G-code file, from the recipe or the printer's profile.
void RecipeDraft::check_scripts(const GcodeProfile& gcode) {
    for (const auto& [key, script] :
         {std::pair("start_script", &gcode.start_script), std::pair("layer_script", &gcode.layer_script),
          std::pair("end_script", &gcode.end_script), std::pair("tool_script", &gcode.tool_script)}) {
        if (const auto mistake = script_mistake(*script, gcode.flavour))
            refuse(0, fmt::format("{}: {}", where("printer", key), *mistake));
    }
}

/// Checks that a second picture of a pattern goes with its weight.
void RecipeDraft::check_second_image() {
    for (const auto& [key, other] :
         {std::pair("second_image", "second_weight"), std::pair("second_weight", "second_image")}) {
        if (!entry("skin", key) || entry("skin", other)) continue;
        refuse(0,
               fmt::format("{}: has no effect without skin.{}; accepted: both", where("skin", key), other));
    }
}

/// Checks that a skin with windows or holes lies inside the surface.
void RecipeDraft::check_cut_skin(const Recipe& recipe) {
    const SkinRecipe& skin = *recipe.skin;
    if (skin.side == SkinSide::inside) return;
    if (skin.pattern == "closed" && recipe.holes.empty() && skin.drains == 0) return;
    refuse(
        0,
        fmt::format(
            "{}: a skin with windows, holes or drains must lie inside the body's surface; accepted: inside",
            where("skin", "side")));
}

/// Checks cuts, and the keys that say how their pieces are joined.
void RecipeDraft::check_cuts(const Recipe& recipe) {
    constexpr std::size_t most = 8;
    if (recipe.cuts.size() > most)
        refuse(0, fmt::format("{}: there are {} cuts; accepted: at most {}", recipe.cuts[most].where,
                              recipe.cuts.size(), most));
    if (entry("plate", "piece") && recipe.plate.piece > 0 && recipe.cuts.empty())
        refuse(0, fmt::format("{}: nothing cuts the part into pieces; accepted: [[cut]] as well",
                              where("plate", "piece")));
    for (std::size_t i = 0; i < recipe.cuts.size(); ++i) {
        const CutRecipe& cut = recipe.cuts[i];
        if (cut.normal == dvec3(0))
            refuse(0, fmt::format("{}: has no direction; accepted: a vector with a length",
                                  where("cut", "normal", i)));
        if (cut.joints == 1)
            refuse(0, fmt::format("{}: pieces can turn about a single pin; accepted: 2 or 3",
                                  where("cut", "joints", i)));
        if (cut.joint != CutJoint::none) continue;
        for (const char* key : {"joints", "diameter", "depth", "clearance", "wall"}) {
            if (!entry("cut", key, i)) continue;
            refuse(0, fmt::format("{}: has no effect without a joint; accepted: cut.joint = \"pins\" or "
                                  "\"dowels\" as well",
                                  where("cut", key, i)));
        }
    }
}

/// Checks drains against their keys and the foam.
void RecipeDraft::check_drains(const Recipe& recipe) {
    if (recipe.skin->drains == 0) {
        for (const char* key : {"drain_radius", "drain_pitch"}) {
            if (!entry("skin", key)) continue;
            refuse(0,
                   fmt::format("{}: has no effect without drains; accepted: skin.drains / --drains as well",
                               where("skin", key)));
        }
    } else if (recipe.foam && builder_of(*recipe.foam).traits.is_closed &&
               !recipe.foam->window.is_formula() && recipe.foam->window.number() == 0) {
        refuse(0, fmt::format("{}: each cell of a closed foam is a separate cavity, too many to drain; "
                              "accepted: an open-cell foam, foam.window / --window above 0, or no drains",
                              where("skin", "drains")));
    }
}

/// Checks cavities and the shield against the settings that they depend on.
void RecipeDraft::check_layers(const LayersRecipe& layers) {
    constexpr double thinnest = 0.001, thickest = 10;  // mm
    double from = -1;
    for (const std::vector<double>& row : layers.heights) {
        if (row[0] <= from) {
            refuse(0,
                   fmt::format(
                       "{}: {} mm over the bed does not come after {} mm; accepted: pairs in ascending order",
                       where("layers", "heights"), row[0], from));
        }
        if (row[1] < thinnest || row[1] > thickest) {
            refuse(0, fmt::format("{}: layers of {} mm; accepted: {} to {} mm", where("layers", "heights"),
                                  row[1], thinnest, thickest));
        }
        from = row[0];
    }
    if (layers.cusp > 0 && !layers.heights.empty()) {
        refuse(0, fmt::format("{}: cannot be combined with layers.cusp; accepted: one of the two",
                              where("layers", "heights")));
    }
    for (const char* key : {"least", "most"}) {
        if (const Entry* given = entry("layers", key); given && layers.cusp == 0) {
            refuse(0, fmt::format(
                          "{}: has no effect without layers.cusp; accepted: layers.cusp / --cusp as well",
                          given->where));
        }
    }
    const double least = layers.least > 0 ? layers.least : layers.height / 2;
    const double most = layers.most > 0 ? layers.most : layers.height * 3 / 2;
    if (layers.cusp > 0 && least > most) {
        refuse(0,
               fmt::format("{}: layers of {:.6g} mm at least and {:.6g} mm at most; accepted: layers.least / "
                           "--least-layer of no more than layers.most / --most-layer",
                           where("layers", layers.least > 0 ? "least" : "most"), least, most));
    }
}

void RecipeDraft::check_enclosures(const Recipe& recipe) {
    if (recipe.cavity && (recipe.foam || recipe.skin)) {
        refuse(
            0,
            fmt::format(
                "{}: a part with {} cannot have cavities; accepted: a solid part, without [foam] and [skin]",
                where("cavity", "wall"), recipe.foam ? "foam" : "a skin"));
    }
    if (recipe.shield && cuts_sheets(recipe.printer)) {
        refuse(0,
               fmt::format(
                   "{}: a printer that cuts sheets cannot make a shield; accepted: another kind of printer",
                   where("shield", "gap")));
    }
}

/// Checks the sizes of the part's shape, or of a field's.
template <typename Sizes>
void RecipeDraft::check_shape(const Part& of, const std::string& shape, const Sizes& sizes) {
    if (shape == "capsule" && sizes.height < 2 * sizes.radius) {
        refuse(0, fmt::format(
                      "{}: {} mm is too short for two round ends of radius {} mm; accepted: {} mm or more",
                      where(of.section, "height", of.entry), sizes.height, sizes.radius, 2 * sizes.radius));
    }
    if (shape == "torus" && sizes.tube >= sizes.radius) {
        refuse(0, fmt::format(
                      "{}: {} mm closes the hole of a torus of radius {} mm; accepted: less than the radius",
                      where(of.section, "tube", of.entry), sizes.tube, sizes.radius));
    }
}

/// Checks numbers that are valid alone against each other.
void RecipeDraft::check_numbers(const Recipe& recipe) {
    const PartRecipe& part = recipe.part;
    if (recipe.foam) check_foam(*recipe.foam);
    if (recipe.foam) check_modulus(recipe);
    if (recipe.material) check_material(recipe);
    if (recipe.frame) check_frame(recipe);
    check_output(recipe.output);
    check_layers(recipe.layers);
    check_enclosures(recipe);
    check_scripts(recipe.printer.gcode);
    check_tools(recipe);
    check_cuts(recipe);
    if (recipe.support != SupportKind::none) check_support(recipe.printer);
    if (recipe.support != SupportKind::none && cuts_sheets(recipe.printer)) {
        refuse(0, fmt::format(
                      "{}: a printer that cuts sheets cannot make supports; accepted: none, or another kind "
                      "of printer, such as svg without kerf, laser, ties, numbers, next_outline and sheet",
                      where("support", "kind")));
    }
    if (const auto& skin = recipe.skin) {
        check_limits("skin", "thickness", skin->thickness, skin->thickness_min, skin->thickness_max);
        check_drains(recipe);
        check_second_image();
        check_cut_skin(recipe);
    } else if (!recipe.holes.empty()) {
        refuse(0, fmt::format("{}: holes are drilled through a skin, and there is none; accepted: [skin] "
                              "with a thickness above 0",
                              recipe.holes.front().where));
    }
    if (const Entry* layers = entry("process", "elephant_foot_layers");
        layers && recipe.process->elephant_foot == 0) {
        refuse(0, fmt::format("{}: has no effect while process.elephant_foot is 0; accepted: "
                              "process.elephant_foot / --elephant-foot above 0",
                              layers->where));
    }
    check_shape({"part", 0}, choice_names(part.shape)[static_cast<std::size_t>(part.shape)], part);
    for (std::size_t i = 0; i < recipe.fields.size(); ++i) {
        check_shape({"field", i}, recipe.fields[i].kind, recipe.fields[i]);
    }
    const double thickest = greatest_tpms_thickness(TpmsKind::gyroid, false) * part.period;
    if (part.shape == Shape::gyroid && part.thickness >= thickest) {
        refuse(0, fmt::format("{}: {} mm fills a gyroid of period {} mm; accepted: less than {:.4g} mm",
                              where("part", "thickness"), part.thickness, part.period, thickest));
    }
    if (part.lay_on != dvec3(0) && !part.lay_on_at.empty()) {
        refuse(0,
               fmt::format("{}: cannot be combined with part.lay_on; accepted: a face's direction or a point "
                           "of it",
                           where("part", "lay_on_at")));
    }
    if (part.name.find_first_of("/\\") != std::string::npos || part.name == "." || part.name == "..") {
        refuse(0, fmt::format("{}: \"{}\" cannot name a file; accepted: a text without / and \\",
                              where("part", "name"), part.name));
    }
}

}  // namespace lamella
