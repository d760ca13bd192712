// Solids with closed-form areas for the tests of back-ends: upright prisms over discs and rectangles.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "engine/layers/backend.h"
#include "engine/layers/layer.h"

namespace lamella::test {

/// A disc (half.x = radius, half.y unused) or a rectangle, centred at `center`, mm.
struct Figure {
    bool disc = false;
    dvec2 center{0};
    dvec2 half{1};

    double distance(dvec2 p) const {
        const dvec2 d = p - center;
        if (disc) return std::sqrt(d.x * d.x + d.y * d.y) - half.x;
        const dvec2 q = glm::max(d - half, -d - half);
        const dvec2 out = glm::max(q, dvec2(0.0));
        return std::sqrt(out.x * out.x + out.y * out.y) + std::min(std::max(q.x, q.y), 0.0);
    }
    /// The part of the line at `across` that lies inside, along `axis`.
    Interval cut(Axis axis, double across) const {
        const double c = axis == Axis::x ? center.x : center.y;
        const double d = across - (axis == Axis::x ? center.y : center.x);
        const double limit = disc || axis == Axis::y ? half.x : half.y;
        if (std::abs(d) >= limit) return {};
        const double length = disc ? std::sqrt(half.x * half.x - d * d) : axis == Axis::x ? half.x : half.y;
        return {c - length, c + length};
    }
    Rect bounds() const {
        const dvec2 size = disc ? dvec2(half.x) : half;
        return {center - size, center + size};
    }
};

inline Figure disc(dvec2 center, double radius) { return {true, center, dvec2(radius)}; }
inline Figure rectangle(dvec2 lo, dvec2 hi) { return {false, (lo + hi) * 0.5, (hi - lo) * 0.5}; }

/// The union of figures less one hole, in one plane.
class FigureSlice : public SliceField {
  public:
    FigureSlice(std::vector<Figure> figures, std::vector<Figure> holes)
        : figures_(std::move(figures)), holes_(std::move(holes)) {}

    void runs(const RowBand& band, Scratch&, RunRows& out) const override {
        out.clear();
        RunRows solid;
        RunRows hollow;
        collect(band, figures_, solid);
        collect(band, holes_, hollow);
        for (std::size_t l = 0; l < solid.lines(); ++l) {
            for (Run run : solid.line(l)) {
                for (const Run hole : hollow.line(l)) {
                    out.push(run.begin, std::min(run.end, hole.begin));
                    run.begin = std::max(run.begin, hole.end);
                }
                out.push(run.begin, run.end);
            }
            out.end_line();
        }
    }
    Interval range(const Rect& r) const override {
        const dvec2 size = r.size() * 0.5;
        const double reach = std::sqrt(size.x * size.x + size.y * size.y);
        const double v = value(r.center());
        return {v - reach, v + reach};
    }
    void sample(const Tile& tile, std::span<float> out) const override {
        for (int j = 0; j < tile.ny; ++j) {
            for (int i = 0; i < tile.nx; ++i) {
                out[static_cast<std::size_t>(j) * static_cast<std::size_t>(tile.nx) +
                    static_cast<std::size_t>(i)] =
                    static_cast<float>(value(tile.origin + tile.step * dvec2(i, j)));
            }
        }
    }
    Rect bounds() const override {
        Rect all;
        for (const Figure& figure : figures_) all = unite(all, figure.bounds());
        return all;
    }
    double value(dvec2 p) const {
        double v = infinity;
        for (const Figure& figure : figures_) v = std::min(v, figure.distance(p));
        for (const Figure& hole : holes_) v = std::max(v, -hole.distance(p));
        return v;
    }

  private:
    static void collect(const RowBand& band, const std::vector<Figure>& figures, RunRows& out) {
        for (int l = 0; l < band.lines(); ++l) {
            std::vector<std::pair<std::int32_t, std::int32_t>> runs;
            for (const Figure& figure : figures) {
                const Interval cut = figure.cut(band.axis, band.line(l));
                if (cut.empty()) continue;
                const auto a = round_run(band.coordinate(cut.lo));
                const auto b = round_run(band.coordinate(cut.hi));
                runs.emplace_back(std::max(std::min(a, b), band.lo * run_unit),
                                  std::min(std::max(a, b), band.hi * run_unit));
            }
            std::sort(runs.begin(), runs.end());
            for (const auto& [begin, end] : runs) out.push(begin, end);
            out.end_line();
        }
    }

    std::vector<Figure> figures_;
    std::vector<Figure> holes_;
};

/// A solid whose cross-section at height z is the union of some figures less others.
class FigureSolid : public Field {
  public:
    using Figures = std::function<std::vector<Figure>(double z)>;
    FigureSolid(Box bounds, Figures figures, Figures holes = {})
        : bounds_(bounds), figures_(std::move(figures)), holes_(std::move(holes)) {}

    double value(dvec3 p) const override { return slice_at(p.z).value({p.x, p.y}); }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<FigureSlice>(slice_at(z));
    }
    Box bounds() const override { return bounds_; }

  private:
    FigureSlice slice_at(double z) const { return {figures_(z), holes_ ? holes_(z) : std::vector<Figure>()}; }
    Box bounds_;
    Figures figures_;
    Figures holes_;
};

inline Job make_job(Box bounds, FigureSolid::Figures figures, double layer_height,
                    FigureSolid::Figures holes = {}) {
    Job job;
    job.name = "figures";
    job.part = std::make_shared<FigureSolid>(bounds, std::move(figures), std::move(holes));
    job.bounds = bounds;
    job.layers = {static_cast<int>(std::lround(bounds.size().z / layer_height)), layer_height};
    job.identity = "0123456789abcdef";
    return job;
}

/// Runs the layers of a range through a back-end, one after the other. Stops before layer `stop` without
/// ending the output when that is below the range's end. Returns the volume, mm^3.
inline double run_layers(const Job& job, Backend& backend, LayerRange range, bool resume = false,
                         int stop = 1 << 30) {
    double volume = 0;
    for (int i = backend.open(job, range, resume); i < range.last; ++i) {
        if (i >= stop) return volume;
        const Layer layer(job, i);
        const auto product = backend.render(layer);
        backend.write(layer, *product);
        volume += product->area * job.layers.height(i);
    }
    backend.finish();
    return volume;
}

/// A folder that is removed with all it holds when the test ends.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        static std::atomic<int> count{0};
        path_ = std::filesystem::temp_directory_path() /
                ("lamella-test-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

}  // namespace lamella::test
