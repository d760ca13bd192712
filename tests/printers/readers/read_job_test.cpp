// What is written is read back pixel for pixel, and hostile files get a message that names them.
#include "printers/readers/read_job.h"

#include <zip.h>
#include <zlib.h>

#include <catch2/catch.hpp>
#include <functional>
#include <random>

#include "engine/base/error.h"
#include "printers/archive/tar_gzip.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/masks/resin_job.h"

namespace read_job_test {

using namespace lamella;
using namespace lamella::test;

namespace {

/// Back-ends and the endings of what they write; a folder has none.
struct Written {
    const char* backend;
    const char* ending;
};
constexpr Written all_kinds[] = {
    {"sl1", ".sl1s"}, {"goo", ".goo"}, {"nanodlp", ".nanodlp"}, {"ember", ".tar.gz"}, {"png", ""}};

std::string write_job(const TemporaryFolder& folder, const Written& kind, const Job& job,
                      const PrinterProfile& profile) {
    const std::string path = folder / ("job" + std::string(kind.ending));
    run_layers(job, *make_backend(profile, path, true), {0, job.layers.count()});
    return path;
}

std::string write_job(const TemporaryFolder& folder, const Written& kind, int layers = 12) {
    return write_job(folder, kind, two_cones(layers), small_machine(kind.backend));
}

/// Opens a job and decodes every layer.
void read_all(const std::string& path) {
    const auto job = open_job(path);
    for (int k = 0; k < job->layers(); ++k) job->layer(k);
}

/// The message of the InputError that reading everything ends with; it names the file. "" where all is read.
std::string complaint(const std::string& path) {
    try {
        read_all(path);
        return "";
    } catch (const InputError& error) {
        CHECK(std::string(error.what()).find(path) != std::string::npos);
        return error.what();
    }
}

/// An archive of entries as an archiver would make it.
void write_zip(const std::string& path, const std::vector<std::pair<std::string, std::string>>& entries) {
    int error = 0;
    zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
    REQUIRE(zip != nullptr);
    for (const auto& [name, content] : entries) {
        zip_source_t* source = zip_source_buffer(zip, content.data(), content.size(), 0);
        REQUIRE(zip_file_add(zip, name.c_str(), source, ZIP_FL_OVERWRITE) >= 0);
    }
    REQUIRE(zip_close(zip) == 0);
}

/// Writes an archive's entries anew after a change.
std::string changed_zip(const TemporaryFolder& folder, const std::string& path,
                        const std::function<void(std::string& name, std::string& content)>& change) {
    auto entries = read_zip(path);
    for (auto& [name, content] : entries) change(name, content);
    std::erase_if(entries, [](const auto& entry) { return entry.first.empty(); });
    const std::string changed = folder / ("changed" + path.substr(path.rfind('.')));
    write_zip(changed, entries);
    return changed;
}

void replace(std::string& text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
}

void put_number(std::string& bytes, std::size_t at, std::uint32_t value, int size) {
    while (size-- > 0) bytes.at(at++) = static_cast<char>(value >> (8 * size) & 0xffU);
}

constexpr std::size_t goo_count = 195310, goo_width = 195314, goo_layers = 195477;

/// A GOO file of one layer whose code is this, with its checksum.
std::string goo_with_code(const TemporaryFolder& folder, const std::string& chunks) {
    const std::string path = write_job(folder, {"goo", ".goo"}, 1);
    std::string bytes = read_text(path).substr(0, goo_layers + 66);
    unsigned sum = 0;
    for (const char c : chunks) sum += static_cast<unsigned char>(c);
    const std::string code = "\x55" + chunks + static_cast<char>(~sum & 0xffU);
    bytes += std::string(4, '\0') + code + "\r\n" + std::string("\0\0\0\x07\0\0\0DLP\0", 11);
    put_number(bytes, goo_layers + 66, static_cast<std::uint32_t>(code.size()), 4);
    put_number(bytes, goo_width, 8, 2);
    put_number(bytes, goo_width + 2, 2, 2);
    write_text(path, bytes);
    return path;
}

std::string ember_of(const TemporaryFolder& folder, const std::string& tar) {
    const std::string path = folder / "made.tar.gz";
    write_text(path, gzip_member(tar));
    return path;
}

const char* const ember_settings = "{\"Settings\": {\"LayerThicknessMicrons\": 50}}";

}  // namespace

TEST_CASE("every format is read back pixel for pixel", "[read-job]") {
    for (const Written& kind : all_kinds) {
        for (const bool portrait : {false, true}) {
            if (portrait && std::string(kind.backend) == "ember") continue;
            INFO(kind.backend << " portrait " << portrait);
            const TemporaryFolder folder;
            PrinterProfile profile = small_machine(kind.backend);
            profile.image.portrait = portrait;
            const auto job = open_job(write_job(folder, kind, two_cones(), profile));
            const std::vector<DecodedImage> stack = stack_of(two_cones(), profile);
            REQUIRE(job->layers() == 12);
            CHECK(job->facts().width == stack[0].width);
            CHECK(job->facts().height == stack[0].height);
            for (int k = 0; k < 12; ++k) {
                const MaskImage mask = job->layer(k);
                CHECK(mask.width == stack[0].width);
                CHECK(mask.height == stack[0].height);
                CHECK(mask.pixels == stack[static_cast<std::size_t>(k)].pixels);
            }
        }
    }
}

TEST_CASE("a job tells its heights, pixels and exposures", "[read-job]") {
    for (const Written& kind : all_kinds) {
        INFO(kind.backend);
        const TemporaryFolder folder;
        const auto job = open_job(write_job(folder, kind));
        const JobFacts& facts = job->facts();
        CHECK(*facts.layer_height == Approx(0.5));
        CHECK(*facts.pixel_x == Approx(0.05));
        CHECK(*facts.pixel_y == Approx(0.05));
        CHECK(!facts.format.empty());
        CHECK(facts.notes.empty());
        if (std::string(kind.backend) == "png") continue;
        CHECK(*facts.exposure == Approx(2.5));
        CHECK(*facts.first_exposure == Approx(25));
        CHECK(*facts.first_layers == (std::string(kind.backend) == "sl1" ? 3 : 4));
        if (std::string(kind.backend) == "ember") continue;
        CHECK(*facts.fade_layers == 3);
        CHECK(*facts.print_time > 12 * 2.5);
        double volume = 0;
        for (int k = 0; k < 12; ++k) {
            for (const std::uint8_t grey : job->layer(k).pixels) volume += grey / 255.0 * 0.05 * 0.05 * 0.5;
        }
        CHECK(*facts.volume == Approx(volume).epsilon(2e-3));
    }
}

TEST_CASE("a file that is cut off anywhere is refused", "[read-job]") {
    for (const Written& kind : all_kinds) {
        if (std::string(kind.ending).empty()) continue;
        INFO(kind.backend);
        const TemporaryFolder folder;
        const std::string path = write_job(folder, kind, 4);
        const std::string bytes = read_text(path);
        std::mt19937 random(7);
        std::vector<std::size_t> cuts{
            0, 1, 2, 3, 4, 11, 12, 13, bytes.size() - 1, bytes.size() - 2, bytes.size() - 22};
        for (int i = 0; i < 150; ++i) cuts.push_back(random() % bytes.size());
        const std::string cut = folder / ("cut" + std::string(kind.ending));
        for (const std::size_t size : cuts) {
            INFO("cut to " << size << " of " << bytes.size() << " bytes");
            write_text(cut, bytes.substr(0, size));
            CHECK(!complaint(cut).empty());
        }
    }
}

TEST_CASE("bytes that were changed are refused or do no harm", "[read-job]") {
    for (const Written& kind : all_kinds) {
        if (std::string(kind.ending).empty()) continue;
        INFO(kind.backend);
        const TemporaryFolder folder;
        const std::string path = write_job(folder, kind, 3);
        const std::string bytes = read_text(path);
        std::mt19937 random(11);
        const std::string other = folder / ("other" + std::string(kind.ending));
        int refused = 0;
        for (int i = 0; i < 300; ++i) {
            std::string changed = bytes;
            // The header of a GOO file is mostly previews: most changes shall hit the rest.
            const std::size_t from = std::string(kind.backend) == "goo" && i % 4 != 0 ? goo_count : 0;
            const std::size_t at = from + random() % (bytes.size() - from);
            changed[at] = static_cast<char>(changed[at] ^ (1U << random() % 8));
            write_text(other, changed);
            if (!complaint(other).empty()) ++refused;
        }
        CHECK(refused > 100);
    }
}

TEST_CASE("a layer that is missing is named", "[read-job]") {
    const TemporaryFolder folder;
    for (const auto& [backend, ending, file] :
         {std::tuple("sl1", ".sl1", "two_cones00002.png"), std::tuple("nanodlp", ".nanodlp", "3.png")}) {
        const std::string path = write_job(folder, {backend, ending}, 5);
        const std::string less = changed_zip(folder, path, [&](std::string& name, std::string&) {
            if (name == file) name.clear();
        });
        CHECK_THAT(complaint(less), Catch::Contains("layer 2 (" + std::string(file) + ") is missing"));
    }
    const std::string stack = write_job(folder, {"png", ""}, 5);
    std::filesystem::remove(stack + "/00003.png");
    CHECK_THAT(complaint(stack), Catch::Contains("layer 3 (00003.png) is missing"));
    std::filesystem::remove(stack + "/job.json");
    CHECK_THAT(complaint(stack), Catch::Contains("holds no job.json"));
}

TEST_CASE("archives that lie about what they hold are refused", "[read-job]") {
    const TemporaryFolder folder;
    const std::string sl1 = write_job(folder, {"sl1", ".sl1"}, 5);
    const auto with = [&](const std::string& entry, const std::string& from, const std::string& to) {
        return complaint(changed_zip(folder, sl1, [&](std::string& name, std::string& content) {
            if (name == entry) replace(content, from, to);
        }));
    };
    CHECK(with("config.ini", "hollow = 0", "hollow = 0").empty());
    CHECK_THAT(with("config.ini", "numFast = 5", "numFast = 6"), Catch::Contains("layer 5"));
    CHECK_THAT(with("config.ini", "jobDir = two_cones", "jobDir ="), Catch::Contains("no jobDir"));
    CHECK_THAT(with("config.ini", "jobDir = two_cones", "jobDir = other"), Catch::Contains("is missing"));
    CHECK_THAT(with("config.ini", "layerHeight = 0.5", "layerHeight = thick"),
               Catch::Contains("is no number"));
    CHECK_THAT(with("prusaslicer.ini", "display_pixels_x = 300", "display_pixels_x = 301"),
               Catch::Contains("layer 0") && Catch::Contains("280 x 301 px are expected"));
    CHECK(complaint(changed_zip(folder, sl1, [](std::string& name, std::string&) {
              if (name == "prusaslicer.ini") name.clear();
          })).empty());
    CHECK_THAT(complaint(changed_zip(folder, sl1,
                                     [](std::string& name, std::string& content) {
                                         if (name == "config.ini") content += std::string(3 << 20, '\n');
                                     })),
               Catch::Contains("unpacks to more than 1048576 bytes"));
    const auto more = open_job(changed_zip(folder, sl1, [](std::string& name, std::string& content) {
        if (name == "config.ini") replace(content, "numFast = 5", "numFast = 4");
    }));
    CHECK(more->layers() == 5);
    CHECK(more->facts().notes.size() == 1);
    const std::string other = folder / "other.sl1";
    write_zip(other, {{"readme.txt", "nothing to print"}});
    CHECK_THAT(complaint(other), Catch::Contains("neither config.ini"));
    const std::string nano = write_job(folder, {"nanodlp", ".nanodlp"}, 5);
    CHECK_THAT(complaint(changed_zip(folder, nano,
                                     [](std::string& name, std::string& content) {
                                         if (name == "plate.json") content = "[1, 2";
                                     })),
               Catch::Contains("'plate.json' is no JSON object"));
    CHECK_THAT(complaint(changed_zip(folder, nano,
                                     [](std::string& name, std::string& content) {
                                         if (name == "2.png") content = "no image";
                                     })),
               Catch::Contains("layer 1 (2.png)"));
}

TEST_CASE("a mask that claims more pixels than any display has is not unpacked", "[read-job]") {
    const TemporaryFolder folder;
    const std::string sl1 = write_job(folder, {"sl1", ".sl1"}, 2);
    const std::string huge = changed_zip(folder, sl1, [](std::string& name, std::string& content) {
        if (!name.ends_with("00001.png")) return;
        put_number(content, 16, 65000, 4);
        put_number(content, 20, 65000, 4);
        put_number(content, 29,
                   static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(&content[12]), 17)), 4);
    });
    CHECK_THAT(complaint(huge), Catch::Contains("00001.png") && Catch::Contains("65000 x 65000 px"));
}

