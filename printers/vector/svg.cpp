// The back-ends for SVG files and folders of them.
#include "printers/vector/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/unfinished_file.h"
#include "printers/archive/unfinished_folder.h"
#include "printers/vector/cut_sheets.h"
#include "printers/vector/slic3r_svg.h"
#include "printers/vector/svg_sheet.h"
#include "printers/vector/svg_text.h"

namespace lamella {
namespace {

struct SvgProduct : LayerProduct {
    void serialize(Archive& parcel) override { parcel(path, supports); }

    std::string path;      ///< path data; empty for an empty layer
    std::string supports;  ///< path data of the supports
};

/// The page that all layers share.
struct Page {
    double left = 0;  ///< x of the part at the left edge, mm
    double top = 0;   ///< y of the part at the upper edge, mm
    double width = 0;
    double height = 0;
};

Page make_page(const VectorProfile& profile, const Box& bounds) {
    check_page(profile);
    return {bounds.lo.x - profile.margin, bounds.hi.y + profile.margin, bounds.size().x + 2 * profile.margin,
            bounds.size().y + 2 * profile.margin};
}

/// Returns the number of contours that enclose each contour.
std::vector<int> nesting_depths(const std::vector<Contour>& contours) {
    std::vector<int> depths(contours.size(), 0);
    for (std::size_t i = 0; i < contours.size(); ++i) {
        for (int p = contours[i].parent; p >= 0; p = contours[static_cast<std::size_t>(p)].parent)
            ++depths[i];
    }
    return depths;
}

/// Returns the path data of the contours, the innermost first: a cutter must not release a piece before its
/// holes are cut.
std::string path_data(const std::vector<Contour>& contours, const Page& page) {
    const std::vector<int> depths = nesting_depths(contours);
    std::vector<std::size_t> order(contours.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return depths[a] > depths[b]; });
    std::string data;
    for (const std::size_t i : order) {
        append_svg_line(data, contours[i].points, true, {page.left, page.top});
    }
    return data;
}

/// Attributes of the paths of part and supports.
struct Style {
    const char* part;
    const char* supports;
};
constexpr Style filled{"fill=\"#000000\" stroke=\"none\"",
                       "class=\"support\" fill=\"#0080ff\" stroke=\"none\""};
// The widest stroke that every cutter's driver still takes for a cut is 0.025 mm (0.001 inch). All drivers
// distinguish red from blue.
constexpr Style hairline{"fill=\"none\" stroke=\"#ff0000\" stroke-width=\"0.01\"",
                         "class=\"support\" fill=\"none\" stroke=\"#0000ff\" stroke-width=\"0.01\""};

/// Returns the layer as an Inkscape layer and a Slic3r slice.
std::string group(const Layer& layer, const SvgProduct& product, const Style& style) {
    std::string text = fmt::format(
        "<g id=\"layer{0:04}\" inkscape:groupmode=\"layer\" inkscape:label=\"{0:04} z={1}\" "
        "slic3r:z=\"{1}\">\n",
        layer.index(), format_number(layer.top(), 6));
    const auto add = [&](const std::string& path, const char* attributes) {
        if (path.empty()) return;
        text += fmt::format("<path {} fill-rule=\"evenodd\" d=\"\n{}\"/>\n", attributes, path);
    };
    add(product.path, style.part);
    add(product.supports, style.supports);
    return text + "</g>\n";
}

std::string settings_of(const VectorProfile& vector) {
    return fmt::format("svg one_file={} tolerance={} margin={}", vector.one_file, vector.tolerance,
                       vector.margin);
}

/// Common base of both outputs: the page, and rendering a layer to path data.
class Svg : public Backend {
  public:
    explicit Svg(const PrinterProfile& profile) : profile_(profile) {}

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<SvgProduct>();
        const std::vector<Contour> contours = layer.contours(profile_.vector.tolerance);
        for (const Contour& contour : contours) product->area += signed_area(contour.points);
        product->path = path_data(contours, page_);
        const std::vector<Contour> supports = layer.support_contours(profile_.vector.tolerance);
        for (const Contour& contour : supports) product->support_area += signed_area(contour.points);
        product->supports = path_data(supports, page_);
        return product;
    }

  protected:
    JobStamp prepare(const Job& job, LayerRange range) {
        check_range(job, range);
        page_ = make_page(profile_.vector, job.bounds);
        return {job.identity, settings_of(profile_.vector), range};
    }
    const PrinterProfile& profile() const { return profile_; }
    const Page& page() const { return page_; }

  private:
    PrinterProfile profile_;
    Page page_;
};

class SvgFile : public Svg {
  public:
    SvgFile(const PrinterProfile& profile, const std::string& path, bool force)
        : Svg(profile), output_(path, force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        const int next = output_.begin(prepare(job, range), resume);
        if (!output_.resumed()) output_.commit(svg_start({page().width, page().height}), next);
        return next;
    }
    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<SvgProduct>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        output_.commit(group(layer, dynamic_cast<SvgProduct&>(product), filled), layer.index() + 1);
    }
    void finish() override { output_.end(svg_end); }

  private:
    UnfinishedFile output_;
};

class SvgFolder : public Svg {
  public:
    SvgFolder(const PrinterProfile& profile, const std::string& path, bool force)
        : Svg(profile), output_(path, ".svg", force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        const JobStamp stamp = prepare(job, range);
        description_ = describe_job(job, range, ".svg");
        description_["printer"] = profile().name;
        description_["width"] = page().width;
        description_["height"] = page().height;
        description_["placement"] = {{"left", page().left}, {"top", page().top}};
        description_["tolerance"] = profile().vector.tolerance;
        return output_.begin(stamp, resume);
    }
    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<SvgProduct>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        const std::string text = svg_start({page().width, page().height}) +
                                 group(layer, dynamic_cast<SvgProduct&>(product), hairline) + svg_end;
        output_.write(layer.index(), std::as_bytes(std::span(text)), product);
    }
    void finish() override { output_.end(description_); }

  private:
    UnfinishedFolder output_;
    nlohmann::ordered_json description_;
};

}  // namespace

std::unique_ptr<Backend> make_svg(const PrinterProfile& profile, const std::string& path, bool force) {
    const bool cutting = asks_for_cutting(profile);
    if (profile.cutting.dialect == SvgDialect::slic3r) {
        if (cutting || !profile.vector.one_file) {
            throw InputError(
                "printer.dialect = \"slic3r\" is one file of filled slices for projectors; accepted: "
                "one_file = "
                "true, and neither kerf, laser, ties, numbers, next_outline nor sheet");
        }
        return make_slic3r_svg(profile, path, force);
    }
    if (cutting) {
        const auto format = std::make_shared<SvgSheetFormat>(profile.cutting.laser);
        return profile.cutting.sheet.empty() ? make_layer_sheets(profile, format, path, force)
                                             : make_nested_sheets(profile, format, path, force);
    }
    if (profile.vector.one_file) return std::make_unique<SvgFile>(profile, path, force);
    return std::make_unique<SvgFolder>(profile, path, force);
}

}  // namespace lamella
