// Header, layers and footer of a GOO file; numbers are big-endian.
#include "printers/masks/goo.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <string_view>

#include "engine/base/error.h"
#include "printers/archive/unfinished_file.h"
#include "printers/common/thumbnail.h"
#include "printers/masks/goo_rle.h"
#include "printers/masks/png_mask.h"
#include "printers/masks/resin.h"

namespace lamella {
namespace {

constexpr std::string_view magic("\x07\x00\x00\x00\x44\x4c\x50\x00", 8);
constexpr std::string_view line_end = "\r\n";
constexpr int small_preview = 116, large_preview = 290;  // px

/// Appends big-endian numbers.
class BigEndian {
  public:
    void u8(std::uint32_t v) { put(v, 1); }
    void u16(std::uint32_t v) { put(v, 2); }
    void u32(std::uint32_t v) { put(v, 4); }
    void f32(double v) { put(std::bit_cast<std::uint32_t>(static_cast<float>(v)), 4); }
    void raw(std::string_view bytes) { text_ += bytes; }
    /// Appends a text that is truncated or padded with zeros to `size` bytes; the last byte is zero.
    void text(std::string_view t, std::size_t size) {
        t = t.substr(0, size - 1);
        text_ += t;
        text_.append(size - t.size(), '\0');
    }
    void zeros(std::size_t count) { text_.append(count, '\0'); }
    std::string take() { return std::move(text_); }

  private:
    void put(std::uint32_t v, int bytes) {
        while (bytes-- > 0) text_.push_back(static_cast<char>(v >> (8 * bytes) & 0xffU));
    }
    std::string text_;
};

class Goo : public Backend {
  public:
    Goo(const PrinterProfile& profile, const std::string& path, bool force)
        : profile_(profile), resin_(profile_.resin), output_(path, force) {}
    Goo(const Goo&) = delete;
    Goo& operator=(const Goo&) = delete;

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        check_resin_profile(resin_, job.layers.greatest_height());
        layout_.emplace(profile_.image, job.bounds);
        layers_ = job.layers;
        range_ = range;
        if (resin_.preview) picture_ = job.picture;
        const std::string settings =
            "goo " + mask_settings(profile_, job) + " " + profile_.name + " " + describe_resin(resin_);
        const int next = output_.begin({job.identity, settings, range}, resume);
        if (output_.resumed()) {
            output_.restore([&](const auto& state) { volume_ = state.at(0).template get<double>(); });
        } else {
            output_.commit(header({}), next, {volume_});
        }
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<MaskFile>();
        GooEncoder encoder;
        const MaskArea area =
            mask_layer(layer, *layout_, profile_.image, profile_.support.grey,
                       [&](std::span<const GreyRun> runs, int /*rows*/) { encoder.add(runs); });
        product->area = area.part;
        product->support_area = area.supports;
        product->file = encoder.finish();
        return product;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<MaskFile>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        const auto& code = dynamic_cast<MaskFile&>(product).file;
        volume_ += (product.area + product.support_area) * layer.thickness();
        const int index = layer.index() - range_.first;
        BigEndian out;
        out.u16(0);  // no pause
        out.f32(0);
        out.f32(layers_.height(range_.first, layer.index() + 1));
        out.f32(resin_exposure(resin_, index, layer.thickness()));
        out.f32(0);  // light-off delay: replaced by the waits below
        put_waits(out);
        put_moves(out);
        out.u16(resin_.light);
        out.raw(line_end);
        out.u32(static_cast<std::uint32_t>(code.size()));
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text for the file
        out.raw({reinterpret_cast<const char*>(code.data()), code.size()});
        out.raw(line_end);
        output_.commit(out.take(), layer.index() + 1, {volume_});
    }

    void finish() override {
        output_.rewrite_start(header(picture_ ? picture_(large_preview) : Picture()));
        BigEndian out;
        out.zeros(3);
        out.raw(magic);
        output_.end(out.take());
    }