TEST_CASE("a GOO header that lies is refused", "[read-job]") {
    const TemporaryFolder folder;
    const std::string path = write_job(folder, {"goo", ".goo"}, 3);
    const std::string bytes = read_text(path);
    const auto with = [&](std::size_t at, std::uint32_t value, int size) {
        std::string changed = bytes;
        put_number(changed, at, value, size);
        write_text(path, changed);
        return complaint(path);
    };
    CHECK_THAT(with(goo_count, 0xffffffffU, 4), Catch::Contains("4294967295 layers"));
    CHECK_THAT(with(goo_count, 0, 4), Catch::Contains("no layers"));
    CHECK_THAT(with(goo_count, 4, 4), Catch::Contains("layer 3"));
    CHECK_THAT(with(goo_count, 2, 4), Catch::Contains("its end is missing"));
    CHECK_THAT(with(goo_width, 0, 2), Catch::Contains("0 x 300 px"));
    CHECK_THAT(with(goo_width, 65535, 2), Catch::Contains("layer 0"));
    CHECK_THAT(with(goo_layers - 7, 12, 4), Catch::Contains("begin at byte 12"));
    CHECK_THAT(with(goo_layers + 66, 0xfffffff0U, 4), Catch::Contains("layer 0"));
    CHECK(with(goo_layers - 7, goo_layers, 4).empty());
}

