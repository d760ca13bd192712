// Supports of jobs: where they are and are not, what moves them, and when a plan is found again.
#include "recipe/build/build_supports.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/app/commands/supported.h"
#include "tests/engine/runs/plane_runs.h"

namespace build_supports_test {

using namespace lamella;

namespace {

/// What two sets of runs of a line share, in run units.
std::int64_t shared(std::span<const Run> a, std::span<const Run> b) {
    std::int64_t sum = 0;
    for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
        sum += std::max(0, std::min(a[i].end, b[k].end) - std::max(a[i].begin, b[k].begin));
        a[i].end < b[k].end ? ++i : ++k;
    }
    return sum;
}

/// Layers of part and supports beyond the job's own, and rows beyond its bounds.
struct Walk {
    double part = 0, supports = 0;  ///< volumes, mm^3
    std::int64_t both = 0;          ///< run units that are part and support at once
    std::size_t outside = 0;        ///< lines with a run beyond the bounds
    std::size_t below = 0;          ///< lines with a run under the bed
};

Walk walk(const Job& job) {
    Walk found;
    const RowBand band = band_over(grown(job.bounds, 3), 0.2);
    const double volume = band.along_pitch * band.across_pitch * job.layers.height(0) / run_unit;
    // Run ends are rounded to a unit.
    const double lo = band.coordinate(job.bounds.lo.x) - 1, hi = band.coordinate(job.bounds.hi.x) + 1;
    for (int layer = -8; layer < job.layers.count() + 4; ++layer) {
        const RunRows part = runs_at(*job.part, job.plane(layer), band);
        const RunRows supports = runs_at(*job.supports, job.plane(layer), band);
        found.part += static_cast<double>(part.total_length()) * volume;
        found.supports += static_cast<double>(supports.total_length()) * volume;
        for (std::size_t l = 0; l < part.lines(); ++l) {
            found.both += shared(part.line(l), supports.line(l));
            const double across = band.line(static_cast<int>(l));
            for (const RunRows* rows : {&part, &supports}) {
                const auto runs = rows->line(l);
                if (runs.empty()) continue;
                found.below += layer < 0;
                found.outside += runs.front().begin < lo || runs.back().end > hi ||
                                 across < job.bounds.lo.y || across > job.bounds.hi.y ||
                                 layer >= job.layers.count();
            }
        }
    }
    return found;
}

void check_apart(const Job& job) {
    REQUIRE(job.supports);
    const Walk found = walk(job);
    CHECK(found.supports > 1);
    CHECK(found.part > 1);
    CHECK(found.both == 0);
    CHECK(found.outside == 0);
    CHECK(found.below == 0);
}

bool is_held(const Scaffold& scaffold, std::size_t point) {
    return std::find(scaffold.unheld.begin(), scaffold.unheld.end(), point) == scaffold.unheld.end();
}

/// Distance from a point to the nearest end of a connector.
double to_tip(const Scaffold& scaffold, dvec3 at) {
    double nearest = 1e9;
    for (const Beam& c : scaffold.connectors)
        nearest = std::min({nearest, glm::distance(c.a, at), glm::distance(c.b, at)});
    return nearest;
}

/// Every held point has a tip, and lies where the part begins, right to `slack` in height: solid above.
void check_tips(const Supported& s, double slack) {
    REQUIRE_FALSE(s.points().empty());
    for (std::size_t i = 0; i < s.points().size(); ++i) {
        const dvec3 at = s.points()[i].at;
        INFO("point " << i << " at " << at.x << " " << at.y << " " << at.z);
        if (is_held(s.scaffold(), i)) CHECK(to_tip(s.scaffold(), at) <= s.scaffold().shape.tip);
        CHECK(s.job().part->value(at + dvec3(0, 0, slack)) < 0);
    }
}

bool same_plan(const SupportPlan& a, const SupportPlan& b) {
    const Scaffold &s = a.scaffold, &t = b.scaffold;
    return s.points == t.points && a.survey.points == b.survey.points && s.unheld == t.unheld &&
           s.bars == t.bars && s.pillars == t.pillars && s.connectors == t.connectors &&
           a.survey.hanging_length == b.survey.hanging_length &&
           a.survey.own_bridges == b.survey.own_bridges && a.survey.blocked == b.survey.blocked &&
           a.survey.topples_at == b.survey.topples_at;
}

/// Whether the parts of two jobs have the same runs on layers `shift` apart.
bool same_part(const Job& a, const Job& b, int shift = 0) {
    const RowBand band = band_over(grown(a.bounds, 1), 0.2);
    for (int layer = 0; layer < a.layers.count(); ++layer) {
        const RunRows one = runs_at(*a.part, a.plane(layer), band);
        const RunRows two = runs_at(*b.part, b.plane(layer + shift), band);
        if (!std::equal(one.runs().begin(), one.runs().end(), two.runs().begin(), two.runs().end()))
            return false;
    }
    return true;
}

}  // namespace

