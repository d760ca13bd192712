// Writes sheets as they are computed, then the model that refers to them.
#include "printers/masks/image3d.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/json_number.h"
#include "printers/archive/package_3mf.h"
#include "printers/archive/stored_zip.h"
#include "printers/archive/unfinished_file.h"
#include "printers/common/layer_heights.h"
#include "printers/masks/png_mask.h"
#include "printers/masks/png_writer.h"

namespace lamella {
namespace {

constexpr int stack_decimals = 6;

// Resource numbers of the part in the model; those of the supports follow.
constexpr int box_object = 1, part_resources = 2, support_resources = 5;

constexpr std::string_view stack_model_start =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<model unit=\"millimeter\" xml:lang=\"en-US\" "
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
    "xmlns:v=\"http://schemas.3mf.io/3dmanufacturing/volumetric/2022/01\" requiredextensions=\"v\">\n"
    "<metadata name=\"Application\">Lamella</metadata>\n<resources>\n";

struct SheetProduct : LayerProduct {
    void serialize(Archive& parcel) override { parcel(part, supports); }

    std::string part;
    std::string supports;  ///< empty for a job without supports
};

/// Returns a display just large enough for the job, plus one pixel on each side.
ImageProfile grid_about(const Box& bounds, ImageProfile image) {
    if (image.format != ImageFormat::png)
        throw InputError("an image3d's sheets are PNG files; accepted: format = \"png\"");
    if (image.gamma != 1 || image.min_grey != 0 || image.full_grey != 1) {
        throw InputError(
            "an image3d's greys are shares of voxels; accepted: gamma = 1, least_grey = 0, "
            "full_grey = 1");
    }
    const auto side = [](double size, double pixel) {
        constexpr int most = 65535;  // px; largest PNG that is written
        const double pixels = std::ceil(size / pixel) + 2;
        if (!(pixels <= most)) {
            throw InputError(
                fmt::format("{:.3f} mm in pixels of {} mm are more than {} a side; accepted: "
                            "larger pixels",
                            size, pixel, most));
        }
        return static_cast<int>(pixels);
    };
    image.width = side(bounds.size().x, image.pixel_x);
    image.height = side(bounds.size().y, image.pixel_y);
    image.mirror_x = image.mirror_y = image.portrait = false;
    image.margin = 0;
    return image;
}

class Image3d : public Backend {
  public:
    Image3d(const PrinterProfile& profile, const std::string& path, bool force)
        : profile_(profile), path_(path), output_(path, force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        profile_.image = grid_about(job.bounds, profile_.image);
        layout_.emplace(profile_.image, job.bounds);
        name_ = job.name;
        layer_height_ = equal_layer_height(job.layers, {0, range.last}, "an image stack in 3MF");
        range_ = range;
        with_supports_ = job.supports != nullptr;
        const std::string settings = "image3d " + describe_mask(profile_.image).dump();
        const int next = output_.begin({job.identity, settings, range}, resume);
        if (output_.resumed()) {
            output_.restore([&](const auto& state) {
                zip_.take_up(path_ + ".partial", whole_number<std::uint64_t>(state));
            });
        } else {
            std::string text = zip_.entry("[Content_Types].xml", package_content_types_with_png);
            text += zip_.entry("_rels/.rels", package_relationships);
            output_.commit(text, next, zip_.size());
        }
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<SheetProduct>();
        product->area = sheet(layer, MaskedSolid::part, product->part);
        if (with_supports_) product->support_area = sheet(layer, MaskedSolid::supports, product->supports);
        return product;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<SheetProduct>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        const auto& sheets = dynamic_cast<SheetProduct&>(product);
        const int number = layer.index() - range_.first;
        std::string text = zip_.entry(sheet_path(part_resources, number), sheets.part);
        if (with_supports_) text += zip_.entry(sheet_path(support_resources, number), sheets.supports);
        output_.commit(text, layer.index() + 1, zip_.size());
    }

    void finish() override {
        std::string text = zip_.entry("3D/_rels/3dmodel.model.rels", relations());
        text += zip_.entry("3D/3dmodel.model", model());
        output_.end(text + zip_.directory());
    }

  private:
    double sheet(const Layer& layer, MaskedSolid solid, std::string& file) const {
        std::vector<std::byte> bytes;
        PngWriter writer({layout_->width(), layout_->height(), layout_->column_pitch(), layout_->row_pitch(),
                          PngColors::grey, profile_.image.bits},
                         bytes);
        const double area =
            mask_solid(layer, solid, *layout_, profile_.image,
                       [&](std::span<const GreyRun> runs, int rows) { writer.add_rows(runs, rows); });
        writer.finish();
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text for the archive
        file.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return area;
    }

