// Plans layers in parallel and lays them out in order.
#include "printers/vector/cut_sheets.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/unfinished_file.h"
#include "printers/archive/unfinished_folder.h"
#include "printers/common/layer_heights.h"
#include "printers/vector/cut_notes.h"
#include "printers/vector/cut_plan.h"
#include "printers/vector/sheet_nesting.h"
#include "printers/vector/svg_text.h"

namespace lamella {
namespace {

struct CutProduct : LayerProduct {
    void serialize(Archive& parcel) override { plan.serialize(parcel); }

    CutPlan plan;
};

void check_length(const char* key, double length, double least, double most) {
    if (length >= least && length <= most) return;
    throw InputError(fmt::format("printer.{} = {} mm: must be {} to {}", key, length, least, most));
}

void check_settings(const PrinterProfile& profile) {
    const CuttingProfile& cutting = profile.cutting;
    check_page(profile.vector);
    check_length("kerf", cutting.kerf, 0, 10);
    check_length("tie_width", cutting.tie_width, 0.01, 1000);
    check_length("number_height", cutting.number_height, 0.1, 1000);
    check_length("sheet_margin", cutting.sheet_margin, 0, 1e4);
    if (cutting.sheet.empty()) return;
    if (cutting.sheet.size() != 1 || cutting.sheet.front().size() != 2)
        throw InputError("printer.sheet: must be a width and a height");
    for (const double side : cutting.sheet.front()) {
        check_length("sheet", side, 1, 1e5);
        if (side <= 2 * cutting.sheet_margin) {
            throw InputError(
                fmt::format("printer.sheet_margin = {} mm leaves nothing of a sheet of {} x {} mm; accepted: "
                            "less than {} mm",
                            cutting.sheet_margin, cutting.sheet[0][0], cutting.sheet[0][1], side / 2));
        }
    }
}

std::string settings_of(const PrinterProfile& profile) {
    const CuttingProfile& c = profile.cutting;
    std::string sheet;
    for (const auto& row : c.sheet) sheet = fmt::format("{},{}", row[0], row[1]);
    return fmt::format(
        "{} cut one_file={} tolerance={} margin={} laser={} kerf={} ties={} tie_width={} numbers={} "
        "number_height={} next_outline={} sheet={} sheet_margin={}",
        profile.backend, profile.vector.one_file, profile.vector.tolerance, profile.vector.margin,
        static_cast<int>(c.laser), c.kerf, static_cast<int>(c.ties), c.tie_width, c.numbers, c.number_height,
        c.next_outline, sheet, c.sheet_margin);
}

/// Common base of the back-ends: planning, and the notes at the end.
class CutBackend : public Backend {
  public:
    CutBackend(const PrinterProfile& profile, std::shared_ptr<const SheetFormat> format)
        : profile_(profile), format_(std::move(format)) {
        check_settings(profile);
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<CutProduct>();
        product->plan = plan_cuts(job_, layer, profile_.cutting, profile_.vector.tolerance);
        product->area = product->plan.area;
        return product;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<CutProduct>(); }

    std::vector<std::string> notes() const override { return notes_.texts(profile_.cutting); }

  protected:
    JobStamp prepare(const Job& job, LayerRange range) {
        check_range(job, range);
        check_layer_heights(LayerHeights::equal, job.layers, range, "a sheet of material");
        if (job.supports) {
            throw InputError(
                "supports are not cut out of sheets; accepted: support.kind = \"none\", or another kind "
                "of printer, such as svg without kerf, laser, ties, numbers, next_outline and sheet");
        }
        job_ = job;
        return {job.identity, settings_of(profile_), range};
    }
    /// Counts a layer's peculiarities and returns its plan. Throws ConstraintError if the layer may not be
    /// cut.
    CutPlan take(const Layer& layer, LayerProduct& product) {
        CutPlan plan = std::move(dynamic_cast<CutProduct&>(product).plan);
        notes_.count(layer.index(), plan, profile_.cutting);
        return plan;
    }
    nlohmann::ordered_json describe(LayerRange range) const {
        nlohmann::ordered_json description = describe_job(job_, range, format_->extension());
        description["printer"] = profile_.name;
        description["tolerance"] = profile_.vector.tolerance;
        description["kerf"] = profile_.cutting.kerf;
        return description;
    }
    const PrinterProfile& profile() const { return profile_; }
    const SheetFormat& format() const { return *format_; }
    const Job& job() const { return job_; }

