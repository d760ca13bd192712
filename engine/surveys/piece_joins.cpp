// Join survey: pieces as sparse points, a spanning tree between them, and the shortest connection at each of
// its edges.
#include "engine/surveys/piece_joins.h"

#include <algorithm>
#include <array>
#include <map>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "engine/layers/survey_rows.h"
#include "engine/runs/run_components.h"
#include "engine/surveys/island_survey.h"

namespace lamella {
namespace {

constexpr double cells_in_diagonal = 64;

using Cell = std::array<int, 3>;

struct PiecePoint {
    dvec3 at;
    std::uint32_t piece;
};

/// Sparse points of all pieces: the first point of each piece in each cell of a cubic grid.
class ThinnedPoints {
  public:
    ThinnedPoints(const Box& bounds, double cell)
        : origin_(bounds.lo), cell_(cell), max_rings_(static_cast<int>(cells_in_diagonal) + 2) {}

    double cell() const { return cell_; }
    std::size_t size() const { return points_.size(); }
    void add(dvec3 at, std::uint32_t piece) { points_.try_emplace({cell_of(at), piece}, at); }
    /// Gives pieces their final numbers. Of several points of one piece in a cell, one is kept.
    template <typename Find>
    void rename(Find find) {
        std::map<Key, dvec3> renamed;
        for (const auto& [key, at] : points_) renamed.try_emplace({key.first, find(key.second)}, at);
        points_.swap(renamed);
    }
    template <typename Visit>
    void visit(Visit visit) const {
        for (const auto& [key, at] : points_) visit(PiecePoint{at, key.second});
    }
    /// Returns the wanted point nearest to `from`, if its squared distance is below `best`, and lowers `best`
    /// to it; null otherwise.
    template <typename Wanted>
    const dvec3* nearest(dvec3 from, Wanted wanted, double& best, std::uint32_t& piece) const {
        const dvec3* found = nullptr;
        const Cell middle = cell_of(from);
        for (int ring = 0; ring <= max_rings_; ++ring) {
            const double away = (ring - 1) * cell_;  // lower bound of the distance of the ring's points
            if (ring > 0 && away > 0 && away * away >= best) break;
            visit_ring(middle, ring, [&](const Key& key, const dvec3& at) {
                const double d = squared_length(at - from);
                if (d >= best || !wanted(key.second)) return;
                best = d;
                piece = key.second;
                found = &at;
            });
        }
        return found;
    }

  private:
    using Key = std::pair<Cell, std::uint32_t>;
    Cell cell_of(dvec3 p) const {
        const dvec3 c = glm::floor((p - origin_) / cell_);
        return {static_cast<int>(c.x), static_cast<int>(c.y), static_cast<int>(c.z)};
    }
    /// Visits the points in the shell of cells at distance `ring` from the middle cell.
    template <typename Visit>
    void visit_ring(Cell middle, int ring, Visit visit) const {
        for (int x = middle[0] - ring; x <= middle[0] + ring; ++x) {
            for (int y = middle[1] - ring; y <= middle[1] + ring; ++y) {
                const bool side = std::abs(x - middle[0]) == ring || std::abs(y - middle[1]) == ring;
                for (int z = middle[2] - ring; z <= middle[2] + ring; z += side || ring == 0 ? 1 : 2 * ring) {
                    for (auto p = points_.lower_bound({Cell{x, y, z}, 0});
                         p != points_.end() && p->first.first == Cell{x, y, z}; ++p)
                        visit(p->first, p->second);
                }
            }
        }
    }

