// Primitives, set operations, foams, lattices, skins, formulas, elements.
#include "tests/engine/field/example_fields.h"

#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"
#include "engine/mesh/mesh_field.h"
#include "engine/morphology/in_plane_offset.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "engine/solids/shell.h"
#include "procedural/elements/element_field.h"
#include "procedural/foam/closed_foam.h"
#include "procedural/foam/voronoi_foam.h"
#include "procedural/grading/field_slope.h"
#include "procedural/lattice/strut_lattice.h"
#include "procedural/lattice/tpms.h"
#include "procedural/scaffold/scaffold_field.h"
#include "procedural/skin/image_windows.h"
#include "procedural/skin/surface_windows.h"
#include "tests/engine/field/gradings.h"
#include "tests/engine/solids/shapes.h"

namespace lamella {

namespace {

/// Boxes of a plan: towers of several rows and thin bars; of a box from -2 to 2, some inside, some across its
/// border, one beside it.
std::shared_ptr<const RunBoxes> plan_of_boxes() {
    const SurveyGrid grid{{-2.5, -2.5}, 0.3, -2.0, 0.4};
    std::vector<PlacedRun> runs;
    for (int layer = 1; layer < 8; ++layer) {
        for (int row = 4; row < 9; ++row) runs.push_back({layer, row, 300 + 40 * row, 900 + 40 * row});
        runs.push_back({layer, 2, -200, 700});
        runs.push_back({layer, 18, 100, 1200});
    }
    return std::make_shared<RunBoxes>(grid, std::move(runs));
}

/// Moved in three steps, the first of which is none.
FieldPtr with_moved_outline(FieldPtr solid, double most) {
    const auto by = [most](double z) { return z < -0.5 ? 0 : z < 0.5 ? most / 2 : most; };
    return make_in_plane_offset(std::move(solid), {by, {std::min(most, 0.0), std::max(most, 0.0)}}, 0.03);
}

FieldPtr tpms(TpmsKind kind, bool network, GradingPtr period, GradingPtr thickness) {
    return make_tpms({kind, network, std::move(period), std::move(thickness), {dvec3(-4.5), dvec3(4.5)}});
}

FieldPtr gyroid(double period, double thickness) {
    return tpms(TpmsKind::gyroid, false, make_constant_grading(period), make_constant_grading(thickness));
}

FieldPtr lattice(const char* cell_name, GradingPtr cell, GradingPtr beam) {
    return make_strut_lattice(
        {unit_cell(cell_name), std::move(cell), std::move(beam), {dvec3(-4.5), dvec3(4.5)}});
}

FieldPtr walled_foam(Graded wall, Graded window) {
    ClosedFoamSettings settings;
    settings.foam.cell = 1.6;
    settings.foam.beam_radius = 0.1;
    settings.foam.region = {dvec3(-4.5), dvec3(4.5)};
    settings.wall = std::move(wall);
    settings.window = std::move(window);
    return make_closed_foam(settings);
}

/// The shell of a body with windows in it.
FieldPtr windowed(const FieldPtr& body, bool hexagons) {
    const SurfaceWindowSettings settings{0.9, 0.3, 0.15, 0.4};
    std::shared_ptr<const WindowPattern> pattern;
    if (hexagons) {
        pattern = make_hexagon_windows(*body, settings);
    } else {
        pattern = make_voronoi_windows(*body, settings, 3);
    }
    return make_intersection({body, make_patterned_shell(make_shell(body, 0.4), pattern)});
}

/// The shell of a ball with a picture of a grid in it.
FieldPtr pictured(const FieldPtr& ball) {
    Volume picture;
    picture.size = {8, 8, 1};
    std::vector<std::uint8_t> samples(64, 255);
    for (std::size_t k = 0; k < 8; ++k) samples[k] = samples[8 + k] = samples[8 * k] = samples[8 * k + 1] = 0;
    picture.samples = std::move(samples);
    picture.full_scale = 255;
    const auto pattern =
        std::make_shared<ImageWindows>(StrutImage(picture, {1.3, 0.25, 0.5, false}), *ball, 0.25, 0.4);
    return make_intersection({ball, make_patterned_shell(make_shell(ball, 0.4), pattern)});
}

/// Foam that ends at a ball, in a frame on its surface.
FieldPtr framed_foam(const FieldPtr& body) {
    FoamSettings settings;
    settings.cell = 2;
    settings.beam_radius = 0.15;
    settings.region = {dvec3(-4.5), dvec3(4.5)};
    settings.frame = FrameSettings{body, 0.3, true};
    return make_voronoi_foam(settings);
}

/// Bars on pillars, with a connector that leans on them and one on the bed.
FieldPtr scaffold(bool round_pillars) {
    Scaffold made;
    made.shape.bed = -2.1;
    made.shape.pillar = 1.3;
    made.shape.wall = 0.3;
    made.shape.bar_width = 0.5;
    made.shape.bar_height = 0.4;
    made.shape.round_pillars = round_pillars;
    made.pillars = {{{-2, -1}, -2.1, 0.7, 1.1}, {{1.6, 0.8}, -2.1, 0.7, 1.2}, {{0.3, 2.2}, -0.9, 1.4, 0}};
    made.bars = {{{-2, -1, 1.1}, {1.6, 0.8, 1.1}}, {{0.3, 2.2, 1.8}, {-1.9, -0.9, 1.8}}};
    made.connectors = {{{0.4, 0.9, 2.3}, 0.15, {-0.2, -0.1, 1.1}, 0.25},
                       {{0.3, 2.2, -1.6}, 0.3, {0.3, 2.2, -0.9}, 0.65},
                       {{2.4, -1.8, -0.4}, 0.15, {2.4, -1.8, -2.1}, 0.15}};
    return make_scaffold_field(made);
}

/// The solid where the text, about x, y, z and the depth d in a ball, is negative.
FieldPtr formula(const char* text, double half, Metric metric) {
    const std::vector<std::string> names{"x", "y", "z", "d"};
    const GradingPtr depth = make_depth_grading(make_sphere({0.2, 0, 0.1}, 2));
    return make_formula_field(parse_formula(text, names), {depth}, {dvec3(-half), dvec3(half)}, metric);
}

/// A solid that knows nothing but its values and ranges, and wants to be asked for many.
class ForMany : public Field {
  public:
    ForMany(FieldPtr solid) : solid_(std::move(solid)) {}
    double value(dvec3 p) const override { return solid_->value(p); }
    Interval range(const Box& box) const override { return solid_->range(box); }
    Metric metric() const override { return solid_->metric(); }
    bool takes_many() const override { return true; }
    Box bounds() const override { return solid_->bounds(); }