    static std::string sheet_path(int resources, int number) {
        return fmt::format("3D/volumetric/{}/{:06}.png", resources == part_resources ? "part" : "supports",
                           number);
    }

    std::vector<int> solids() const {
        return with_supports_ ? std::vector{part_resources, support_resources} : std::vector{part_resources};
    }

    std::string relations() const {
        std::string text =
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n";
        int count = 0;
        for (const int resources : solids()) {
            for (int i = 0; i < range_.count(); ++i) {
                text += fmt::format(
                    "<Relationship Id=\"rel{}\" Target=\"/{}\" "
                    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dtexture\"/>\n",
                    count++, sheet_path(resources, i));
            }
        }
        return text + "</Relationships>\n";
    }

    /// Returns the box of the sheets, mm: the part's x and y, heights above the plate.
    Box grid() const {
        const RowBand band = layout_->rows(0, 1, 1);
        const double back = band.across_origin + layout_->height() * band.across_pitch;
        const double right = band.along_origin + layout_->width() * band.along_pitch;
        return {{band.along_origin, std::min(band.across_origin, back), range_.first * layer_height_},
                {right, std::max(band.across_origin, back), range_.last * layer_height_}};
    }

    /// Returns the image, the function and the object of the part or of the supports.
    std::string resources_of(int first, const std::string& name, const char* type) const {
        const int image = first, function = first + 1, object = first + 2;
        std::string text = fmt::format(
            "<v:image3d id=\"{}\" name=\"{}\">\n<v:imagestack rowcount=\"{}\" columncount=\"{}\" "
            "sheetcount=\"{}\">\n",
            image, first == part_resources ? "part" : "supports", layout_->height(), layout_->width(),
            range_.count());
        for (int i = 0; i < range_.count(); ++i)
            text += fmt::format("<v:imagesheet path=\"/{}\"/>\n", sheet_path(first, i));
        // 0.5 minus the voxel's grey: negative if more than half of it is solid.
        text += fmt::format(
            "</v:imagestack>\n</v:image3d>\n<v:functionfromimage3d id=\"{}\" displayname=\"{}\" "
            "image3did=\"{}\" valueoffset=\"0.5\" valuescale=\"-1\" filter=\"linear\" tilestyleu=\"clamp\" "
            "tilestylev=\"clamp\" tilestylew=\"clamp\"/>\n",
            function, xml_attribute(name), image);
        const Box box = grid();
        const dvec3 scale = dvec3(1) / box.size(), shift = dvec3(0) - box.lo * scale;  // no minus zero
        text += fmt::format(
            "<object id=\"{}\" type=\"{}\" name=\"{}\">\n<v:levelset functionid=\"{}\" channel=\"red\" "
            "meshid=\"{}\" meshbboxonly=\"true\" fallbackvalue=\"1\" transform=\"{} 0 0 0 {} 0 0 0 {} {} {} "
            "{}\"/>\n</object>\n",
            object, type, xml_attribute(name), function, box_object, scale.x, scale.y, scale.z, shift.x,
            shift.y, shift.z);
        return text;
    }

    std::string model() const {
        const Box box = grid();
        std::string text = std::string(stack_model_start) +
                           fmt::format("<object id=\"{}\" name=\"bounds\">\n", box_object) +
                           box_mesh(box, stack_decimals, stack_decimals) + "</object>\n" +
                           resources_of(part_resources, name_, "model");
        if (with_supports_) text += resources_of(support_resources, name_ + " supports", "solidsupport");
        text += "</resources>\n<build>\n";
        for (const int resources : solids()) {
            text += fmt::format("<item objectid=\"{}\" transform=\"1 0 0 0 1 0 0 0 1 {} {} 0\"/>\n",
                                resources + 2, format_number(-box.lo.x, stack_decimals),
                                format_number(-box.lo.y, stack_decimals));
        }
        return text + "</build>\n</model>\n";
    }

    PrinterProfile profile_;
    std::string path_;
    UnfinishedFile output_;
    StoredZip zip_;
    std::optional<MaskLayout> layout_;
    std::string name_;
    double layer_height_ = 0;  ///< mm
    LayerRange range_;
    bool with_supports_ = false;
};

}  // namespace

std::unique_ptr<Backend> make_image3d(const PrinterProfile& profile, const std::string& path, bool force) {
    return std::make_unique<Image3d>(profile, path, force);
}

}  // namespace lamella