    dvec3 origin_;
    double cell_;
    int max_rings_;
    std::map<Key, dvec3> points_;
};

/// An edge of the tree, and the runs around its ends.
struct Edge {
    PiecePoint a, b;
    std::vector<PlacedRun> runs_a, runs_b;
};

/// Returns Boruvka's spanning tree over the pieces, by the distances of their points. In every round each set
/// except the largest is joined to the nearest other set.
std::vector<Edge> spanning_tree(const ThinnedPoints& points, const std::vector<std::uint32_t>& pieces,
                                std::uint32_t largest) {
    const auto place_of = [&](std::uint32_t piece) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(pieces, piece) - pieces.begin());
    };
    DisjointSets sets(pieces.size());
    std::vector<Edge> edges;
    while (edges.size() + 1 < pieces.size()) {
        struct WayOut {
            double length = infinity;
            PiecePoint from, to;
        };
        std::map<std::uint32_t, WayOut> ways;
        const std::uint32_t large = sets.find(place_of(largest));
        points.visit([&](const PiecePoint& from) {
            const std::uint32_t set = sets.find(place_of(from.piece));
            if (set == large) return;
            WayOut& way = ways[set];
            std::uint32_t piece = 0;
            const dvec3* to = points.nearest(
                from.at, [&](std::uint32_t other) { return sets.find(place_of(other)) != set; }, way.length,
                piece);
            if (to != nullptr) {
                way.from = from;
                way.to = {*to, piece};
            }
        });
        for (const auto& [set, way] : ways) {
            if (way.length < infinity && sets.join(place_of(way.from.piece), place_of(way.to.piece)))
                edges.push_back({way.from, way.to, {}, {}});
        }
        if (ways.empty()) break;
    }
    return edges;
}

struct LabelledRows : LayerProduct {
    RunRows rows;
    LabelledLayer labelled;
};

/// The common part of both passes: rows, and the numbers of their pieces.
class PieceSurveyor : public LayerPass {
  public:
    PieceSurveyor(const Job& job, double pitch)
        : band_(rows_over({dvec2(job.bounds.lo), dvec2(job.bounds.hi)}, pitch)),
          z0_(job.z0()),
          height_(job.layers.least_height()),
          components_(Growth{}, 0) {}

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<LabelledRows>();
        Scratch scratch;
        product->rows = all_rows(layer.part(), band_, scratch);
        product->labelled = label_layer(product->rows, layer.index(), Growth{});
        return product;
    }
    void write(const Layer& layer, LayerProduct& product) override {
        auto& rows = static_cast<LabelledRows&>(product);
        begin_layer(layer.z());
        const std::vector<std::uint32_t> owners = rows.labelled.owners;
        const auto numbers = components_.add(std::move(rows.labelled), layer.index());
        std::size_t i = 0;
        for (std::size_t l = 0; l < rows.rows.lines(); ++l) {
            for (const Run& run : rows.rows.line(l)) {
                const PlacedRun placed{layer.index(), static_cast<std::int32_t>(l), run.begin, run.end};
                visit(placed, numbers[owners[i++]]);
            }
        }
    }

    RunComponents& components() { return components_; }
    double plane(int layer) const { return z0_ + (layer + 0.5) * height_; }
    dvec3 place(std::int32_t u, const PlacedRun& run) const {
        return {band_.along(u), band_.line(run.row), plane(run.layer)};
    }

  protected:
    virtual void begin_layer(double /*z*/) {}
    virtual void visit(const PlacedRun& run, std::uint32_t number) = 0;

    RowBand band_;
    double z0_, height_;
    RunComponents components_;
};

/// The first pass: collects points of every piece.
class PointSurveyor : public PieceSurveyor {
  public:
    PointSurveyor(const Job& job, double pitch, double cell)
        : PieceSurveyor(job, pitch), points(job.bounds, cell), step_(cell) {}
    ThinnedPoints points;

  protected:
    void visit(const PlacedRun& run, std::uint32_t number) override {
        const double length = band_.along(run.end) - band_.along(run.begin);
        const int count = 1 + static_cast<int>(std::ceil(length / step_));
        for (int k = 0; k < count; ++k) {
            const double u = run.begin + (static_cast<double>(run.end) - run.begin) * k / (count - 1.0);
            points.add(place(round_run(u), run), number);
        }
    }

  private:
    double step_;
};

/// The second pass: collects the runs around the ends of edges.
class EdgeSurveyor : public PieceSurveyor {
  public:
    EdgeSurveyor(const Job& job, double pitch, std::vector<Edge>& edges, double reach, RunComponents& known)
        : PieceSurveyor(job, pitch), edges_(edges), reach_(reach), known_(known) {}