TEST_CASE("a job without [support] has no supports and is not changed") {
    const Supported s = supported(ball + filament);
    CHECK_FALSE(s.supports.has_value());
    CHECK_FALSE(s.job().supports);
    CHECK(s.job().layers.count() == 80);
    CHECK(s.job().bounds.lo == dvec3(-8));
    CHECK_FALSE(supported(ball + filament + "[support]\nkind = \"none\"\ntip = 0.5\n").supports.has_value());
}

TEST_CASE("what stands on the bed by itself gets no supports") {
    const Supported s = supported("[part]\nshape = \"box\"\nsize = [10, 10, 5]\n" + filament + "[support]\n");
    REQUIRE(s.supports.has_value());
    CHECK(s.points().empty());
    CHECK_FALSE(s.job().supports);
    CHECK(s.job().bounds.hi == dvec3(5, 5, 2.5));
    CHECK(supports_text(*s.supports) == "nothing needs support\n");
}

TEST_CASE("supports hold a part without reaching into it, under the bed or beyond the job's bounds") {
    const BoxPart table_part(table());
    for (const std::string& part : {table_part.recipe(), ball, koala}) {
        for (const std::string kind : {"bridges", "pillars"}) {
            INFO(part << kind);
            const Supported s =
                supported(fmt::format("{}{}[support]\nkind = \"{}\"\n", part, filament, kind));
            REQUIRE(s.supports.has_value());
            check_apart(s.job());
            check_tips(s, 0.21);
            CHECK(s.scaffold().bars.empty() == (kind == "pillars" || part == ball));
            CHECK(mentions(supports_text(*s.supports), std::to_string(s.points().size()) + " points on "));
        }
    }
}

TEST_CASE("the corners of a table's top are held") {
    const BoxPart part(table());
    const Supported s = supported(part.recipe() + filament + "[support]\n");
    CHECK(s.scaffold().unheld.empty());
    for (const SupportPoint& point : s.points()) {
        CHECK(point.at.z == Approx(10));
        CHECK(std::max(std::abs(point.at.x), std::abs(point.at.y)) > 2.5);
    }
    for (const dvec3 corner :
         {dvec3(-10, -10, 10), dvec3(10, -10, 10), dvec3(-10, 10, 10), dvec3(10, 10, 10)}) {
        CHECK(std::any_of(s.points().begin(), s.points().end(),
                          [&](const SupportPoint& p) { return glm::distance(p.at, corner) < 3; }));
    }
}

TEST_CASE("a lift raises the part by whole layers, cut as before, on supports alone") {
    const BoxPart part(table());
    const Supported flat = supported(part.recipe() + filament + "[support]\n");
    const Supported lifted = supported(part.recipe() + filament + "[support]\nlift = 3.1\n");
    CHECK(lifted.job().layers.count() == flat.job().layers.count() + 16);
    CHECK(lifted.job().bounds.lo.z == Approx(-3.2));
    CHECK(lifted.job().bounds.hi.z == Approx(12));
    for (int i = 0; i < flat.job().layers.count(); ++i)
        CHECK(lifted.job().plane(i + 16) == Approx(flat.job().plane(i)).margin(1e-9));
    CHECK(same_part(flat.job(), lifted.job(), 16));
    check_apart(lifted.job());
    check_tips(lifted, 0.21);
    // The column's foot hangs now, and is held.
    const RowBand band = band_over(grown(lifted.job().bounds, 1), 0.2);
    for (int i = 0; i < 16; ++i) {
        CHECK(runs_at(*lifted.job().part, lifted.job().plane(i), band).runs().empty());
        CHECK_FALSE(runs_at(*lifted.job().supports, lifted.job().plane(i), band).runs().empty());
    }
    CHECK(std::any_of(lifted.points().begin(), lifted.points().end(),
                      [](const SupportPoint& p) { return std::abs(p.at.z) < 1e-6; }));
    for (const ScaffoldPillar& pillar : lifted.scaffold().pillars) {
        if (pillar.foot > 0) CHECK(pillar.bottom == Approx(-3.2));
    }
}