TEST_CASE("GOO codes are read as the specification tells, and no further", "[read-job]") {
    const TemporaryFolder folder;
    const auto pixels = [&](const std::string& chunks) {
        return open_job(goo_with_code(folder, chunks))->layer(0).pixels;
    };
    const auto wrong = [&](const std::string& chunks) { return complaint(goo_with_code(folder, chunks)); };
    using Greys = std::vector<std::uint8_t>;
    // 16 pixels: three black, four white, a grey of 100 twice, then differences of +15 (twice) and -1, white.
    CHECK(pixels(std::string("\x03\xc4\x42\x64\x9f\x02\xa1\xc4", 8)) ==
          Greys{0, 0, 0, 255, 255, 255, 255, 100, 100, 115, 115, 114, 255, 255, 255, 255});
    // A run of 16 in two bytes: low four bits 0 in the first one, 1 in the second.
    CHECK(pixels(std::string("\xd0\x01", 2)) == Greys(16, 255));
    CHECK(pixels(std::string("\xe0\x00\x01", 3)) == Greys(16, 255));
    CHECK(pixels(std::string("\xf0\x00\x00\x01", 4)) == Greys(16, 255));
    CHECK_THAT(wrong(std::string("\xd1\x01", 2)), Catch::Contains("goes beyond the image"));
    CHECK_THAT(wrong(std::string("\xff\xff\xff\xff", 4)), Catch::Contains("goes beyond the image"));
    CHECK_THAT(wrong("\xcf"), Catch::Contains("makes 15 pixels, the image has 16"));
    CHECK_THAT(wrong("\xd0"), Catch::Contains("ends within a run"));
    CHECK_THAT(wrong(""), Catch::Contains("makes 0 pixels"));
    const std::string path = goo_with_code(folder, std::string("\xd0\x01", 2));
    std::string bytes = read_text(path);
    ++bytes[goo_layers + 73];
    write_text(path, bytes);
    CHECK_THAT(complaint(path), Catch::Contains("checksum"));
}