  private:
    FieldPtr solid_;
};

/// A stick, a ring and a concave outline, placed, turned and scaled; about z alone if they are upright.
FieldPtr placed_elements(std::optional<Interval> upright) {
    const std::vector<ElementShapePtr> shapes{
        make_stick(3, 0.7), make_ring(2.4, 0.6),
        make_outline({{{-1, -1}, {1.1, -0.8}, {0.2, 0}, {1, 1.2}, {-0.9, 0.8}}}, 0.8)};
    std::vector<PlacedElement> elements;
    for (std::uint32_t k = 0; k < 12; ++k) {
        PlacedElement element{.shape = k % 3,
                              .at = {1.7 * (k % 4) - 2.4, 1.5 * (k / 4) - 1.6, 0.2 * (k % 5) - 0.5}};
        element.scale = 0.7 + 0.05 * k;
        const dvec3 rotation(upright ? 0 : 0.3 * k, upright ? 0 : 0.2 * k - 1, 0.5 * k);
        elements.push_back(turned(element, rotation));
    }
    return make_element_field(shapes, elements, upright);
}

FieldPtr for_many(FieldPtr solid) { return std::make_shared<ForMany>(std::move(solid)); }

}  // namespace

std::vector<NamedField> all_fields() {
    const FieldPtr sphere = make_sphere({0.3, -0.2, 0.1}, 2.5);
    const FieldPtr box = make_box({{-2, -1.5, -1}, {1.5, 2.25, 1.75}});
    const FieldPtr cone = make_round_cone({{-2, -1, -0.5}, 0.9, {1.7, 1.2, 0.8}, 0.4});
    const FieldPtr torus = make_torus({0, 0.1, 0}, 2, 0.7);
    const FieldPtr mesh = make_mesh_field(shapes::closed(shapes::icosphere(3, 2.4)));
    const GradingPtr graded = steady_function([](dvec3 p) { return 0.3 + 0.2 * p.x - 0.1 * p.y; }, 0.23);
    const glm::dmat3 turn(glm::dvec3(0.8, 0.6, 0), glm::dvec3(-0.6, 0.8, 0), glm::dvec3(0, 0, 1));
    const glm::dmat3 mirror(glm::dvec3(-1.1, 0, 0), glm::dvec3(0, 0.9, 0), glm::dvec3(0, 0, 1.2));
    const auto slope = std::make_shared<Linear>(0.3, dvec3(0.02, 0.01, -0.01));
    const auto steep_slope = std::make_shared<Linear>(2.5, dvec3(0.15, -0.1, 0.1));
    return {
        {"sphere", sphere},
        {"box", box},
        {"rounded box", make_box({{-2, -1.5, -1}, {1.5, 2.25, 1.75}}, 0.6)},
        {"cylinder", make_cylinder({-1.5, -1, -1}, {1, 1.5, 1}, 1.1)},
        {"upright cylinder", make_cylinder({0, 0, -2}, {0, 0, 2}, 1.3)},
        {"round cone", cone},
        {"capsule along x", make_round_cone({{-2, 0.1, 0}, 0.5, {2, 0.1, 0}, 0.5})},
        {"cone with one ball inside the other", make_round_cone({{0, 0, 0}, 2, {0.5, 0, 0}, 0.3})},
        {"steep cone", make_round_cone({{-1, 0, 0}, 1.8, {1.5, 0.1, 0.1}, 0.2})},
        {"torus", torus},
        {"half-space", make_half_space({1, 2, -0.5}, 0.4)},
        {"scaffold on crosses", scaffold(false)},
        {"scaffold on round pillars", scaffold(true)},
        {"foam with walls", walled_foam(0.15, 0.0)},
        {"foam with graded walls and windows",
         walled_foam(GradingPtr(std::make_shared<Linear>(0.2, dvec3(0.03, 0, 0.01))),
                     GradingPtr(std::make_shared<Linear>(0.4, dvec3(0, 0.1, 0))))},
        {"foam in a frame", framed_foam(sphere)},
        {"octet lattice", lattice("octet", make_constant_grading(1.9), make_constant_grading(0.12))},
        {"bcc lattice in cells of several sizes",
         lattice("bcc", std::make_shared<Linear>(2, dvec3(0.25, 0, 0.05)),
                 std::make_shared<Linear>(0.15, dvec3(0.01, 0, -0.005)))},
        {"gyroid", gyroid(2.2, 0.3)},
        {"Schwarz P network",
         tpms(TpmsKind::schwarz_p, true, make_constant_grading(1.7), make_constant_grading(0.4))},
        {"Schwarz D sheet",
         tpms(TpmsKind::schwarz_d, false, make_constant_grading(2.7), make_constant_grading(0.2))},
        {"Neovius network",
         tpms(TpmsKind::neovius, true, make_constant_grading(3), make_constant_grading(0.3))},
        {"Neovius sheet",
         tpms(TpmsKind::neovius, false, make_constant_grading(3), make_constant_grading(0.3))},
        {"gyroid sheet of graded thickness", tpms(TpmsKind::gyroid, false, make_constant_grading(2.2), slope),
         true},
        {"Schwarz D network of graded period", tpms(TpmsKind::schwarz_d, true, steep_slope, slope), true},
        {"gyroid in a ball", make_intersection({gyroid(2.2, 0.3), sphere})},
        {"mesh", mesh},
        {"placed elements", placed_elements(std::nullopt)},
        {"upright elements", placed_elements(Interval{-1.2, 1.7})},
        {"grown mesh", make_offset(mesh, 0.35)},
        {"shrunk mesh", make_offset(mesh, -0.35)},
        {"mesh shell", make_intersection({mesh, make_shell(mesh, 0.4)})},
        {"box shell", make_intersection({box, make_shell(box, 0.3)})},
        {"L-shaped mesh shell",
         make_intersection({make_mesh_field(shapes::closed(shapes::l_prism())),
                            make_shell(make_mesh_field(shapes::closed(shapes::l_prism())), 0.4)})},
        {"mesh with a graded shell", make_intersection({mesh, make_shell(mesh, graded, {0, 1})})},
        {"L-shaped mesh with a graded shell",
         make_intersection({make_mesh_field(shapes::closed(shapes::l_prism())),
                            make_shell(make_mesh_field(shapes::closed(shapes::l_prism())), graded, {0, 1})})},
        {"ball with a graded shell", make_intersection({sphere, make_shell(sphere, graded, {0.1, 1})}), true},
        {"filled mesh with a graded skin", make_filled_body(mesh, make_union({cone, torus}), graded, {0, 1})},
        {"ball with Voronoi windows", windowed(sphere, false)},
        {"ball with a picture's windows", pictured(sphere)},
        {"box with hexagonal windows", windowed(box, true)},
        {"mesh with Voronoi windows", windowed(mesh, false)},
        {"filled mesh", make_filled_body(mesh, make_union({cone, torus}), 0.3)},
        {"filled box without a skin", make_filled_body(box, make_union({cone, torus}), 0)},
        {"box without boxes", make_without_boxes(box, plan_of_boxes())},
        {"boxes", make_box_solid(plan_of_boxes())},
        {"outline that grows with height", with_moved_outline(torus, 0.2)},
        {"outline that shrinks with height", with_moved_outline(make_difference(box, cone), -0.15)},
        {"box under an outer skin", make_filled_body(box, torus, 0.3, SkinSide::outside)},
        {"mesh under a centred skin", make_filled_body(mesh, cone, 0.3, SkinSide::centred)},
        {"mesh under a graded outer skin", make_filled_body(mesh, cone, graded, {0, 1}, SkinSide::outside)},
        {"ball under a graded centred skin",
         make_filled_body(sphere, torus, graded, {0.1, 1}, SkinSide::centred), true},
        {"union", make_union({box, cone, torus})},
        {"intersection", make_intersection({sphere, box, cone})},
        {"difference", make_difference(box, torus)},
        {"smooth union", make_smooth_union(make_sphere({-1, 0, 0}, 1.2), make_sphere({1.2, 0.3, 0}, 1), 0.8),
         true},
        {"offset of a cylinder", make_offset(make_cylinder({-1, 0, -1}, {1, 0.5, 1}, 0.8), 0.3), true},
        {"foam joined smoothly to a ball", make_smooth_union(walled_foam(0.15, 0.5), sphere, 0.7), true},
        {"torus less a ball with rounded edges",
         make_smooth_difference(torus, make_sphere({2, 0, 0}, 1), 0.5), true},
        {"turned box", make_transform(box, turn, {0.2, 0.1, -0.1}), true},
        {"formula of a ball", formula("hypot(x-0.3, y+0.2, z-0.1) - 2.5", 3, Metric::exact), true},
        {"formula of a cut torus", formula("hypot(hypot(x, y-0.1) - 2, z) - 0.7", 2.5, Metric::bound), true},
        {"formula of waves",
         formula(
             "max(sin(2.9*x)*cos(2.9*y) + sin(2.9*y)*cos(2.9*z) + sin(2.9*z)*cos(2.9*x), hypot(x,y,z)-2.4)",
             3, Metric::sign),
         true},
        {"formula of a depth", formula("d > 0.4 and d < 1 ? -1 : 1", 3, Metric::sign), true},
        {"formula with undefined parts", formula("z - sqrt(4 - x*x - y*y)", 2.2, Metric::sign), true},
        {"formula with its slope made even",
         make_unit_slope(formula("3*(hypot(x-0.3, y+0.2, z-0.1) - 2.5)", 3, Metric::sign),
                         {dvec3(-3), dvec3(3)}),
         true},
        {"ball for many points", for_many(sphere), true},
        {"grown ball for many points", make_offset(for_many(sphere), 0.4), true},
        {"shell of a ball for many points", make_intersection({sphere, make_shell(for_many(sphere), 0.4)}),
         true},
        {"turned torus for many points", make_transform(for_many(torus), turn, {0.2, 0.1, -0.1}), true},
        {"ball for many points under a graded centred skin",
         make_filled_body(for_many(sphere), torus, graded, {0.1, 1}, SkinSide::centred), true},
        {"ball for many points joined smoothly", make_smooth_union(for_many(sphere), cone, 0.7), true},
        {"waves for many points less a ball with rounded edges",
         make_smooth_difference(
             for_many(formula("sin(2*x)*cos(2*y) + sin(2*y)*cos(2*z) + sin(2*z)*cos(2*x)", 3, Metric::sign)),
             for_many(sphere), 0.5),
         true},
        {"mirrored and stretched union", make_transform(make_union({box, cone}), mirror, {0.3, 0, 0.2})},
    };
}

}  // namespace lamella