  private:
    PrinterProfile profile_;
    std::shared_ptr<const SheetFormat> format_;
    Job job_;
    CutNotes notes_;
};

void shift(CutPlan& plan, dvec2 by) {
    for (SheetPath& path : plan.paths) {
        for (dvec2& p : path.points) p += by;
    }
}

/// One sheet per layer, all of the same size.
class LayerSheets : public CutBackend {
  public:
    using CutBackend::CutBackend;

  protected:
    JobStamp open_page(const Job& job, LayerRange range) {
        JobStamp stamp = prepare(job, range);
        page_ = grown(job.bounds.rect(), profile().vector.margin + cut_allowance(profile().cutting));
        return stamp;
    }
    Sheet sheet_of(const Layer& layer, LayerProduct& product) {
        CutPlan plan = take(layer, product);
        shift(plan, -page_.lo);
        return {fmt::format("layer{:04}", layer.index()),
                fmt::format("{:04} z={}", layer.index(), format_number(layer.top(), 6)), page_.size(),
                std::move(plan.paths)};
    }
    const Rect& page() const { return page_; }

  private:
    Rect page_;
};

class LayerSheetFolder : public LayerSheets {
  public:
    LayerSheetFolder(const PrinterProfile& profile, const std::shared_ptr<const SheetFormat>& format,
                     const std::string& path, bool force)
        : LayerSheets(profile, format), output_(path, format->extension(), force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        const JobStamp stamp = open_page(job, range);
        description_ = describe(range);
        description_["width"] = page().size().x;
        description_["height"] = page().size().y;
        description_["placement"] = {{"left", page().lo.x}, {"top", page().hi.y}};
        return output_.begin(stamp, resume);
    }
    void write(const Layer& layer, LayerProduct& product) override {
        const std::string text = format().file(sheet_of(layer, product));
        output_.write(layer.index(), std::as_bytes(std::span(text)), product);
    }
    void finish() override { output_.end(description_); }

  private:
    UnfinishedFolder output_;
    nlohmann::ordered_json description_;
};

class LayerSheetFile : public LayerSheets {
  public:
    LayerSheetFile(const PrinterProfile& profile, const std::shared_ptr<const SheetFormat>& format,
                   const std::string& path, bool force)
        : LayerSheets(profile, format), output_(path, force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        const int next = output_.begin(open_page(job, range), resume);
        if (!output_.resumed()) output_.commit(format().start(page().size()), next);
        return next;
    }
    void write(const Layer& layer, LayerProduct& product) override {
        output_.commit(format().content(sheet_of(layer, product)), layer.index() + 1);
    }
    void finish() override { output_.end(format().end()); }

  private:
    UnfinishedFile output_;
};

class NestedSheets : public CutBackend {
  public:
    NestedSheets(const PrinterProfile& profile, const std::shared_ptr<const SheetFormat>& format,
                 const std::string& path, bool force)
        : CutBackend(profile, format),
          output_(path, format->extension(), force),
          size_(profile.cutting.sheet.front()[0], profile.cutting.sheet.front()[1]),
          shelves_(empty_sheet()) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        const JobStamp stamp = prepare(job, range);
        check_room(range);
        description_ = describe(range);
        description_["files"] = "sheet_%03d" + format().extension();
        description_["width"] = size_.x;
        description_["height"] = size_.y;
        description_["sheets"] = nlohmann::ordered_json::array();
        nlohmann::ordered_json& done = description_["sheets"];
        begun_ = range.first;
        last_ = range.last;
        const nlohmann::ordered_json found = output_.begin(stamp, resume);
        if (!found.is_array()) return begun_;
        for (const auto& sheet : found) {
            if (!output_.has(sheet.value("file", std::string()))) break;
            begun_ = sheet.value("end_layer", begun_);
            done.push_back(sheet);
        }
        return begun_;
    }

