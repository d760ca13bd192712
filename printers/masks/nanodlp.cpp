// Entries of the archive: masks, and five descriptions.
#include "printers/masks/nanodlp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/base/error.h"
#include "printers/archive/json_number.h"
#include "printers/archive/stored_zip.h"
#include "printers/archive/unfinished_file.h"
#include "printers/common/layer_areas.h"
#include "printers/common/layer_heights.h"
#include "printers/masks/png_mask.h"
#include "printers/masks/png_writer.h"
#include "printers/masks/resin.h"

namespace lamella {
namespace {

using Json = nlohmann::ordered_json;

constexpr int max_layers = 100'000;

struct NanoMask : MaskFile {
    void serialize(Archive& parcel) override {
        MaskFile::serialize(parcel);
        parcel(figures);
    }

    LayerFigures figures;
};

PngColors png_colors(PanelPixels pixels) {
    switch (pixels) {
        case PanelPixels::rgb:
            return PngColors::rgb;
        case PanelPixels::packed:
            return PngColors::packed;
        case PanelPixels::grey:
            return PngColors::grey;
    }
    throw InputError("the pixels of a panel are neither rgb, packed nor grey");
}

/// Rounds to 1 / steps. Whole numbers have no decimal point, because some readers require integers.
Json number(double value, double steps = 1e4) {
    const double rounded = std::round(value * steps) / steps;
    if (rounded == std::floor(rounded)) return static_cast<std::int64_t>(rounded);
    return rounded;
}

/// Names may contain bytes that are not UTF-8.
std::string to_text(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json to_state(const LayerFigures& f) {
    return {f.total, f.largest, f.smallest, f.islands, f.min_x, f.min_y, f.max_x, f.max_y};
}

LayerFigures from_state(const Json& state) {
    LayerFigures f;
    f.total = state.at(0).get<double>();
    f.largest = state.at(1).get<double>();
    f.smallest = state.at(2).get<double>();
    f.islands = whole_number<int>(state.at(3));
    f.min_x = whole_number<int>(state.at(4));
    f.min_y = whole_number<int>(state.at(5));
    f.max_x = whole_number<int>(state.at(6));
    f.max_y = whole_number<int>(state.at(7));
    return f;
}

class NanoDlp : public Backend {
  public:
    NanoDlp(const PrinterProfile& profile, const std::string& path, bool force)
        : profile_(profile), resin_(profile_.resin), path_(path), output_(path, force) {}
    NanoDlp(const NanoDlp&) = delete;
    NanoDlp& operator=(const NanoDlp&) = delete;

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        check_resin_profile(resin_, job.layers.greatest_height());
        layout_.emplace(profile_.image, job.bounds);
        colors_ = png_colors(profile_.nanodlp.pixels);
        std::vector<std::byte> unused;
        const PngWriter check(header(), unused);  // rejects an invalid width before any layer is rendered
        if (range.count() > max_layers) {
            throw InputError(fmt::format("{} layers are too many for NanoDLP; accepted: {} or fewer",
                                         range.count(), max_layers));
        }
        name_ = job.name;
        layer_height_ = equal_layer_height(job.layers, range, "a NanoDLP archive");
        range_ = range;
        const std::string settings =
            fmt::format("nanodlp {} {} {} {}", mask_settings(profile_, job), profile_.name,
                        static_cast<int>(profile_.nanodlp.pixels), describe_resin(resin_));
        const int next = output_.begin({job.identity, settings, range}, resume);
        if (output_.resumed()) restore(next);
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto mask = std::make_unique<NanoMask>();
        PngWriter writer(header(), mask->file);
        LayerAreas areas(layout_->width());
        const MaskArea area = mask_layer(layer, *layout_, profile_.image, profile_.support.grey,
                                         [&](std::span<const GreyRun> runs, int rows) {
                                             writer.add_rows(runs, rows);
                                             areas.add(runs);
                                         });
        writer.finish();
        mask->area = area.part;
        mask->support_area = area.supports;
        mask->figures = areas.figures();
        return mask;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<NanoMask>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        const auto& mask = dynamic_cast<NanoMask&>(product);
        volume_ += (mask.area + mask.support_area) * layer.thickness();
        figures_.push_back(mask.figures);
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text for the archive
        const std::string_view bytes(reinterpret_cast<const char*>(mask.file.data()), mask.file.size());
        const std::string entry = zip_.entry(fmt::format("{}.png", layer.index() - range_.first + 1), bytes);
        output_.commit(entry, layer.index() + 1, {volume_, zip_.size(), to_state(mask.figures)});
    }

    void finish() override {
        const std::string display = to_text(this->display());
        std::string text;
        const auto add = [&](const char* name, const std::string& content) {
            text += zip_.entry(name, content);
        };
        add("info.json", to_text(info()));
        add("meta.json", to_text(meta()));
        add("plate.json", to_text(plate()));
        add("profile.json", to_text(exposures()));
        // NanoDLP itself reads options.json, other programs read slicer.json.
        add("options.json", display);
        add("slicer.json", display);
        output_.end(text + zip_.directory());
    }

  private:
    PngHeader header() const {
        return {layout_->width(), layout_->height(), layout_->column_pitch(), layout_->row_pitch(), colors_};
    }

    void restore(int next) {
        output_.restore([&](const Json& state) {
            for (const Json& layer : output_.history()) figures_.push_back(from_state(layer.at(2)));
            volume_ = state.at(0).get<double>();
            zip_.take_up(path_ + ".partial", whole_number<std::uint64_t>(state.at(1)));
        });
        if (figures_.size() != static_cast<std::size_t>(next - range_.first)) throw output_.damaged_journal();
    }

    static Json meta() {
        return {
            {"FormatVersion", 2}, {"Distro", "generic"}, {"Program", "Lamella"}, {"Version", LAMELLA_VERSION},
            {"OS", "linux"},      {"Arch", ""},          {"Profile", false}};
    }

    Json info() const {
        const double pixel = layout_->column_pitch() * layout_->row_pitch();
        Json list = Json::array();
        for (const LayerFigures& f : figures_) {
            list.push_back({{"TotalSolidArea", number(f.total * pixel)},
                            {"LargestArea", number(f.largest * pixel)},
                            {"SmallestArea", number(f.smallest * pixel)},
                            {"MinX", f.min_x},
                            {"MinY", f.min_y},
                            {"MaxX", f.max_x},
                            {"MaxY", f.max_y},
                            {"AreaCount", f.islands}});
        }
        return list;
    }

    /// Returns the extent of all masks, mm from the centre of the display.
    Json boundary() const {
        int x0 = layout_->width(), x1 = 0, y0 = layout_->height(), y1 = 0;
        for (const LayerFigures& f : figures_) {
            if (f.islands == 0) continue;
            x0 = std::min(x0, f.min_x);
            x1 = std::max(x1, f.max_x);
            y0 = std::min(y0, f.min_y);
            y1 = std::max(y1, f.max_y);
        }
        if (x0 >= x1) x0 = x1 = layout_->width() / 2;
        if (y0 >= y1) y0 = y1 = layout_->height() / 2;
        const auto place = [](int pixel, int count, double pitch) {
            return number((pixel - count / 2.0) * pitch);
        };
        return {{"XMin", place(x0, layout_->width(), layout_->column_pitch())},
                {"XMax", place(x1, layout_->width(), layout_->column_pitch())},
                {"YMin", place(y0, layout_->height(), layout_->row_pitch())},
                {"YMax", place(y1, layout_->height(), layout_->row_pitch())},
                {"ZMin", 0},
                {"ZMax", number(range_.count() * layer_height_)}};
    }

    std::int64_t seconds() const {
        return static_cast<std::int64_t>(
            std::ceil(resin_print_time(resin_, LayerPlan(range_.last, layer_height_), range_)));
    }

    Json plate() const {
        constexpr double cm3 = 1000;  // mm^3
        Json json{{"PlateID", 0},
                  {"ProfileID", 0},
                  {"Profile", nullptr},
                  {"CreatedDate", 0},
                  {"Path", name_},
                  {"Updated", 0},
                  {"PrintTime", seconds()},
                  {"PrintEst", seconds()},
                  {"TotalSolidArea", number(volume_ / cm3)},
                  {"LayersCount", range_.count()},
                  {"Processed", true},
                  {"MultiMaterial", false}};
        json.update(boundary());
        return json;
    }

    Json depth() const { return number(layer_height_ * 1000, 1e3); }  // micrometres

    Json exposures() const {
        const ResinProfile resin = resin_for_height(resin_, layer_height_);
        return {{"ResinID", 0},
                {"ProfileID", 0},
                {"Title", profile_.name},
                {"Desc", resin_.material},
                {"Depth", depth()},
                {"SupportDepth", depth()},
                {"CureTime", resin.exposure},
                {"SupportCureTime", resin.first_exposure},
                {"SupportLayerNumber", resin_.first_layers},
                {"TransitionalLayer", resin_.fade_layers},
                {"WaitHeight", resin_.lift},
                {"SupportWaitHeight", resin_.lift},
                {"CustomValues", {{"UvPwmValue", fmt::format("{:.2f}", resin_.light / 255.0)}}}};
    }

    Json display() const {
        return {{"Type", "png"},
                {"PWidth", layout_->width()},
                {"PHeight", layout_->height()},
                {"SupportDepth", depth()},
                {"SupportLayerNumber", resin_.first_layers},
                {"Thickness", depth()},
                {"XOffset", layout_->width() / 2},
                {"YOffset", layout_->height() / 2},
                {"XPixelSize", number(layout_->column_pitch(), 1e7)},
                {"YPixelSize", number(layout_->row_pitch(), 1e7)},
                {"XRes", number(layout_->column_pitch() * 1000)},
                {"YRes", number(layout_->row_pitch() * 1000)},
                {"Boundary", boundary()},
                {"FillColor", "#ffffff"},
                {"BlankColor", "#000000"},
                {"IgnoreMask", 1},
                {"ImageMirror", 0},
                {"DisplayController", profile_.nanodlp.pixels == PanelPixels::packed ? 1 : 0},
                {"LayerCount", range_.count()}};
    }

    PrinterProfile profile_;
    const ResinProfile& resin_;
    std::string path_;
    UnfinishedFile output_;
    StoredZip zip_;
    std::optional<MaskLayout> layout_;
    PngColors colors_ = PngColors::rgb;
    std::string name_;
    double layer_height_ = 0;  ///< mm
    LayerRange range_;
    double volume_ = 0;  ///< mm^3
    std::vector<LayerFigures> figures_;
};

}  // namespace

std::unique_ptr<Backend> make_nanodlp(const PrinterProfile& profile, const std::string& path, bool force) {
    return std::make_unique<NanoDlp>(profile, path, force);
}

}  // namespace lamella
