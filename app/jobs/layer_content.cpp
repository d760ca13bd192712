// Cuts layers as they are asked for; nothing is kept.
#include "app/jobs/layer_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "app/http/http_server.h"
#include "app/jobs/voxel_grid.h"
#include "app/reports/grey_page.h"
#include "engine/base/cancel_token.h"
#include "engine/base/parallel.h"
#include "engine/contours/coverage.h"
#include "engine/field/slice_context.h"
#include "printers/masks/png_writer.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

using Color = std::array<double, 3>;
constexpr Color ground{16, 20, 24}, part_color{223, 232, 242}, support_color{89, 143, 204};

Layer layer_of(const ServedJob& job, int layer) { return Layer(job.job(), layer); }

template <typename T>
void append(std::string& bytes, T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);  // NOLINT: little-endian, as every machine that this runs on
    bytes.append(raw, sizeof value);
}

/// Mixes two colours into the ground, by the shares that they cover.
Color mixed(double part, double supports) {
    Color color{};
    const double rest = std::max(0.0, 1 - part - supports), sum = std::max(1.0, part + supports);
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = rest * ground[c] + (part * part_color[c] + supports * support_color[c]) / sum;
    return color;
}

constexpr unsigned shares = 16;  // of part and of supports, where both are in a picture

/// Returns the colours of pixels: by their coverage, or with supports by 16 shares of each.
std::vector<std::uint8_t> palette_of(bool with_supports) {
    const auto share_of = [](unsigned level) { return level / (shares - 1.0); };
    std::vector<std::uint8_t> palette;
    for (unsigned i = 0; i < 256; ++i) {
        const Color color =
            with_supports ? mixed(share_of(i / shares), share_of(i % shares)) : mixed(i / 255.0, 0);
        for (const double channel : color) palette.push_back(static_cast<std::uint8_t>(std::lround(channel)));
    }
    return palette;
}

/// Returns the runs of both, of equal lengths, with the value of each pair.
template <typename Combine>
std::vector<GreyRun> combined(std::span<const GreyRun> a, std::span<const GreyRun> b, Combine combine) {
    std::vector<GreyRun> runs;
    std::size_t i = 0, j = 0;
    for (std::uint32_t taken_a = 0, taken_b = 0; i < a.size() && j < b.size();) {
        const std::uint32_t length = std::min<std::uint32_t>(a[i].length - taken_a, b[j].length - taken_b);
        GreyRun run = a[i];
        run.length = length;
        run.value = static_cast<decltype(run.value)>(combine(a[i].value, b[j].value));
        runs.push_back(run);
        taken_a += length;
        taken_b += length;
        if (taken_a == a[i].length) ++i, taken_a = 0;
        if (taken_b == b[j].length) ++j, taken_b = 0;
    }
    return runs;
}

/// Returns the coverage of some rows of a page.
std::vector<GreyRun> grey_rows(const SliceField& slice, const RowBand& band, Scratch& scratch) {
    RunRows rows;
    std::vector<GreyRun> runs;
    slice.runs(band, scratch, rows);
    coverage(band, rows, runs);
    return runs;
}

const SliceField* slice_of(const Layer& layer, bool of_supports) {
    return of_supports ? layer.supports() : &layer.part();
}

}  // namespace

RowBand page_of(const Rect& rect, double pixel, int sub) {
    RowBand band;
    band.along_origin = rect.lo.x;
    band.along_pitch = pixel;
    band.across_origin = rect.hi.y;
    band.across_pitch = -pixel;
    band.sub = sub;
    band.hi = std::max(1, static_cast<int>(std::lround(rect.size().x / pixel)));
    band.count = std::max(1, static_cast<int>(std::lround(rect.size().y / pixel)));
    return band;
}