    void write(const Layer& layer, LayerProduct& product) override {
        CutPlan plan = take(layer, product);
        if (!plan.paths.empty()) {
            const dvec2 extent = plan.extent.size();
            auto corner = shelves_.place(extent);
            if (!corner) {
                if (shelves_.empty()) refuse(layer.index(), extent);
                finish_sheet(layer.index());
                corner = shelves_.place(extent);
                if (!corner) refuse(layer.index(), extent);
            }
            shift(plan, *corner - plan.extent.lo);
            std::ranges::move(plan.paths, std::back_inserter(paths_));
        }
        // The last sheet is written with the last layer, not in `end`, so that it is recorded.
        if (layer.index() + 1 == last_ && !shelves_.empty()) finish_sheet(last_);
    }

    void finish() override { output_.end(description_); }

  private:
    ShelfSheet empty_sheet() const { return {size_, profile().cutting.sheet_margin}; }

    /// Writes the current sheet, which holds the layers [begun_, next).
    void finish_sheet(int next) {
        nlohmann::ordered_json& done = description_["sheets"];
        const std::size_t number = done.size() + 1;
        order_by_purpose(paths_);
        const Sheet sheet{fmt::format("sheet{:03}", number),
                          fmt::format("sheet {}: layers {:04} to {:04}", number, begun_, next - 1), size_,
                          std::move(paths_)};
        const std::string file = fmt::format("sheet_{:03}{}", number, format().extension());
        done.push_back({{"file", file}, {"first_layer", begun_}, {"end_layer", next}});
        output_.commit(file, format().file(sheet), done);
        paths_.clear();
        shelves_ = empty_sheet();
        begun_ = next;
    }

    [[noreturn]] void refuse(int layer, dvec2 extent) const {
        const dvec2 available = usable_sheet_size(size_, profile().cutting.sheet_margin);
        throw InputError(fmt::format(
            "layer {} is {:.2f} x {:.2f} mm, and a sheet of {} x {} mm has room for {} x {} mm within its "
            "sheet_margin; accepted: a larger printer.sheet, or part.scale",
            layer, extent.x, extent.y, size_.x, size_.y, format_number(available.x, 4),
            format_number(available.y, 4)));
    }

    /// Throws before anything is written if a layer does not fit the sheet.
    void check_room(LayerRange range) const {
        const dvec2 available = usable_sheet_size(size_, profile().cutting.sheet_margin);
        const double allowance = cut_allowance(profile().cutting) + profile().vector.tolerance;
        const auto fits = [&](dvec2 size) { return size.x <= available.x && size.y <= available.y; };
        if (fits(grown(job().bounds.rect(), allowance).size())) return;
        for (int i = range.first; i < range.last; ++i) {
            const Layer layer(job(), i);
            const Rect rough = layer.part().bounds();
            if (rough.empty() || fits(grown(rough, allowance).size())) continue;
            const CutPlan plan = plan_cuts(job(), layer, profile().cutting, profile().vector.tolerance);
            if (!plan.extent.empty() && !fits(plan.extent.size())) refuse(i, plan.extent.size());
        }
    }

    UnfinishedFolder output_;
    dvec2 size_;
    ShelfSheet shelves_;
    std::vector<SheetPath> paths_;
    nlohmann::ordered_json description_;
    int begun_ = 0;  // first layer of the sheet being filled
    int last_ = 0;
};

}  // namespace

bool asks_for_cutting(const PrinterProfile& profile) {
    const CuttingProfile& c = profile.cutting;
    return c.laser != Laser::none || c.kerf != 0 || c.ties != Ties::none || c.numbers || c.next_outline ||
           !c.sheet.empty();
}

std::unique_ptr<Backend> make_layer_sheets(const PrinterProfile& profile,
                                           const std::shared_ptr<const SheetFormat>& format,
                                           const std::string& path, bool force) {
    if (profile.vector.one_file) return std::make_unique<LayerSheetFile>(profile, format, path, force);
    return std::make_unique<LayerSheetFolder>(profile, format, path, force);
}

std::unique_ptr<Backend> make_nested_sheets(const PrinterProfile& profile,
                                            const std::shared_ptr<const SheetFormat>& format,
                                            const std::string& path, bool force) {
    return std::make_unique<NestedSheets>(profile, format, path, force);
}

}  // namespace lamella
