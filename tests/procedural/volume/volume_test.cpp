// Image stacks written by OpenImageIO and NRRD files written by hand, read back sample by sample.
#include "procedural/volume/volume.h"

#include <OpenImageIO/imageio.h>
#include <zlib.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "engine/base/error.h"
#include "tests/procedural/volume/scratch_folder.h"

namespace volume_test {

using namespace lamella;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t nx = 5, ny = 4, nz = 12;

/// A different number for every voxel and channel, x, y and z as in the volume.
int number_at(std::size_t x, std::size_t y, std::size_t z, std::size_t channel = 0) {
    return static_cast<int>((x + nx * (y + ny * z)) % 251 + 2 * channel);
}

/// A page as a picture: its top row is the highest y.
template <class T>
std::vector<T> picture(std::size_t z, std::size_t channels, double factor) {
    std::vector<T> pixels;
    for (std::size_t row = 0; row < ny; ++row) {
        for (std::size_t x = 0; x < nx; ++x) {
            for (std::size_t c = 0; c < channels; ++c) {
                pixels.push_back(static_cast<T>(number_at(x, ny - 1 - row, z, c) * factor));
            }
        }
    }
    return pixels;
}

template <class T>
constexpr OIIO::TypeDesc type_of() {
    return OIIO::BaseTypeFromC<T>::value;
}

template <class T>
void write_image(const fs::path& path, std::size_t z, std::size_t channels = 1, double factor = 1) {
    const auto output = OIIO::ImageOutput::create(path.string());
    OIIO::ImageSpec spec(nx, ny, static_cast<int>(channels), type_of<T>());
    spec["oiio:UnassociatedAlpha"] = 1;
    REQUIRE(output->open(path.string(), spec));
    REQUIRE(output->write_image(type_of<T>(), picture<T>(z, channels, factor).data()));
    REQUIRE(output->close());
}

template <class T>
void write_pages(const fs::path& path, std::size_t pages, bool tiled, double factor = 1) {
    OIIO::ImageSpec spec(nx, ny, 1, type_of<T>());
    if (tiled) spec.tile_width = spec.tile_height = 16;
    const std::vector<OIIO::ImageSpec> specs(pages, spec);
    const auto output = OIIO::ImageOutput::create(path.string());
    REQUIRE(output->open(path.string(), static_cast<int>(pages), specs.data()));
    for (std::size_t z = 0; z < pages; ++z) {
        if (z > 0) REQUIRE(output->open(path.string(), spec, OIIO::ImageOutput::AppendSubimage));
        REQUIRE(output->write_image(type_of<T>(), picture<T>(z, 1, factor).data()));
    }
    REQUIRE(output->close());
}

template <class T>
void check_samples(const Volume& volume, std::size_t pages, double factor = 1, std::size_t channel = 0) {
    REQUIRE(volume.size == std::array<std::size_t, 3>{nx, ny, pages});
    const auto* samples = std::get_if<std::vector<T>>(&volume.samples);
    REQUIRE(samples);
    REQUIRE(samples->size() == nx * ny * pages);
    for (std::size_t i = 0; i < samples->size(); ++i) {
        const auto expected = static_cast<T>(number_at(i % nx, i / nx % ny, i / nx / ny, channel) * factor);
        if ((*samples)[i] != expected) FAIL("sample " << i << " is another one");
    }
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string volume_message(const fs::path& path, int channel = 0) {
    return message_of([&] { read_volume(path.string(), channel); });
}

Volume read(const std::string& bytes) {
    std::istringstream in(bytes);
    return read_nrrd(in, "v.nrrd", ".");
}

std::string nrrd_message(const std::string& bytes) {
    return message_of([&] { read(bytes); });
}

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string packed(const std::string& bytes) {
    z_stream zlib{};
    REQUIRE(deflateInit2(&zlib, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
    std::string out(bytes.size() + 100, '\0');
    zlib.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    zlib.avail_in = static_cast<uInt>(bytes.size());
    zlib.next_out = reinterpret_cast<Bytef*>(out.data());
    zlib.avail_out = static_cast<uInt>(out.size());
    REQUIRE(deflate(&zlib, Z_FINISH) == Z_STREAM_END);
    out.resize(zlib.total_out);
    deflateEnd(&zlib);
    return out;
}

/// Samples as a file has them, by shifts alone.
template <class T>
std::string binary(const std::vector<T>& samples, bool big) {
    std::string out;
    for (const T sample : samples) {
        std::uint64_t bits = 0;
        if constexpr (std::is_same_v<T, float>) {
            std::uint32_t half = 0;
            std::memcpy(&half, &sample, 4);
            bits = half;
        } else if constexpr (std::is_same_v<T, double>) {
            std::memcpy(&bits, &sample, 8);
        } else {
            bits = static_cast<std::uint64_t>(sample);
        }
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            const std::size_t byte = big ? sizeof(T) - 1 - i : i;
            out.push_back(static_cast<char>(bits >> (8 * byte) & 0xffU));
        }
    }
    return out;
}

template <class T>
std::string text(const std::vector<T>& samples) {
    std::ostringstream out;
    out.precision(17);
    for (std::size_t i = 0; i < samples.size(); ++i)
        out << +samples[i] << (i % 3 == 2 ? "\n" : i % 2 ? ", " : " ");
    return out.str();
}

/// 24 samples with the type's extremes among them.
template <class T>
std::vector<T> extreme_samples() {
    std::vector<T> samples;
    for (int i = 0; i < 24; ++i) samples.push_back(static_cast<T>(i * 5));
    samples[3] = std::numeric_limits<T>::max();
    samples[7] = std::numeric_limits<T>::lowest();
    if (std::is_floating_point_v<T>) samples[9] = static_cast<T>(0.1);
    return samples;
}

std::string header(const std::string& type, const std::string& encoding, const std::string& more = "") {
    return "NRRD0004\n# by hand\ntype: " + type + "\ndimension: 3\nsizes: 2 3 4\nencoding: " + encoding +
           "\n" + more;
}

template <class T>
void check_type(const std::vector<std::string>& names) {
    const std::vector<T> samples = extreme_samples<T>();
    const auto check = [&](const std::string& bytes) {
        const Volume volume = read(bytes);
        CHECK(volume.size == std::array<std::size_t, 3>{2, 3, 4});
        CHECK(volume.full_scale == 1);
        const auto* got = std::get_if<std::vector<T>>(&volume.samples);
        REQUIRE(got);
        CHECK(*got == samples);
    };
    for (const std::string& name : names) {
        for (const bool big : {false, true}) {
            const std::string endian = big ? "endian: big\n" : "endian: little\n";
            check(header(name, "raw", endian) + "\n" + binary(samples, big));
            for (const char* encoding : {"gzip", "gz"}) {
                check(header(name, encoding, endian) + "\n" + packed(binary(samples, big)));
            }
        }
        for (const char* encoding : {"ascii", "text", "txt"})
            check(header(name, encoding) + "\n" + text(samples));
    }
}

const std::string bytes24(24, '\x07');

}  // namespace

TEST_CASE("a folder of images is a volume, its names in natural order") {
    const ScratchFolder folder("stack");
    for (std::size_t z = 0; z < nz; ++z)
        write_image<std::uint8_t>(folder / ("page" + std::to_string(z) + ".png"), z);
    std::ofstream(folder / ".hidden") << "x";
    const Volume volume = read_volume(folder.path().string());
    check_samples<std::uint8_t>(volume, nz);
    CHECK(volume.full_scale == 255);
    CHECK(!volume.box);
}

TEST_CASE("a pattern picks the files of a stack") {
    const ScratchFolder folder("pattern");
    for (std::size_t z = 0; z < nz; ++z)
        write_image<std::uint16_t>(folder / ("a" + std::to_string(z) + ".png"), z, 1, 200);
    write_image<std::uint16_t>(folder / "b0.png", 0, 3);
    std::ofstream(folder / "notes.txt") << "x";
    const Volume volume = read_volume((folder / "a*.png").string());
    check_samples<std::uint16_t>(volume, nz, 200);
    CHECK(volume.full_scale == 65535);
    CHECK(read_volume((folder / "a?.png").string()).size[2] == 10);
    CHECK(ends_with(volume_message(folder / "c*.png"), "no file's name fits this pattern"));
    CHECK(ends_with(volume_message(folder / "c.png"), "there is no such file or folder"));
}

TEST_CASE("the channels of an image are read apart, alpha without touching the others") {
    const ScratchFolder folder("channels");
    for (std::size_t z = 0; z < 2; ++z)
        write_image<std::uint8_t>(folder / (std::to_string(z) + ".png"), z, 4);
    for (int channel = 0; channel < 4; ++channel) {
        check_samples<std::uint8_t>(read_volume(folder.path().string(), channel), 2, 1,
                                    static_cast<std::size_t>(channel));
    }
    CHECK(ends_with(volume_message(folder.path(), 4),
                    "there is no channel 4; the image has 4, counted from 0"));
    CHECK(volume_message(folder.path(), -1).find("there is no channel -1") != std::string::npos);
}

TEST_CASE("a TIFF with many pages is a volume, in rows or tiles, of bytes, words or floats") {
    const ScratchFolder folder("tiff");
    const fs::path path = folder / "pages.tif";
    for (const bool tiled : {false, true}) {
        write_pages<std::uint8_t>(path, nz, tiled);
        check_samples<std::uint8_t>(read_volume(path.string()), nz);
        write_pages<std::uint16_t>(path, nz, tiled, 200);
        check_samples<std::uint16_t>(read_volume(path.string()), nz, 200);
        write_pages<float>(path, nz, tiled, -0.25);
        const Volume volume = read_volume(path.string());
        check_samples<float>(volume, nz, -0.25);
        CHECK(volume.full_scale == 1);
    }
}

TEST_CASE("pages that do not belong together are refused by name") {
    const ScratchFolder folder("mixed");
    write_image<std::uint8_t>(folder / "1.png", 0);
    write_image<std::uint16_t>(folder / "2.png", 0);
    CHECK(volume_message(folder.path()) ==
          (folder / "2.png").string() + ": its samples are uint16, those of the first page uint8");
    fs::remove(folder / "2.png");
    const std::vector<std::uint8_t> pixels(36);
    const auto output = OIIO::ImageOutput::create("x.png");
    REQUIRE(output->open((folder / "3.png").string(), OIIO::ImageSpec(6, 6, 1, OIIO::TypeDesc::UINT8)));
    REQUIRE(output->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
    REQUIRE(output->close());
    CHECK(volume_message(folder.path()) ==
          (folder / "3.png").string() + ": is 6 x 6 pixels large, the first page 5 x 4");
    std::ofstream(folder / "0.txt") << "no image";
    CHECK(volume_message(folder.path()).find((folder / "0.txt").string() + ": this is no image") == 0);
    const ScratchFolder empty("empty");
    CHECK(
        ends_with(volume_message(empty.path()), "the folder holds no files; a stack of images was expected"));
    CHECK_THROWS_AS(read_image_stack({}), InputError);
}

// As TIFF: OpenImageIO 2.4 leaks a string where libpng gives up.
TEST_CASE("an image cut off is refused, or nothing of it is missing") {
    const ScratchFolder folder("cut");
    write_pages<std::uint16_t>(folder / "1.tif", 3, true);
    const auto whole = fs::file_size(folder / "1.tif");
    int refused = 0;
    for (const auto length : {whole / 8, whole / 3, whole / 2, whole * 2 / 3, whole * 9 / 10, whole - 20}) {
        write_pages<std::uint16_t>(folder / "1.tif", 3, true);
        fs::resize_file(folder / "1.tif", length);
        // The writer leaves bytes at the end that no page needs, as many as it likes: without them, all
        // samples are still there.
        const std::string message = volume_message(folder.path());
        INFO(length << " of " << whole << " bytes: " << message);
        if (message.empty()) {
            check_samples<std::uint16_t>(read_volume(folder.path().string(), 0), 3);
        } else {
            ++refused;
            CHECK(message.find((folder / "1.tif").string() + ": ") == 0);
        }
    }
    CHECK(refused >= 2);
}

TEST_CASE("NRRD samples of every type, encoding and byte order are read") {
    check_type<std::int8_t>({"int8", "signed char", "int8_t"});
    check_type<std::uint8_t>({"uint8", "uchar", "unsigned char"});
    check_type<std::int16_t>({"int16", "short", "signed short int"});
    check_type<std::uint16_t>({"uint16", "ushort", "unsigned short"});
    check_type<std::int32_t>({"int32", "int", "Int32_t"});
    check_type<std::uint32_t>({"uint32", "unsigned int"});
    check_type<std::int64_t>({"int64", "long long", "longlong"});
    check_type<std::uint64_t>({"uint64", "unsigned long long int"});
    check_type<float>({"float"});
    check_type<double>({"double"});
}

TEST_CASE("a leading axis of one number a voxel is read over") {
    const std::string start = "NRRD0005\r\ntype: uint8\r\ndimension: 4\r\nencoding: raw\r\nkey:=value: #\r\n";
    const Volume volume =
        read(start + "sizes: 1 2 3 4\r\nspace directions: none (2,0,0) (0,3,0) (0,0,4)\r\n\r\n" + bytes24);
    CHECK(volume.size == std::array<std::size_t, 3>{2, 3, 4});
    REQUIRE(volume.box);
    CHECK(volume.box->hi == dvec3(4, 9, 16));
    CHECK(ends_with(nrrd_message(start + "sizes: 3 2 2 2\r\n\r\n" + bytes24),
                    "of 4 axes the first must have size 1: one number a voxel"));
}

TEST_CASE("the box of an NRRD file encloses voxels centred on its samples") {
    const auto box_of = [](const std::string& fields) {
        return read(header("uint8", "raw", fields) + "\n" + bytes24).box;
    };
    const auto check = [](const std::optional<Box>& box, dvec3 lo, dvec3 hi) {
        REQUIRE(box);
        CHECK(glm::length(box->lo - lo) < 1e-12);
        CHECK(glm::length(box->hi - hi) < 1e-12);
    };
    check(box_of("spacings: 0.5 1 2\n"), {0, 0, 0}, {1, 3, 8});
    check(box_of("spacings: 0.5 1 2\nunits: \"mm\" \"mm\" \"mm\"\n"), {0, 0, 0}, {1, 3, 8});
    check(box_of("space: LPS\nspace directions: (0.5,0,0) (0, 1, 0) (0,0,2)\nspace origin: (10,20,30)\n"
                 "space units: \"mm\" \"mm\" \"mm\"\n"),
          {9.75, 19.5, 29}, {10.75, 22.5, 37});
    CHECK(!box_of(""));
    CHECK(!box_of("spacings: nan 1 1\n"));
    CHECK(!box_of("spacings: 1 1 1\nunits: \"um\" \"um\" \"um\"\n"));
    CHECK(!box_of("space directions: (-1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"));
    CHECK(!box_of("space directions: (0,1,0) (1,0,0) (0,0,1)\nspace origin: (0,0,0)\n"));
    CHECK(!box_of("space directions: (1,0.1,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"));
    CHECK(!box_of("space directions: (1,0,0) (0,1,0) (0,0,1)\nspace units: \"m\" \"m\" \"m\"\n"));
}

TEST_CASE("a detached header leads to its data, past what is to be skipped") {
    const ScratchFolder folder("detached");
    const std::vector<std::uint16_t> samples = extreme_samples<std::uint16_t>();
    const std::string data = binary(samples, false);
    const auto check = [&](const std::string& fields, const std::string& encoding,
                           const std::string& content) {
        std::ofstream(folder / "v.nhdr", std::ios::binary)
            << header("uint16", encoding, "endian: little\ndata file: my data.raw\n" + fields);
        std::ofstream(folder / "my data.raw", std::ios::binary) << content;
        const Volume volume = read_volume((folder / "v.nhdr").string());
        CHECK(std::get<std::vector<std::uint16_t>>(volume.samples) == samples);
    };
    check("", "raw", data);
    check("\n", "raw", data);
    check("line skip: 2\nbyte skip: 3\n", "raw", "P5\n24 1\nabc" + data);
    check("byte skip: -1\n", "raw", "any header at all\n" + data);
    check("lineskip: 1\nbyteskip: 5\n", "gzip", "first\n" + packed("12345" + data));
    check("", "gzip", packed(data.substr(0, 11)) + packed(data.substr(11)));
    check("line skip: 1\n", "ascii", "17 numbers\n" + text(samples));
    fs::remove(folder / "my data.raw");
    CHECK(ends_with(volume_message(folder / "v.nhdr"), "my data.raw cannot be opened"));
}

TEST_CASE("an NRRD file that lies about its length is refused before memory is taken") {
    const std::string start = "NRRD0004\ntype: double\nendian: little\ndimension: 3\n";
    const auto message = [&](const std::string& sizes, const std::string& encoding, const std::string& data) {
        return nrrd_message(start + "sizes: " + sizes + "\nencoding: " + encoding + "\n\n" + data);
    };
    CHECK(message("2000 2000 2000", "raw", "x") ==
          "v.nrrd: the volume is larger than 2,147,483,648 voxels; reduce its resolution");
    CHECK(message("9223372036854775807 9223372036854775807 9223372036854775807", "raw", "x") ==
          "v.nrrd: the volume is larger than 2,147,483,648 voxels; reduce its resolution");
    CHECK(message("1000 1000 1000", "raw", "x").find("v.nrrd: the volume takes more than 4 GiB") == 0);
    CHECK(message("800 800 800", "raw", "x") ==
          "v.nrrd: the header announces 4,096,000,000 bytes, but only 1 are there");
    CHECK(message("800 800 800", "gzip", packed("x")).find("packed ones are there") != std::string::npos);
    CHECK(message("800 800 800", "ascii", "1 2 3").find("announces 512,000,000 numbers") !=
          std::string::npos);
    CHECK(message("1 1 2", "raw", "0123456789abcdefg") ==
          "v.nrrd: the header announces 16 bytes, but more are there");
    CHECK(message("1 1 2", "gzip", packed("0123456789abcde")) ==
          "v.nrrd: the header announces 16 bytes, but only 15 are there");
    CHECK(message("1 1 2", "gzip", packed("0123456789abcdefg")) ==
          "v.nrrd: the header announces 16 bytes, but more are there");
    CHECK(message("1 1 2", "gzip", packed("0123456789abcdef").substr(0, 20)).find("but only") !=
          std::string::npos);
    CHECK(message("1 1 2", "gzip", "0123456789abcdef") == "v.nrrd: the gzip data are damaged");
    CHECK(message("1 1 2", "ascii", "1.5      ") ==
          "v.nrrd: the header announces 2 numbers, but only 1 are there");
    CHECK(message("1 1 2", "ascii", "1 2 3") == "v.nrrd: the header announces 2 numbers, but more are there");
    CHECK(message("1 1 2", "ascii", "1 x") == "v.nrrd: number 2 of the data, \"x\", does not fit the type");
    CHECK(nrrd_message(header("uint8", "ascii") + "\n" + text(std::vector<int>(24, 256)))
              .find("number 1 of the data, \"256\", does not fit") != std::string::npos);
    CHECK(nrrd_message(header("uint8", "raw", "byte skip: 30\n") + "\n" + bytes24) ==
          "v.nrrd: it is shorter than the bytes to skip");
    CHECK(nrrd_message(header("uint8", "raw", "line skip: 3000000000\n") + "\n" + bytes24) ==
          "v.nrrd: it has fewer lines than are to be skipped");
}

TEST_CASE("an NRRD header that says something else is refused with its line") {
    const auto message = [](const std::string& more) {
        return nrrd_message(header("uint8", "raw", more) + "\n");
    };
    CHECK(nrrd_message("NRRD0009\n") == "v.nrrd:1: \"NRRD0009\" is no NRRD magic (NRRD0001 to NRRD0006)");
    CHECK(nrrd_message("NRRD0004\ntype: uint8\n").find("lacks the field \"encoding\"") != std::string::npos);
    CHECK(nrrd_message(header("block", "raw")).find("v.nrrd:3: \"block\" is no type that is read") == 0);
    CHECK(nrrd_message(header("uint8", "bzip2")) ==
          "v.nrrd:6: the encoding \"bzip2\" is not read; known are raw, ascii and gzip");
    CHECK(nrrd_message(header("uint16", "raw")).find("lacks the field \"endian\"") != std::string::npos);
    CHECK(nrrd_message(header("uint16", "raw", "endian: middle\n")) ==
          "v.nrrd:7: endian must be little or big, not \"middle\"");
    CHECK(message("colour: red\n") == "v.nrrd:7: \"colour\" is no field of the NRRD format");
    CHECK(message("hello\n") == "v.nrrd:7: \"hello\" is neither a field (name: value) nor a comment (#)");
    CHECK(message("sizes: 2 3 4\n") == "v.nrrd:7: the field \"sizes\" stands in the header twice");
    CHECK(message("data file: LIST\na.raw\nb.raw\n") ==
          "v.nrrd:7: data in several files are not read; join them into one");
    CHECK(message("data file: s%03d.raw 1 4 1\n").find("several files") != std::string::npos);
    CHECK(message("byte skip: -2\n") == "v.nrrd:7: \"-2\" is no number to skip");
    CHECK(message("spacings: 1 2\n") == "v.nrrd:7: there must be 3 spacings");
    CHECK(message("spacings: 1 2 x\n") == "v.nrrd:7: \"x\" is no spacing");
    CHECK(message("space directions: (1,0,0) (0,1,0)\n") == "v.nrrd:7: there must be 3 space directions");
    CHECK(message("space directions: (1,0,0 (0,1,0)\n").find("v.nrrd:7: ") == 0);
    CHECK(message("space directions: (1,0) (0,1) (1,1)\n").find("three coordinates") != std::string::npos);
    CHECK(nrrd_message("NRRD0004\ntype: uint8\ndimension: 2\nsizes: 2 3\nencoding: raw\n\n")
              .find("v.nrrd:3: the dimension must be 3") == 0);
    CHECK(nrrd_message("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 0 3\nencoding: raw\n\n") ==
          "v.nrrd:4: \"0\" is no size of an axis");
    CHECK(nrrd_message("NRRD0004\n" + std::string(2000000, 'a')) ==
          "v.nrrd:2: the NRRD header is longer than 1 MiB");
    CHECK(nrrd_message("NRRD0004\n").find("lacks the field") != std::string::npos);
}

TEST_CASE("an NRRD file cut off anywhere is refused, and never read as another one") {
    const std::string whole = header("int16", "gzip", "endian: big\nspacings: 1 1 1\n") + "\n" +
                              packed(binary(extreme_samples<std::int16_t>(), true));
    CHECK_NOTHROW(read(whole));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        if (nrrd_message(whole.substr(0, length)).empty()) FAIL("read whole from " << length << " bytes");
    }
}

}  // namespace volume_test
