// Selects the reader for a path, and reads image stacks.
#include "procedural/volume/volume.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <type_traits>

#include "engine/base/error.h"
#include "engine/io/image_file.h"
#include "procedural/volume/tiff_pages.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Removes the leading digits and returns them without leading zeros.
std::string_view take_number(std::string_view& text) {
    std::size_t end = 0, begin = 0;
    while (end < text.size() && is_digit(text[end])) ++end;
    while (begin + 1 < end && text[begin] == '0') ++begin;
    const std::string_view number = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return number;
}

/// Natural order: numbers in names compare by value, "2" before "10"; names that differ only in leading zeros
/// compare by bytes.
bool natural_less(const std::string& a, const std::string& b) {
    std::string_view s = a, t = b;
    while (!s.empty() && !t.empty()) {
        if (is_digit(s.front()) && is_digit(t.front())) {
            const std::string_view m = take_number(s), n = take_number(t);
            if (m.size() != n.size()) return m.size() < n.size();
            if (m != n) return m < n;
        } else if (s.front() != t.front()) {
            return s.front() < t.front();
        } else {
            s.remove_prefix(1);
            t.remove_prefix(1);
        }
    }
    if (s.empty() != t.empty()) return s.empty();
    return a < b;
}

/// Returns whether a name matches a pattern in which * stands for any characters and ? for one.
bool fits(std::string_view name, std::string_view pattern) {
    std::size_t n = 0, p = 0, star = pattern.npos, resume = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = n;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p;
            ++n;
        } else if (star != pattern.npos) {
            p = star + 1;
            n = ++resume;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

/// Returns the files of a folder whose names match, except hidden ones, in natural order.
std::vector<std::string> files_in(const fs::path& folder, const std::string& pattern) {
    std::error_code error;
    std::vector<std::string> names, files;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        std::error_code ignored;
        if (name.starts_with('.') || !entry->is_regular_file(ignored) || !fits(name, pattern)) continue;
        names.push_back(name);
    }
    if (error) throw InputError(folder.string() + ": cannot be read (" + error.message() + ")");
    std::sort(names.begin(), names.end(), natural_less);
    for (const std::string& name : names) files.push_back((folder / name).string());
    return files;
}

[[noreturn]] void reject_volume(const std::string& path, const std::string& what) {
    throw InputError(path + ": " + what);
}

/// Collects the pages of a stack, one after the other in memory.
class StackReader {
  public:
    StackReader(int channel, std::size_t expected_pages, bool as_picture)
        : channel_(channel), expected_(expected_pages), as_picture_(as_picture) {}

    /// Appends all pages of a file.
    void add(const std::string& path) {
        const auto input = open_images(path);
        if (!input) {
            reject_volume(path,
                          "this is no image that can be read; volumes are image stacks, multi-page TIFF "
                          "or NRRD files, and a folder must hold nothing but images of one size");
        }
        int page = 0;
        for (; const auto found = input->next_page(); ++page) add_page(*input, *found, path, page);
        std::ifstream file(path, std::ios::binary);
        const auto announced = count_tiff_pages(file, path);
        if (announced && *announced != static_cast<std::size_t>(page)) {
            reject_volume(path, "only " + std::to_string(page) + " of its " + std::to_string(*announced) +
                                    " pages can be read");
        }
    }

    Volume finish() {
        volume_.size[2] = pages_;
        return std::move(volume_);
    }

  private:
    void add_page(ImageReader& input, const ImagePage& image, const std::string& path, int page) {
        const auto fail = [&](const std::string& what) {
            reject_volume(path, (page > 0 ? "page " + std::to_string(page + 1) + ": " : "") + what);
        };
        if (image.width < 1 || image.height < 1) fail("the image has no pixels");
        if (image.depth > 1 || image.deep) fail("deep images and images with depth are not read");
        if (channel_ < 0 || channel_ >= image.channels) {
            fail("there is no channel " + std::to_string(channel_) + "; the image has " +
                 std::to_string(image.channels) + ", counted from 0");
        }
        if (pages_ == 0) start(image, path);
        if (size_of(image) != volume_size()) {
            fail("is " + text(size_of(image)) + " pixels large, the first page " + text(volume_size()));
        }
        if (image.stored_as != stored_as_) {
            fail("its samples are " + image.stored_as + ", those of the first page " + stored_as_);
        }
        check_total(pages_ + 1, path);
        std::visit(
            [&](auto& samples) {
                read_into(samples, input, channel_, fail);
                if (as_picture_ && image.channels >= 3 && (image.alpha < 0 || image.alpha >= 3))
                    mix_colours(samples, input, fail);
                if (as_picture_ && image.alpha >= 0) put_on_white(samples, input, image.alpha, fail);
            },
            volume_.samples);
        ++pages_;
    }

