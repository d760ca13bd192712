// Writes the parts of slices as they are computed, then the model that refers to them.
#include "printers/vector/slice_3mf.h"

#include <fmt/format.h>

#include <vector>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/deflated_zip.h"
#include "printers/archive/grid_polygon.h"
#include "printers/archive/json_number.h"
#include "printers/archive/package_3mf.h"
#include "printers/archive/unfinished_file.h"

namespace lamella {
namespace {

constexpr int height_decimals = 6;

// Resource numbers in the model, and of the stacks in each part of the package.
constexpr int part_stack = 1, support_stack = 2, part_object = 3, support_object = 4;

constexpr std::string_view slice_model_start =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<model unit=\"millimeter\" xml:lang=\"en-US\" "
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
    "xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\" requiredextensions=\"s\">\n";

void append_grid(std::string& out, std::int64_t units) {
    append_number(out, static_cast<double>(units) / grid_units_per_mm, grid_decimals);
}

/// Returns a slice, identified by the height of its top. Outer contours run counter-clockwise and holes
/// clockwise, as the positive fill rule requires.
std::string slice_text(double top, const std::vector<GridPolygon>& polygons) {
    std::string text = "<s:slice ztop=\"" + format_number(top, height_decimals) + "\"";
    if (polygons.empty()) return text + "/>\n";
    text += ">\n<s:vertices>\n";
    for (const GridPolygon& polygon : polygons) {
        for (const auto& [x, y] : polygon.points) {
            text += "<s:vertex x=\"";
            append_grid(text, x);
            text += "\" y=\"";
            append_grid(text, y);
            text += "\"/>\n";
        }
    }
    text += "</s:vertices>\n";
    std::size_t first = 0;
    for (const GridPolygon& polygon : polygons) {
        const std::size_t count = polygon.points.size();
        text += fmt::format("<s:polygon startv=\"{}\">\n", first);
        for (std::size_t i = 1; i <= count; ++i)
            text += fmt::format("<s:segment v2=\"{}\"/>\n", first + i % count);
        text += "</s:polygon>\n";
        first += count;
    }
    return text + "</s:slice>\n";
}

struct Slice3mfProduct : LayerProduct {
    void serialize(Archive& parcel) override {
        parcel(part.bytes, part.size, part.crc, supports.bytes, supports.size, supports.crc);
    }

    DeflatedPiece part;
    DeflatedPiece supports;  ///< empty for a job without supports
};

class Slice3mf : public Backend {
  public:
    Slice3mf(const PrinterProfile& profile, const std::string& path, bool force)
        : tolerance_(profile.vector.tolerance),
          package_layers_(profile.exchange.package_layers),
          path_(path),
          output_(path, force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        if (!(tolerance_ >= 1e-4 && tolerance_ <= 10))
            throw InputError(fmt::format("tolerance = {} mm: must be 0.0001 to 10", tolerance_));
        if (package_layers_ < 1)
            throw InputError(fmt::format("package_layers = {}: must be 1 or more", package_layers_));
        name_ = job.name;
        bounds_ = job.bounds;
        layers_ = job.layers;
        range_ = range;
        with_supports_ = job.supports != nullptr;
        const std::string settings =
            fmt::format("3mf tolerance={} package_layers={}", tolerance_, package_layers_);
        const int next = output_.begin({job.identity, settings, range}, resume);
        if (output_.resumed()) {
            output_.restore([&](const auto& state) {
                zip_.take_up(path_ + ".partial", whole_number<std::uint64_t>(state));
            });
        } else {
            std::string text = zip_.entry("[Content_Types].xml", package_content_types);
            text += zip_.entry("_rels/.rels", package_relationships);
            output_.commit(text, next, zip_.size());
        }
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<Slice3mfProduct>();
        const std::vector<Contour> part = layer.contours(tolerance_);
        product->area = total_area(part);
        product->part = deflate_piece(slice_text(layer.top(), on_grid(part)));
        if (!with_supports_) return product;
        const std::vector<Contour> supports = layer.support_contours(tolerance_);
        product->support_area = total_area(supports);
        product->supports = deflate_piece(slice_text(layer.top(), on_grid(supports)));
        return product;
    }

    std::unique_ptr<LayerProduct> empty_product() const override {
        return std::make_unique<Slice3mfProduct>();
    }

    void write(const Layer& layer, LayerProduct& product) override {
        auto& slice = dynamic_cast<Slice3mfProduct&>(product);
        part_.push_back(std::move(slice.part));
        if (with_supports_) supports_.push_back(std::move(slice.supports));
        const int next = layer.index() + 1;
        const int number = part_number(layer.index());
        if (next < range_.last && part_number(next) == number) return;
        const std::string text = finish_part(number);
        output_.commit(text, next, zip_.size());
    }

