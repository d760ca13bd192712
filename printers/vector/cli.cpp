// Writes the header, and polylines as text or as binary numbers.
#include "printers/vector/cli.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/grid_polygon.h"
#include "printers/archive/unfinished_file.h"
#include "printers/archive/zip_records.h"

namespace lamella {
namespace {

constexpr int part_id = 1, support_id = 2;
constexpr std::uint64_t layer_command = 127, polyline_command = 130;
constexpr double max_units = 1e9;  // largest coordinate

/// Returns the text reduced to printable ASCII, without the characters that separate fields and begin
/// commands.
std::string label_text(const std::string& name) {
    constexpr std::size_t longest = 80;
    constexpr std::string_view special = ",/$";
    std::string text;
    for (const char c : name.substr(0, longest))
        text += ' ' <= c && c <= '~' && special.find(c) == std::string_view::npos ? c : '_';
    return text;
}

/// Returns the number of decimals of a unit that keeps the grid's precision.
int decimals_for(double units) {
    constexpr int most = 9;
    int decimals = 0;
    for (double step = units; step > 1.001 / grid_units_per_mm && decimals < most; step /= 10) ++decimals;
    return decimals;
}

/// Writes layers as commands, in ASCII or binary.
class CliText {
  public:
    CliText(bool binary, double units)
        : binary_(binary),
          units_(units),
          units_per_grid_(1 / grid_units_per_mm / units),
          decimals_(decimals_for(units)) {}

    void layer(double z) {
        if (binary_) {
            put_little(text_, layer_command, 2);
            put_float(z / units_);
            return;
        }
        text_ += "$$LAYER/";
        append_number(text_, z / units_, std::min(decimals_ + 2, 9));  // layer heights need more decimals
        text_ += '\n';
    }

    void polyline(int id, const GridPolygon& polygon) {
        const std::size_t count = polygon.points.size() + 1;
        const int direction = polygon.hole ? 0 : 1;
        if (binary_) {
            put_little(text_, polyline_command, 2);
            put_little(text_, static_cast<std::uint64_t>(id), 4);
            put_little(text_, static_cast<std::uint64_t>(direction), 4);
            put_little(text_, count, 4);
        } else {
            text_ += fmt::format("$$POLYLINE/{},{},{}", id, direction, count);
        }
        for (std::size_t i = 0; i < count; ++i) {
            for (const std::int64_t c : polygon.points[i % polygon.points.size()])
                coordinate(static_cast<double>(c) * units_per_grid_);
        }
        if (!binary_) text_ += '\n';
    }

    std::string take() { return std::move(text_); }

  private:
    void coordinate(double units) {
        if (binary_) return put_float(units);
        text_ += ',';
        append_number(text_, units, decimals_);
    }
    void put_float(double v) { put_little(text_, std::bit_cast<std::uint32_t>(static_cast<float>(v)), 4); }

    bool binary_;
    double units_;
    double units_per_grid_;
    int decimals_;
    std::string text_;
};

struct CliProduct : LayerProduct {
    void serialize(Archive& parcel) override { parcel(commands); }

    std::string commands;
};

class Cli : public Backend {
  public:
    Cli(const PrinterProfile& profile, const std::string& path, bool force)
        : vector_(profile.vector), cli_(profile.exchange), output_(path, force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        check(job);
        const std::string settings =
            fmt::format("cli binary={} units={} empty_layer={} tolerance={}", binary(), cli_.cli_units,
                        cli_.cli_empty_layer, vector_.tolerance);
        const int next = output_.begin({job.identity, settings, range}, resume);
        if (!output_.resumed()) output_.commit(start(job, range), next);
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<CliProduct>();
        CliText text(binary(), cli_.cli_units);
        text.layer(layer.top());
        const std::vector<Contour> part = layer.contours(vector_.tolerance);
        const std::vector<Contour> supports = layer.support_contours(vector_.tolerance);
        for (const GridPolygon& polygon : on_grid(part)) text.polyline(part_id, polygon);
        for (const GridPolygon& polygon : on_grid(supports)) text.polyline(support_id, polygon);
        product->area = total_area(part);
        product->support_area = total_area(supports);
        product->commands = text.take();
        return product;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<CliProduct>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        output_.commit(dynamic_cast<CliProduct&>(product).commands, layer.index() + 1);
    }

    void finish() override { output_.end(binary() ? "" : "$$GEOMETRYEND\n"); }

  private:
    bool binary() const { return cli_.cli_format == CliFormat::binary; }

    void check(const Job& job) const {
        if (!(vector_.tolerance >= 1e-4 && vector_.tolerance <= 10)) {
            throw InputError(fmt::format("tolerance = {} mm: must be 0.0001 to 10", vector_.tolerance));
        }
        if (!(cli_.cli_units >= 1e-6 && cli_.cli_units <= 1e4)) {
            throw InputError(fmt::format("cli_units = {} mm: must be 0.000001 to 10000", cli_.cli_units));
        }
        double farthest = job.layers.total();
        for (const dvec3& corner : {job.bounds.lo, job.bounds.hi})
            farthest = std::max({farthest, std::abs(corner.x), std::abs(corner.y)});
        if (farthest / cli_.cli_units > max_units) {
            throw InputError(
                fmt::format("cli_units = {} mm: the part's coordinates are more than 1e9 of them; "
                            "accepted: {:.1g} mm or more",
                            cli_.cli_units, farthest / max_units));
        }
    }

    std::string start(const Job& job, LayerRange range) const {
        const double bottom = job.layers.bottom(range.first), top = job.layers.bottom(range.last);
        const auto mm = [](double v) { return format_number(v, grid_decimals); };
        const Box& b = job.bounds;
        std::string text = fmt::format("$$HEADERSTART\n$${}\n$$UNITS/{}\n$$VERSION/200\n",
                                       binary() ? "BINARY" : "ASCII", format_number(cli_.cli_units, 9));
        text += fmt::format("$$LABEL/{},{}\n", part_id, label_text(job.name));
        if (job.supports) text += fmt::format("$$LABEL/{},supports\n", support_id);
        text += fmt::format("$$DIMENSION/{},{},{},{},{},{}\n", mm(b.lo.x), mm(b.lo.y), mm(bottom), mm(b.hi.x),
                            mm(b.hi.y), mm(top));
        text += fmt::format("$$LAYERS/{}\n$$HEADEREND", range.count() + (cli_.cli_empty_layer ? 1 : 0));
        if (!binary()) text += "\n$$GEOMETRYSTART\n";
        CliText first(binary(), cli_.cli_units);
        if (cli_.cli_empty_layer) first.layer(bottom);
        return text + first.take();
    }

    VectorProfile vector_;
    ExchangeProfile cli_;
    UnfinishedFile output_;
};

}  // namespace

std::unique_ptr<Backend> make_cli(const PrinterProfile& profile, const std::string& path, bool force) {
    return std::make_unique<Cli>(profile, path, force);
}

}  // namespace lamella