    using Size = std::array<std::size_t, 2>;
    static Size size_of(const ImagePage& image) {
        return {static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height)};
    }
    Size volume_size() const { return {volume_.size[0], volume_.size[1]}; }
    static std::string text(Size size) { return std::to_string(size[0]) + " x " + std::to_string(size[1]); }

    /// Adopts the size and type of the first page.
    void start(const ImagePage& image, const std::string& path) {
        stored_as_ = image.stored_as;
        volume_.size = {size_of(image)[0], size_of(image)[1], 0};
        if (image.samples == SampleType::u8) {
            volume_.samples = std::vector<std::uint8_t>();
            volume_.full_scale = 255;
        } else if (image.samples == SampleType::u16) {
            volume_.samples = std::vector<std::uint16_t>();
            volume_.full_scale = 65535;
        } else {
            volume_.samples = std::vector<float>();
        }
        check_total(expected_, path);
        const std::size_t total = volume_.size[0] * volume_.size[1] * expected_;
        std::visit([&](auto& samples) { samples.reserve(total); }, volume_.samples);
    }

    void check_total(std::size_t pages, const std::string& path) const {
        const std::size_t bytes_each =
            std::visit([](const auto& samples) { return sizeof samples[0]; }, volume_.samples);
        check_volume_size({volume_.size[0], volume_.size[1], pages}, bytes_each, path);
    }

    /// Reads one channel and reverses its rows: the lowest comes first.
    template <class T, class Fail>
    void read_into(std::vector<T>& samples, ImageReader& input, int channel, const Fail& fail) {
        const std::size_t width = volume_.size[0], height = volume_.size[1], begin = samples.size();
        samples.resize(begin + width * height);
        const std::string why = input.read_channel(channel, samples.data() + begin);
        if (!why.empty()) fail("cannot be read (" + why + ")");
        const auto row = [&](std::size_t y) {
            return samples.begin() + static_cast<std::ptrdiff_t>(begin + y * width);
        };
        for (std::size_t y = 0; 2 * y + 1 < height; ++y) {
            std::swap_ranges(row(y), row(y + 1), row(height - 1 - y));
        }
    }

    /// Turns red, the channel of the page that was read last, into the page's luma (Rec. ITU-R BT.709).
    template <class T, class Fail>
    void mix_colours(std::vector<T>& samples, ImageReader& input, const Fail& fail) {
        std::vector<T> green, blue;
        read_into(green, input, 1, fail);
        read_into(blue, input, 2, fail);
        T* const page = samples.data() + (samples.size() - green.size());
        for (std::size_t i = 0; i < green.size(); ++i) {
            const double luma = 0.2126 * static_cast<double>(page[i]) +
                                0.7152 * static_cast<double>(green[i]) +
                                0.0722 * static_cast<double>(blue[i]);
            page[i] = static_cast<T>(std::is_integral_v<T> ? luma + 0.5 : luma);
        }
    }

    /// Mixes the page that was read last with white, as far as its pixels are transparent.
    template <class T, class Fail>
    void put_on_white(std::vector<T>& samples, ImageReader& input, int alpha, const Fail& fail) {
        std::vector<T> opacity;
        read_into(opacity, input, alpha, fail);
        const double full = volume_.full_scale;
        T* const page = samples.data() + (samples.size() - opacity.size());
        for (std::size_t i = 0; i < opacity.size(); ++i) {
            const double share = static_cast<double>(opacity[i]) / full;
            const double mixed = full + (static_cast<double>(page[i]) - full) * share;
            page[i] = static_cast<T>(std::is_integral_v<T> ? mixed + 0.5 : mixed);
        }
    }

    int channel_;
    std::size_t expected_;
    bool as_picture_;
    std::size_t pages_ = 0;
    std::string stored_as_;  ///< type of the first page's samples
    Volume volume_;
};

bool is_nrrd(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    char magic[4] = {};
    return file.read(magic, 4) && std::string_view(magic, 4) == "NRRD";
}

}  // namespace

void check_volume_size(const std::array<std::size_t, 3>& size, std::size_t bytes_each,
                       const std::string& path) {
    std::uint64_t voxels = 1;
    for (const std::size_t side : size) {
        if (side > Volume::max_voxels || voxels * side > Volume::max_voxels) {
            reject_volume(path, "the volume is larger than 2,147,483,648 voxels; reduce its resolution");
        }
        voxels *= side;
    }
    if (voxels * bytes_each > Volume::max_bytes) {
        reject_volume(path,
                      "the volume takes more than 4 GiB of memory; reduce its resolution or store its "
                      "samples in a smaller type");
    }
}

void check_volume_box(const Box& box) {
    for (int i = 0; i < 3; ++i) {
        const bool finite = std::abs(box.lo[i]) <= 1e9 && std::abs(box.hi[i]) <= 1e9;
        if (!finite || !(box.lo[i] < box.hi[i])) {
            throw InputError(
                "the box of a volume must have three positive sides, within 1e9 mm of the origin");
        }
    }
}

namespace {

Volume read_stack(std::span<const std::string> files, int channel, bool as_picture) {
    if (files.empty()) throw InputError("an image stack needs at least one file");
    StackReader reader(channel, files.size(), as_picture);
    for (const std::string& file : files) reader.add(file);
    return reader.finish();
}

Volume read_any(const std::string& path, int channel, bool as_picture) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
        const auto files = files_in(path, "*");
        if (files.empty()) reject_volume(path, "the folder holds no files; a stack of images was expected");
        return read_stack(files, channel, as_picture);
    }
    if (!fs::exists(path, error)) {
        const fs::path pattern(path);
        const std::string name = pattern.filename().string();
        if (name.find_first_of("*?") == name.npos) reject_volume(path, "there is no such file or folder");
        const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
        const auto files = files_in(folder, name);
        if (files.empty()) reject_volume(path, "no file's name fits this pattern");
        return read_stack(files, channel, as_picture);
    }
    if (!is_nrrd(path)) return read_stack(std::vector<std::string>{path}, channel, as_picture);
    std::ifstream in(path, std::ios::binary);
    return read_nrrd(in, path, fs::path(path).parent_path().string());
}

}  // namespace

Volume read_image_stack(std::span<const std::string> files, int channel) {
    return read_stack(files, channel, false);
}

Volume read_volume(const std::string& path, int channel) { return read_any(path, channel, false); }

Volume read_picture(const std::string& path) { return read_any(path, 0, true); }

}  // namespace lamella