TEST_CASE("tape archives that lie are refused", "[read-job]") {
    const TemporaryFolder folder;
    const std::string path = write_job(folder, {"ember", ".tar.gz"}, 1);
    const std::string png = [&] {
        const auto mask = stack_of(two_cones(1), small_machine("ember"));
        CHECK(open_job(path)->layer(0).pixels == mask[0].pixels);
        const TemporaryFolder other;
        run_layers(two_cones(1), *make_png_stack(small_machine("png"), other / "s", false), {0, 1});
        return read_text(other / "s/00000.png");
    }();
    const std::string settings = tar_member("printsettings", ember_settings);
    const auto slice = [&](int number) {
        return tar_member("slice_" + std::to_string(number) + ".png", png);
    };
    CHECK(complaint(ember_of(folder, settings + slice(2) + slice(1) + tar_end())).empty());
    CHECK(complaint(ember_of(folder, tar_member("./printsettings", ember_settings) +
                                         tar_member("./slice_1.png", png) + tar_end()))
              .empty());
    CHECK_THAT(complaint(ember_of(folder, slice(1) + tar_end())),
               Catch::Contains("'printsettings' is missing"));
    CHECK_THAT(complaint(ember_of(folder, settings + tar_end())), Catch::Contains("slice_1.png) is missing"));
    CHECK_THAT(complaint(ember_of(folder, settings + slice(1) + slice(3) + tar_end())),
               Catch::Contains("slice_2.png) is missing"));
    CHECK_THAT(complaint(ember_of(folder, settings + slice(1))), Catch::Contains("cut off"));
    CHECK_THAT(
        complaint(ember_of(folder, tar_member("printsettings", "{\"Settings\": 3}") + slice(1) + tar_end())),
        Catch::Contains("no JSON object with \"Settings\""));
    std::string lie = slice(1);
    lie.replace(124, 11, "77777777777");
    CHECK_THAT(complaint(ember_of(folder, settings + lie + tar_end())),
               Catch::Contains("header of it is damaged"));
    // The same lie with a header that is right in itself.
    unsigned sum = 0;
    for (std::size_t i = 0; i < 512; ++i)
        sum += i >= 148 && i < 156 ? ' ' : static_cast<unsigned char>(lie[i]);
    char octal[7];
    std::snprintf(octal, sizeof octal, "%06o", sum);
    lie.replace(148, 6, octal);
    CHECK_THAT(complaint(ember_of(folder, settings + lie + tar_end())), Catch::Contains("more than 1 GiB"));
    CHECK_THAT(complaint(ember_of(folder, std::string(2000, 'x'))), Catch::Contains("no tape archive"));
    const std::string text = folder / "text.tar.gz";
    write_text(text, "\x1f\x8bnot compressed");
    CHECK_THAT(complaint(text), Catch::Contains("cannot be unpacked"));
}

TEST_CASE("content decides what a file is, then its name", "[read-job]") {
    const TemporaryFolder folder;
    const std::string goo = write_job(folder, {"goo", ".goo"}, 2);
    std::filesystem::rename(goo, folder / "job.sl1");
    CHECK(open_job(folder / "job.sl1")->facts().format == "GOO file V3.0");
    write_text(folder / "empty.goo", "");
    CHECK_THROWS_WITH(open_if_job(folder / "empty.goo"), Catch::Contains("named like a GOO file"));
    write_text(folder / "model.stl", "solid cube\nendsolid cube\n");
    CHECK(open_if_job(folder / "model.stl") == nullptr);
    CHECK(open_if_job(folder / "not there.toml") == nullptr);
    CHECK_THROWS_WITH(open_job(folder / "model.stl"), Catch::Contains("no job with layer masks"));
    CHECK_THROWS_WITH(open_job(folder / "not there.sl1"), Catch::Contains("there is no such file"));
    write_zip(folder / "model.3mf", {{"[Content_Types].xml", "<Types/>"}});
    CHECK(open_if_job(folder / "model.3mf") == nullptr);
}

}  // namespace read_job_test
