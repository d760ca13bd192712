// Unpacks and decodes sheets one by one.
#include "procedural/volume/image_stack_3mf.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/io/image_file.h"

namespace lamella {
namespace {

constexpr int alpha = 3;

/// Collects one channel of the sheets, bottom to top.
class SheetReader {
  public:
    SheetReader(const ImageStack& stack, int channel, const std::string& where)
        : stack_(stack), channel_(channel), where_(where) {}

    /// Returns false if the images have no such channel.
    bool add(const std::string& part, std::string_view bytes) {
        const auto fail = [&](const std::string& what) {
            throw InputError(where_ + ": sheet " + excerpt(part) + " " + what);
        };
        std::string why;
        const auto input = open_images("sheet.png", bytes, why);
        if (!input) fail("is no PNG image that can be read (" + why + ")");
        const auto page = input->next_page();
        if (!page) fail("holds no image");
        if (page->width != stack_.columns || page->height != stack_.rows) {
            fail("has " + std::to_string(page->height) + " rows and " + std::to_string(page->width) +
                 " columns; the imagestack says " + std::to_string(stack_.rows) + " and " +
                 std::to_string(stack_.columns));
        }
        if (page->channels < 1 || page->channels > 4 || page->depth > 1 || page->deep)
            fail("is neither grey nor in colours");
        if (sheets_ == 0) start(*page);
        if (page->channels != channels_ || page->stored_as != stored_as_)
            fail("has other channels or bits than the first one");
        const int source = place_of(page->channels);
        if (source < 0) return false;
        std::visit([&](auto& samples) { read_into(samples, *input, source, fail); }, volume_.samples);
        ++sheets_;
        return true;
    }

    Volume finish() {
        volume_.size = {static_cast<std::size_t>(stack_.columns), static_cast<std::size_t>(stack_.rows),
                        sheets_};
        return std::move(volume_);
    }

  private:
    /// Returns the image's channel that holds the requested one; negative if there is none.
    int place_of(int channels) const {
        const bool grey = channels <= 2;
        if (channel_ == alpha) return channels % 2 == 0 ? channels - 1 : -1;
        return grey ? 0 : channel_;
    }

    void start(const ImagePage& page) {
        channels_ = page.channels;
        stored_as_ = page.stored_as;
        if (page.samples == SampleType::u8) {
            volume_.samples = std::vector<std::uint8_t>();
            volume_.full_scale = 255;
        } else if (page.samples == SampleType::u16) {
            volume_.samples = std::vector<std::uint16_t>();
            volume_.full_scale = 65535;
        } else {
            volume_.samples = std::vector<float>();
        }
        const auto columns = static_cast<std::size_t>(stack_.columns);
        const auto rows = static_cast<std::size_t>(stack_.rows);
        std::visit(
            [&](auto& samples) {
                check_volume_size({columns, rows, stack_.sheets.size()}, sizeof samples[0], where_);
            },
            volume_.samples);
    }

    /// Reads a sheet and reverses its rows: the lowest comes first.
    template <class T, class Fail>
    void read_into(std::vector<T>& samples, ImageReader& input, int source, const Fail& fail) {
        const auto width = static_cast<std::size_t>(stack_.columns);
        const auto height = static_cast<std::size_t>(stack_.rows);
        const std::size_t begin = samples.size();
        samples.resize(begin + width * height);
        const std::string why = input.read_channel(source, samples.data() + begin);
        if (!why.empty()) fail("cannot be read (" + why + ")");
        const auto row = [&](std::size_t y) {
            return samples.begin() + static_cast<std::ptrdiff_t>(begin + y * width);
        };
        for (std::size_t y = 0; 2 * y + 1 < height; ++y)
            std::swap_ranges(row(y), row(y + 1), row(height - 1 - y));
    }

    const ImageStack& stack_;
    int channel_;
    const std::string& where_;
    std::size_t sheets_ = 0;
    int channels_ = 0;
    std::string stored_as_;
    Volume volume_;
};

}  // namespace

std::optional<Volume> read_image_stack(OpcPackage& package, const ImageStack& stack, int channel,
                                       const std::string& where) {
    SheetReader reader(stack, channel, where);
    for (const std::string& part : stack.sheets) {
        if (!reader.add(part, package.read(part))) return std::nullopt;
    }
    return reader.finish();
}

}  // namespace lamella