std::string layer_picture(const ServedJob& job, int layer, const LayerWindow& window, bool in_colours) {
    constexpr double most_pixels = 1 << 26;
    const double pixel = window.rect.size().x / window.width;
    const RowBand page = page_of(window.rect, pixel, 4);
    if (static_cast<double>(page.hi) * page.count > most_pixels)
        throw HttpError(400, "the picture would be too large; accepted: a smaller width or window");
    const Layer cut = layer_of(job, layer);
    const SliceField* supports = cut.supports();
    PngHeader header{page.hi, page.count};
    if (in_colours) header.palette = palette_of(supports != nullptr);
    std::vector<std::byte> file;
    PngWriter writer(header, file);
    Scratch scratch;
    const double grey = job.recipe.printer.support.grey;
    for (RowBand band = page; band.first < page.count; band.first += png_band_rows) {
        band.count = std::min(png_band_rows, page.count - band.first);
        std::vector<GreyRun> runs = grey_rows(cut.part(), band, scratch);
        if (supports != nullptr) {
            runs = combined(runs, grey_rows(*supports, band, scratch), [&](unsigned part, unsigned other) {
                if (in_colours) return part / 17 * shares + other / 17;
                return std::max(part, static_cast<unsigned>(std::lround(other * grey)));
            });
        }
        writer.add_rows(runs, band.count);
    }
    writer.finish();
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text for the reply
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

std::string layer_runs(const ServedJob& job, int layer, const RowBand& band, bool of_supports) {
    const Layer cut = layer_of(job, layer);
    const SliceField* slice = slice_of(cut, of_supports);
    Scratch scratch;
    RunRows rows;
    if (slice != nullptr) slice->runs(band, scratch, rows);
    const std::size_t lines = rows.lines();
    std::string bytes = headed({{"lines", lines}, {"runs", rows.runs().size()}, {"z", cut.z()}});
    std::uint32_t first = 0;
    append(bytes, first);
    for (std::size_t l = 0; l < lines; ++l)
        append(bytes, first += static_cast<std::uint32_t>(rows.line(l).size()));
    for (const Run& run : rows.runs()) {
        append(bytes, run.begin);
        append(bytes, run.end);
    }
    return bytes;
}

Json layer_contours(const ServedJob& job, int layer, double tolerance, bool of_supports) {
    const Layer cut = layer_of(job, layer);
    Json list = Json::array();
    double area = 0;
    for (const Contour& contour : of_supports ? cut.support_contours(tolerance) : cut.contours(tolerance)) {
        area += signed_area(contour.points);
        Json points = Json::array();
        for (const dvec2& p : contour.points) {
            points.push_back(p.x);
            points.push_back(p.y);
        }
        list.push_back({{"parent", contour.parent}, {"points", std::move(points)}});
    }
    return {{"contours", std::move(list)}, {"area", area}, {"z", cut.z()}};
}

RowBand voxel_page(const VoxelGrid& grid) {
    RowBand page = page_of({{grid.lo.x, grid.lo.y}, {grid.hi().x, grid.hi().y}}, grid.voxel, 3);
    page.across_origin = grid.lo.y;
    page.across_pitch = grid.voxel;
    return page;
}

std::string coverage_volume(const ServedJob& job, int longest, const PassControl& control) {
    const VoxelGrid grid = voxel_grid(job.job().bounds, longest);
    const RowBand page = voxel_page(grid);
    const std::size_t plane = grid.plane();
    std::string bytes = headed(grid_head(grid, 2));
    const std::size_t head = bytes.size();
    bytes.resize(head + 2 * grid.voxels());
    const auto put = [&](const SliceField& slice, std::size_t k, std::size_t channel) {
        const std::vector<std::uint8_t> grey = grey_page(slice, page, true);
        for (std::size_t i = 0; i < plane; ++i)
            bytes[head + 2 * (k * plane + i) + channel] = static_cast<char>(grey[i]);
    };
    ThreadArena arena(control.threads);
    arena.execute([&] {
        parallel_for(static_cast<std::size_t>(grid.size.z), [&](std::size_t k) {
            stop_if_cancelled(control.cancel);
            const double z = grid.lo.z + (static_cast<double>(k) + 0.5) * grid.voxel;
            SliceContext context;
            put(context.slice(*job.job().part, z), k, 0);
            if (job.job().supports) put(context.slice(*job.job().supports, z), k, 1);
        });
    });
    return bytes;
}

}  // namespace lamella