TEST_CASE("blockers take support points away and change nothing else") {
    const BoxPart part(table());
    const std::string recipe = part.recipe() + filament + "[support]\n";
    const Box right{{0, -20, -5}, {20, 20, 20}};
    const Supported all = supported(recipe), left = supported(recipe + box_region("blocker", right));
    const auto in_right = [](const SupportPoint& p) { return p.at.x > 0; };
    CHECK(std::any_of(all.points().begin(), all.points().end(), in_right));
    CHECK(std::none_of(left.points().begin(), left.points().end(), in_right));
    CHECK_FALSE(left.points().empty());
    CHECK(left.supports->plan.survey.blocked > 0);
    CHECK(mentions(supports_text(*left.supports),
                   std::to_string(left.supports->plan.survey.blocked) + " point"));
    CHECK(same_part(all.job(), left.job()));
    CHECK(left.built.regions.warnings.empty());
}

TEST_CASE("enforcers add support points where the part would do without") {
    // A step of 0.2 mm, less than half a line: it holds itself.
    const BoxPart part({{{-5, -5, 0}, {5, 5, 4}}, {{-5.2, -5.2, 4}, {5.2, 5.2, 8}}});
    const std::string recipe = part.recipe() + filament + "[support]\n";
    const Supported none = supported(recipe);
    CHECK(none.points().empty());
    const Supported some = supported(recipe + box_region("enforcer", {{0, -20, 3}, {20, 20, 5}}));
    CHECK_FALSE(some.points().empty());
    for (const SupportPoint& p : some.points()) {
        CHECK(p.at.x >= 0);
        CHECK(p.at.z == Approx(4));
    }
    CHECK(same_part(none.job(), some.job()));
}

TEST_CASE("regions that rule supports need supports") {
    for (const std::string make : {"blocker", "enforcer"}) {
        const std::string unheld =
            fmt::format("{}{}{}", ball, filament, box_region(make, {{-1, -1, -1}, {1, 1, 1}}));
        CHECK(mentions(complaint_about(unheld),
                       ".make: blockers and enforcers need supports, and there are none; accepted: a section "
                       "[support] as well"));
        CHECK(complaint_about(unheld + "[support]\n").empty());
    }
}

TEST_CASE("foam under a closed skin is held where the solid part is") {
    const BoxPart part(table());
    for (const std::string& body : {part.recipe(), koala}) {
        const Supported solid = supported(body + filament + "[support]\n");
        const Supported foam =
            supported(body + filament + "[support]\n[foam]\ncell = 4\nbeam = 0.4\n[skin]\nthickness = 0.8\n");
        CHECK(foam.points() == solid.points());
        CHECK(foam.scaffold().connectors == solid.scaffold().connectors);
        CHECK_FALSE(same_part(solid.job(), foam.job()));
        check_apart(foam.job());
    }
}

TEST_CASE("supports keep out of a closed part's inside") {
    const Supported s = supported(ball + filament + "[support]\n[skin]\nthickness = 0.8\n");
    REQUIRE(s.job().supports);
    for (const SupportPoint& p : s.points()) CHECK(glm::length(p.at) > 7.5);
    for (int i = 0; i < 20000; ++i) {
        const dvec3 p(std::fmod(i * 0.754877, 14.0) - 7, std::fmod(i * 0.569840, 14.0) - 7,
                      std::fmod(i * 0.430159, 14.0) - 7);
        if (glm::length(p) < 7.9) CHECK_FALSE(s.job().supports->value(p) < 0);
    }
}

TEST_CASE("bare foam is held within a millimetre of its body's surface") {
    const Supported s = supported(ball + filament + "[support]\n[foam]\ncell = 4\nbeam = 0.5\n");
    REQUIRE(s.points().size() > 5);
    CHECK(s.supports->plan.survey.blocked > 0);
    for (const SupportPoint& p : s.points()) {
        CHECK(glm::length(p.at) > 7 - 1e-6);
        CHECK(glm::length(p.at) < 8.2);
    }
    check_apart(s.job());
}