  protected:
    void begin_layer(double z) override {
        ends_.clear();
        const auto add = [&](const PiecePoint& end, std::vector<PlacedRun>& runs) {
            if (std::abs(end.at.z - z) <= reach_) ends_[end.piece].push_back({end.at, &runs});
        };
        for (Edge& edge : edges_) {
            add(edge.a, edge.runs_a);
            add(edge.b, edge.runs_b);
        }
    }
    void visit(const PlacedRun& run, std::uint32_t number) override {
        const auto found = ends_.find(known_.find(number));
        if (found == ends_.end()) return;
        const dvec3 from = place(run.begin, run), to = place(run.end, run);
        for (const End& end : found->second) {
            if (is_near(from, to, end.at)) end.runs->push_back(run);
        }
    }

  private:
    /// An end of an edge, and the list for the runs around it.
    struct End {
        dvec3 at;
        std::vector<PlacedRun>* runs;
    };
    bool is_near(dvec3 from, dvec3 to, dvec3 p) const {
        const double x = std::min(std::max(p.x, from.x), to.x);
        return squared_length(dvec3(x, from.y, from.z) - p) <= reach_ * reach_;
    }
    std::vector<Edge>& edges_;
    double reach_;
    RunComponents& known_;
    std::map<std::uint32_t, std::vector<End>> ends_;  // ends within reach of the current layer, by piece
};

/// Returns the shortest connection between two sets of runs.
PieceJoin shortest_way(const Edge& edge, const PieceSurveyor& surveyor) {
    PieceJoin best{edge.a.at, edge.b.at};
    double least = squared_length(best.b - best.a);
    for (const PlacedRun& p : edge.runs_a) {
        const dvec3 a0 = surveyor.place(p.begin, p), a1 = surveyor.place(p.end, p);
        for (const PlacedRun& q : edge.runs_b) {
            const dvec3 b0 = surveyor.place(q.begin, q), b1 = surveyor.place(q.end, q);
            const double gap = std::max({b0.x - a1.x, a0.x - b1.x, 0.0}), dy = b0.y - a0.y, dz = b0.z - a0.z;
            const double d = gap * gap + dy * dy + dz * dz;
            if (d >= least) continue;
            least = d;
            // Runs side by side are connected in the middle of their overlap.
            const double lo = std::max(a0.x, b0.x), hi = std::min(a1.x, b1.x), middle = 0.5 * (lo + hi);
            const bool overlap = lo <= hi;
            best.a = {overlap ? middle : (a1.x < b0.x ? a1.x : a0.x), a0.y, a0.z};
            best.b = {overlap ? middle : (a1.x < b0.x ? b0.x : b1.x), b0.y, b0.z};
        }
    }
    return best;
}

void check(const Job& job, const JoinSurveyOptions& options) {
    const Interval suited = survey_pitch_range(job);
    if (options.pitch > 0 && suited.contains(options.pitch)) return;
    throw InputError("join survey: the pitch does not suit the part; accepted: " +
                     format_number(suited.lo, 9) + " to " + format_number(suited.hi, 9) + " mm");
}

}  // namespace

JoinSurvey survey_joins(const Job& given, const JoinSurveyOptions& options) {
    const Job job = in_equal_layers(given);
    check(job, options);
    const dvec3 size = job.bounds.size();
    const double cell = std::max(std::sqrt(squared_length(size)) / cells_in_diagonal, 2 * options.pitch);
    PointSurveyor first(job, options.pitch, cell);
    survey_layers(job, first, options);
    RunComponents& components = first.components();
    const std::vector<std::uint32_t> pieces = components.numbers();
    JoinSurvey survey;
    survey.pieces = pieces.size();
    if (pieces.size() < 2) return survey;
    if (pieces.size() > options.max_pieces) {
        throw InputError("the part falls into " + std::to_string(pieces.size()) +
                         " pieces, too many to be joined; accepted: " + std::to_string(options.max_pieces) +
                         " at most, drop islands first");
    }
    first.points.rename([&](std::uint32_t number) { return components.find(number); });
    const std::uint32_t largest = *std::ranges::max_element(
        pieces, {}, [&](std::uint32_t number) { return components.component(number).extent.length; });
    std::vector<Edge> edges = spanning_tree(first.points, pieces, largest);
    EdgeSurveyor second(job, options.pitch, edges, 2 * cell, components);
    survey_layers(job, second, {options.threads, {}, options.cancel});
    for (const Edge& edge : edges) survey.joins.push_back(shortest_way(edge, second));
    return survey;
}

}  // namespace lamella
