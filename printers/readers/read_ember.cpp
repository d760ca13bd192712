// Ember archives: a tar.gz, which has no directory and is therefore read from end to end.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>

#include "engine/base/error.h"
#include "engine/base/json_depth.h"
#include "printers/readers/job_number.h"
#include "printers/readers/job_readers.h"
#include "printers/readers/mask_decoder.h"

namespace lamella {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t ember_block = 512;
constexpr std::uint64_t max_kept = std::uint64_t{1} << 30U;  // bytes of all files together
constexpr double ember_pixel = 0.05;                         // mm; pixel of the machine's projector

/// Reads the uncompressed bytes of a gzip file with any number of members.
class GzipReader {
  public:
    explicit GzipReader(const std::string& path) : path_(path), file_(gzopen(path.c_str(), "rb"), gzclose_r) {
        if (!file_) throw InputError(path + ": cannot be opened");
    }

    /// Fills `bytes`. Throws InputError if there are fewer left.
    void read(char* bytes, std::size_t count) {
        while (count > 0) {
            constexpr std::size_t most = std::size_t{1} << 20U;
            const int got = gzread(file_.get(), bytes, static_cast<unsigned>(std::min(count, most)));
            if (got <= 0) fail();
            bytes += got;
            count -= static_cast<std::size_t>(got);
        }
    }

    /// Reads the padding after the last record, so that the end of the stream is checked as well.
    void finish() {
        constexpr int most = 1 << 20;
        std::string filling(most, '\0');
        const int got = gzread(file_.get(), filling.data(), most);
        int code = Z_OK;
        gzerror(file_.get(), &code);
        if (got < 0 || code < Z_OK) fail();
        if (got == most) throw InputError(path_ + ": there is something behind the archive's end");
    }

  private:
    [[noreturn]] void fail() const {
        int code = Z_OK;
        const std::string why = gzerror(file_.get(), &code);
        throw InputError(path_ + ": the archive cannot be unpacked to its end (" +
                         (code == Z_OK || code == Z_STREAM_END ? "it ends early" : why) +
                         "); the file is damaged or cut off");
    }

    std::string path_;
    std::unique_ptr<gzFile_s, int (*)(gzFile)> file_;
};

class EmberFile : public JobFile {
  public:
    explicit EmberFile(const std::string& path) : path_(path) {
        facts_.format = "Ember archive";
        facts_.machine = "Autodesk Ember";
        read_members();
        read_settings();
        while (files_.contains(image(facts_.layers))) ++facts_.layers;
        const auto slices =
            std::ranges::count_if(files_, [](const auto& file) { return file.first.ends_with(".png"); });
        // The machine counts the images and then requests them by number.
        if (facts_.layers == 0 || facts_.layers != slices) {
            throw InputError(fmt::format("{}: layer {} ({}) is missing: {} images are there", path_,
                                         facts_.layers, image(facts_.layers), slices));
        }
        const MaskSize size = image_size("layer.png", files_.at(image(0)), where(0));
        facts_.width = size.width;
        facts_.height = size.height;
        facts_.pixel_x = facts_.pixel_y = ember_pixel;
    }

    MaskImage layer(int index) const override {
        if (index < 0 || index >= layers()) throw InputError(where(index) + ": there is no such layer");
        return decode_mask("layer.png", files_.at(image(index)), {facts_.width, facts_.height},
                           MaskPacking::plain, where(index));
    }

  private:
    static std::string image(int index) { return fmt::format("slice_{}.png", index + 1); }
    std::string where(int index) const {
        return fmt::format("{}: layer {} ({})", path_, index, image(index));
    }
    [[noreturn]] void reject(const std::string& why) const { throw InputError(path_ + ": " + why); }

    /// Parses a field of octal digits that may be surrounded by blanks and ends with a zero byte.
    std::uint64_t octal(std::string_view field) const {
        const std::size_t first = field.find_first_not_of(' ');
        field.remove_prefix(std::min(first, field.size()));
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value, 8);
        const bool closed = end == field.data() + field.size() || *end == '\0' || *end == ' ';
        if (error != std::errc{} || !closed) reject("it is no tape archive: a header's number is none");
        return value;
    }

    void check_sum(std::string_view header) const {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < ember_block; ++i)
            sum += i >= 148 && i < 156 ? ' ' : static_cast<unsigned char>(header[i]);
        if (octal(header.substr(148, 8)) != sum)
            reject("it is no tape archive, or a header of it is damaged");
    }

    void read_members() {
        GzipReader in(path_);
        std::uint64_t kept = 0;
        std::array<char, ember_block> bytes{};
        for (int empty = 0; empty < 2;) {
            in.read(bytes.data(), ember_block);
            const std::string_view header(bytes.data(), ember_block);
            if (header.find_first_not_of('\0') == std::string_view::npos) {
                ++empty;
                continue;
            }
            empty = 0;
            check_sum(header);
            const std::uint64_t size = octal(header.substr(124, 12));
            std::string name(header.substr(0, std::min(header.find('\0'), std::size_t{100})));
            if (name.starts_with("./")) name.erase(0, 2);
            const char kind = header[156];
            if (size > max_kept || (kept += size + ember_block) > max_kept)
                reject("it unpacks to more than 1 GiB, the most that is read of an Ember archive");
            std::string content = read_content(in, size);
            if ((kind == '0' || kind == '\0') && !name.empty())
                files_.insert_or_assign(name, std::move(content));
        }
        in.finish();
    }

    /// The buffer grows with the bytes actually read, because the stated size may be wrong.
    static std::string read_content(GzipReader& in, std::uint64_t size) {
        std::string content;
        while (content.size() < size) {
            const std::size_t used = content.size();
            const auto step =
                static_cast<std::size_t>(std::min<std::uint64_t>(size - used, std::uint64_t{1} << 20U));
            content.resize(used + step);
            in.read(content.data() + used, step);
        }
        std::array<char, ember_block> filling{};
        in.read(filling.data(), (ember_block - size % ember_block) % ember_block);
        return content;
    }

    void read_settings() {
        const auto found = files_.find("printsettings");
        if (found == files_.end()) reject("'printsettings' is missing in the archive");
        const Json json = Json::parse(shallow_json(found->second), nullptr, false);
        if (!json.is_object() || !json.contains("Settings") || !json["Settings"].is_object())
            reject("'printsettings' is no JSON object with \"Settings\"");
        const Json& settings = json["Settings"];
        facts_.name = text_of(settings, "JobName");
        if (const auto thickness = positive_or_none(number_of(settings, "LayerThicknessMicrons")))
            facts_.layer_height = *thickness * micrometre;
        facts_.exposure = positive_or_none(number_of(settings, "ModelExposureSec"));
        facts_.first_exposure = positive_or_none(number_of(settings, "FirstExposureSec"));
        if (const auto burn_in = count_or_none(number_of(settings, "BurnInLayers")))
            facts_.first_layers = *burn_in + 1;
    }

    std::string path_;
    std::map<std::string, std::string> files_;
};

}  // namespace

std::unique_ptr<JobFile> read_ember(const std::string& path) { return std::make_unique<EmberFile>(path); }

}  // namespace lamella