    void finish() override {
        std::string text = zip_.entry("3D/_rels/3dmodel.model.rels", relations());
        text += zip_.entry("3D/3dmodel.model", model());
        output_.end(text + zip_.directory());
    }

  private:
    int part_number(int layer) const { return (layer - range_.first) / package_layers_; }
    int parts() const { return part_number(range_.last - 1) + 1; }
    static std::string part_path(int number) { return fmt::format("2D/slices{:05}.model", number); }

    /// Returns the height at which the stack begins, mm above the plate.
    double bottom(int part = 0) const { return layers_.bottom(range_.first + part * package_layers_); }

    std::string stack_start(int id, int part) const {
        return fmt::format("<s:slicestack id=\"{}\" zbottom=\"{}\">\n", id,
                           format_number(bottom(part), height_decimals));
    }

    std::string finish_part(int number) {
        constexpr std::string_view stack_end = "</s:slicestack>\n";
        std::vector<DeflatedPiece> pieces;
        const auto add = [&](std::vector<DeflatedPiece>& slices) {
            for (DeflatedPiece& slice : slices) pieces.push_back(std::move(slice));
            slices.clear();
        };
        pieces.push_back(deflate_piece(std::string(slice_model_start) + "<resources>\n" +
                                       stack_start(part_stack, number)));
        add(part_);
        if (with_supports_) {
            pieces.push_back(deflate_piece(std::string(stack_end) + stack_start(support_stack, number)));
            add(supports_);
        }
        pieces.push_back(deflate_piece(std::string(stack_end) + "</resources>\n<build/>\n</model>\n"));
        return zip_.entry(part_path(number), pieces);
    }

    std::string relations() const {
        std::string text =
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n";
        for (int i = 0; i < parts(); ++i) {
            text += fmt::format(
                "<Relationship Id=\"rel{0}\" Target=\"/{1}\" "
                "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n",
                i, part_path(i));
        }
        return text + "</Relationships>\n";
    }

    std::string stack(int id) const {
        std::string text = stack_start(id, 0);
        for (int i = 0; i < parts(); ++i) {
            text += fmt::format("<s:sliceref slicestackid=\"{}\" slicepath=\"/{}\"/>\n", id, part_path(i));
        }
        return text + "</s:slicestack>\n";
    }

    /// Returns the bounding box of the job as the mesh that represents the slices.
    std::string object(int id, const char* type, int stack_id, const std::string& name) const {
        const double top = layers_.bottom(range_.last);
        return fmt::format(
                   "<object id=\"{}\" type=\"{}\" name=\"{}\" s:slicestackid=\"{}\" "
                   "s:meshresolution=\"lowres\">\n",
                   id, type, xml_attribute(name), stack_id) +
               box_mesh({{bounds_.lo.x, bounds_.lo.y, bottom()}, {bounds_.hi.x, bounds_.hi.y, top}},
                        grid_decimals, height_decimals) +
               "</object>\n";
    }

    std::string item(int id) const {
        return fmt::format("<item objectid=\"{}\" transform=\"1 0 0 0 1 0 0 0 1 {} {} 0\"/>\n", id,
                           format_number(-bounds_.lo.x, grid_decimals),
                           format_number(-bounds_.lo.y, grid_decimals));
    }

    std::string model() const {
        std::string text = std::string(slice_model_start) +
                           "<metadata name=\"Application\">Lamella</metadata>\n<resources>\n" +
                           stack(part_stack);
        if (with_supports_) text += stack(support_stack);
        text += object(part_object, "model", part_stack, name_);
        if (with_supports_)
            text += object(support_object, "solidsupport", support_stack, name_ + " supports");
        text += "</resources>\n<build>\n" + item(part_object);
        if (with_supports_) text += item(support_object);
        return text + "</build>\n</model>\n";
    }

    double tolerance_;
    int package_layers_;
    std::string path_;
    UnfinishedFile output_;
    DeflatedZip zip_;
    std::string name_;
    Box bounds_;
    LayerPlan layers_;
    LayerRange range_;
    bool with_supports_ = false;
    std::vector<DeflatedPiece> part_, supports_;  ///< slices of the package part that is being filled
};

}  // namespace

std::unique_ptr<Backend> make_slice_3mf(const PrinterProfile& profile, const std::string& path, bool force) {
    return std::make_unique<Slice3mf>(profile, path, force);
}

}  // namespace lamella