TEST_CASE("depths are millimetres also where a formula's values are none") {
    const Supported s = supported(
        "[part]\nfield = \"f\"\n[[field]]\nname = \"f\"\nformula = \"x*x + y*y + z*z - 36\"\n"
        "bounds = [[-6.1, -6.1, -6.1], [6.1, 6.1, 6.1]]\n[foam]\ncell = 4\nbeam = 0.5\n"
        "[layers]\nheight = 0.4\n[printer]\nprofile = \"marlin\"\n[support]\n");
    CHECK(s.supports->plan.survey.blocked > 0);
    double deepest = 6;
    for (const SupportPoint& p : s.points()) deepest = std::min(deepest, glm::length(p.at));
    CHECK(deepest > 4.9);
    CHECK(deepest < 5.5);
}

TEST_CASE("supports fit the part as it is scaled for the machine") {
    const BoxPart part(table());
    const Supported s =
        supported(part.recipe() + filament + "[support]\n[process]\nscale = [1.2, 0.9, 1.25]\n");
    check_apart(s.job());
    check_tips(s, 0.21);
    // The top's lower side is printed at 12.5 mm, 24 x 18 mm wide; layers are 0.2 mm.
    for (const SupportPoint& p : s.points()) {
        CHECK(std::abs(p.at.z - 12.5) <= 0.1 + 1e-9);
        CHECK(std::abs(p.at.x) <= 12);
        CHECK(std::abs(p.at.y) <= 9);
    }
    CHECK(std::any_of(s.points().begin(), s.points().end(),
                      [](const SupportPoint& p) { return std::abs(p.at.x) > 10.5; }));
}

TEST_CASE("supports end where outlines that are moved begin") {
    const BoxPart part(table());
    for (const std::string moved : {"0.3", "-0.3"}) {
        INFO(moved);
        const Supported s =
            supported(fmt::format("{}{}[support]\n[process]\nxy_compensation = {}\nelephant_foot = 0.2\n",
                                  part.recipe(), filament, moved));
        check_apart(s.job());
        // Before that, they keep out of the part as designed.
        const Job& designed = s.built.designed;
        const RowBand band = band_over(grown(s.job().bounds, 1), 0.2);
        std::int64_t both = 0, before = 0, after = 0;
        for (int i = 0; i < designed.layers.count(); ++i) {
            const RunRows solid = runs_at(*designed.part, s.job().plane(i), band);
            const RunRows shown = runs_at(*s.supports->before_offsets, s.job().plane(i), band);
            for (std::size_t l = 0; l < solid.lines(); ++l) both += shared(solid.line(l), shown.line(l));
            before += shown.total_length();
            after += runs_at(*s.job().supports, s.job().plane(i), band).total_length();
        }
        CHECK(both == 0);
        CHECK((moved == "0.3" ? before > after : before <= after));
    }
}

TEST_CASE("on thin layers points lie where the part begins, right to a layer") {
    // Teeth under a plate, their lower ends at every height that four layers taken at once can miss.
    std::vector<Box> boxes{{{-2, -2, 0}, {2, 2, 9}}, {{-2, -2, 8}, {30, 2, 9}}};
    std::vector<double> ends;
    for (int k = 0; k < 6; ++k) {
        ends.push_back(4 + 0.05 * k);
        boxes.push_back({{5 + 4 * k, -1, ends.back()}, {6 + 4 * k, 1, 8.5}});
    }
    const BoxPart part(boxes);
    const Supported s = supported(part.recipe() + resin + "[support]\n");
    check_tips(s, 0.051);
    for (std::size_t k = 0; k < ends.size(); ++k) {
        const double x = 5.5 + 4 * static_cast<double>(k);
        const auto tooth = [&](const SupportPoint& p) {
            return std::abs(p.at.x - x) <= 0.5 && p.reason == SupportReason::island;
        };
        const auto point = std::find_if(s.points().begin(), s.points().end(), tooth);
        INFO("tooth that ends at " << ends[k]);
        REQUIRE(point != s.points().end());
        CHECK(point->at.z == Approx(ends[k]).margin(0.0501));
    }
    for (const SupportPoint& p : s.points()) CHECK_FALSE(s.job().part->value(p.at - dvec3(0, 0, 0.0501)) < 0);
    check_apart(s.job());
}

TEST_CASE("points on a thin-layered ball lie on it") {
    const Supported s = supported(ball + resin + "[support]\n");
    REQUIRE_FALSE(s.points().empty());
    for (const SupportPoint& p : s.points()) {
        const double below = std::sqrt(std::max(0.0, 64 - p.at.x * p.at.x - p.at.y * p.at.y));
        INFO(p.at.x << " " << p.at.y << " " << p.at.z);
        CHECK(std::abs(p.at.z + below) <= 0.0501);
    }
    check_apart(s.job());
}