  private:
    /// Waits before and after lifting, and after retracting.
    static void put_waits(BigEndian& out) {
        for (int k = 0; k < 3; ++k) out.f32(0);
    }
    /// Distance and speed of lifting and retracting, each in two stages; the second stage is unused.
    void put_moves(BigEndian& out) const {
        for (const double speed : {resin_.lift_speed, 0.0, resin_.retract_speed, 0.0}) {
            out.f32(speed > 0 ? resin_.lift : 0);
            out.f32(speed);
        }
    }
    /// The same moves for first layers and others, in the header's order: one stage at a time.
    void put_header_moves(BigEndian& out) const {
        for (const double speed :
             {resin_.lift_speed, resin_.lift_speed, resin_.retract_speed, resin_.retract_speed}) {
            out.f32(resin_.lift);
            out.f32(speed);
        }
        for (int k = 0; k < 8; ++k) out.f32(0);
    }

    /// Returns the header. The preview is black where the picture is empty.
    std::string header(const Picture& preview) const {
        const ImageProfile& image = profile_.image;
        const bool swapped = layout_->width() != image.width;
        constexpr double mm3_per_ml = 1000;
        BigEndian out;
        out.raw("V3.0");
        out.raw(magic);
        out.text("Lamella", 32);
        out.text(LAMELLA_VERSION, 24);
        out.text("1980-01-01 00:00:00", 24);
        out.text(machine_name(profile_), 32);
        out.text("DLP", 32);
        out.text(resin_.material, 32);
        out.u16(image.antialiasing == Antialiasing::rows ? static_cast<std::uint32_t>(image.sub_rows) : 1);
        out.u16(0);  // grey level and blur: the masks are final
        out.u16(0);
        for (const int size : {small_preview, large_preview}) {
            const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
            out.raw(preview.rgb.empty() ? std::string(2 * pixels, '\0') : rgb565(shrunk(preview, size)));
            out.raw(line_end);
        }
        out.u32(static_cast<std::uint32_t>(range_.count()));
        out.u16(static_cast<std::uint32_t>(layout_->width()));
        out.u16(static_cast<std::uint32_t>(layout_->height()));
        out.u8(0);  // the masks are already mirrored
        out.u8(0);
        const double x = image.width * image.pixel_x, y = image.height * image.pixel_y;
        out.f32(swapped ? y : x);
        out.f32(swapped ? x : y);
        out.f32(layers_.height(range_.first, range_.last));
        out.f32(layers_.greatest_height());
        // For readers that know one exposure alone; each layer has its own.
        const double usual_height = layers_.height(range_.first + range_.count() / 2);
        out.f32(resin_for_height(resin_, usual_height).exposure);
        out.u8(1);   // waits are static
        out.f32(0);  // light-off delay
        put_waits(out);
        put_waits(out);
        out.f32(resin_exposure(resin_, 0, layers_.height(range_.first)));
        out.u32(static_cast<std::uint32_t>(resin_.first_layers));
        put_header_moves(out);
        out.u16(resin_.light);
        out.u16(resin_.light);
        out.u8(1);  // each layer's own values apply
        out.u32(static_cast<std::uint32_t>(resin_print_time(resin_, layers_, range_)));
        out.f32(volume_);
        out.f32(volume_ / mm3_per_ml * profile_.support.density);
        out.f32(0);  // price
        out.text("", 8);
        out.u32(static_cast<std::uint32_t>(goo_header_size));
        out.u8(1);  // 256 greys
        out.u16(static_cast<std::uint32_t>(resin_.fade_layers));
        return out.take();
    }

    PrinterProfile profile_;
    const ResinProfile& resin_;
    UnfinishedFile output_;
    std::optional<MaskLayout> layout_;
    std::function<Picture(int)> picture_;
    LayerPlan layers_;
    LayerRange range_;
    double volume_ = 0;  ///< mm^3
};

}  // namespace

std::unique_ptr<Backend> make_goo(const PrinterProfile& profile, const std::string& path, bool force) {
    return std::make_unique<Goo>(profile, path, force);
}

}  // namespace lamella