TEST_CASE("a plan that is found again makes feet and bars as high as it did at first") {
    const Folder plans, parts;
    write(parts / "part.obj", boxes_obj(table()));
    // Feet of 0.2 mm take one layer of 0.3 mm, whose whole height they have.
    const std::string text = mesh_recipe(parts / "part.obj") +
                             "[layers]\nheight = 0.3\n[printer]\nprofile = \"marlin\"\n[support]\n";
    const Supported first = supported(text, plans.path()), again = supported(text, plans.path());
    REQUIRE(again.supports->was_planned);
    CHECK(first.supports->plan.scaffold.shape.foot_height == Approx(0.3));
    CHECK(again.supports->plan.scaffold.shape == first.supports->plan.scaffold.shape);
}

TEST_CASE("a plan is found again by the same job alone") {
    const Folder plans, parts;
    const auto recipe = [&](const std::vector<Box>& boxes) {
        write(parts / "part.obj", boxes_obj(boxes));
        return mesh_recipe(parts / "part.obj") + filament;
    };
    const Supported first = supported(recipe(table()) + "[support]\n", plans.path());
    CHECK_FALSE(first.supports->was_planned);
    CHECK(tree(plans.path()).size() == 1);
    const Supported again = supported(recipe(table()) + "[support]\n", plans.path());
    CHECK(again.supports->was_planned);
    CHECK(same_plan(again.supports->plan, first.supports->plan));
    CHECK(mentions(supports_text(*again.supports), ", as planned before\n"));
    CHECK(again.job().bounds.lo == first.job().bounds.lo);
    CHECK(again.job().bounds.hi == first.job().bounds.hi);
    const RowBand band = band_over(grown(first.job().bounds, 1), 0.2);
    for (int i = 0; i < first.job().layers.count(); ++i) {
        const RunRows a = runs_at(*first.job().supports, first.job().plane(i), band);
        const RunRows b = runs_at(*again.job().supports, again.job().plane(i), band);
        CHECK(std::equal(a.runs().begin(), a.runs().end(), b.runs().begin(), b.runs().end()));
    }

    std::vector<Box> larger = table();
    larger[1].hi.x = 11;
    std::set<std::string> known;
    const auto is_new = [&](const std::string& text) {
        const auto before = tree(plans.path()).size();
        const bool fresh = !supported(text, plans.path()).supports->was_planned;
        return fresh && tree(plans.path()).size() == before + 1;
    };
    CHECK(is_new(recipe(table()) + "[support]\nspacing = 2.5\n"));
    CHECK(is_new(recipe(table()) + "line_width = 0.5\n[support]\n"));
    CHECK(is_new(recipe(table()) + "[support]\nkind = \"pillars\"\n"));
    CHECK(is_new(recipe(table()) + "[support]\nlift = 3\n"));
    CHECK(is_new(recipe(table()) + "[support]\n" + box_region("blocker", {{5, 5, 5}, {15, 15, 15}})));
    CHECK(is_new(recipe(table()) + "[support]\n[process]\nscale = [1, 1, 1.1]\n"));
    CHECK(is_new(recipe(larger) + "[support]\n"));
    CHECK(is_new(mesh_recipe(parts / "part.obj") + resin + "[support]\n"));
    // What says only how supports are printed leaves them where they are.
    CHECK(supported(recipe(table()) + "[support]\n", plans.path()).supports->was_planned);
}

TEST_CASE("a damaged plan is made again") {
    const Folder plans;
    const std::string text = ball + filament + "[support]\n";
    const Supported first = supported(text, plans.path());
    const std::string file = (plans.path() / tree(plans.path()).begin()->first).string();
    const std::string kept = contents(file);
    write(file, kept.substr(0, kept.size() / 2));
    const Supported again = supported(text, plans.path());
    CHECK_FALSE(again.supports->was_planned);
    CHECK(same_plan(again.supports->plan, first.supports->plan));
    CHECK(contents(file) == kept);
}

TEST_CASE("one thread plans what four do") {
    const BoxPart part(table());
    for (const std::string& text : {part.recipe() + filament, koala + filament,
                                    ball + filament + "[foam]\ncell = 4\nbeam = 0.5\n", ball + resin}) {
        const Supported one = supported(text + "[support]\n", {}, 1),
                        four = supported(text + "[support]\n", {}, 4);
        CHECK(same_plan(one.supports->plan, four.supports->plan));
    }
}

}  // namespace build_supports_test
