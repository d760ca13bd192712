// Numbers at the vertices of PLY meshes written by hand.
#include "engine/io/mesh_attribute.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/base/error.h"

namespace mesh_attribute_test {

using namespace lamella;

namespace {

enum class Form { ascii, little, big };

/// A PLY file, value by value in one of the three encodings.
class PlyWriter {
  public:
    PlyWriter(Form form, const std::string& header) : form_(form) {
        const char* const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
        bytes_ =
            std::string("ply\nformat ") + names[static_cast<int>(form)] + " 1.0\n" + header + "end_header\n";
    }

    template <class T>
    void add(T value) {
        if (form_ == Form::ascii) {
            bytes_ += std::to_string(value) + " ";
            return;
        }
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));  // little-endian machines only, as the test's
        for (std::size_t i = 0; i < sizeof(T); ++i) bytes_ += raw[form_ == Form::big ? sizeof(T) - 1 - i : i];
    }
    void end_row() {
        if (form_ == Form::ascii) bytes_ += '\n';
    }
    const std::string& bytes() const { return bytes_; }

  private:
    Form form_;
    std::string bytes_;
};

AttributedMesh read(const std::string& bytes, const std::string& attribute, double unit_mm = 1) {
    return read_ply_attribute("a.ply", std::as_bytes(std::span(bytes)), attribute, unit_mm);
}

std::string message_of(const std::string& bytes, const std::string& attribute = "n") {
    try {
        read(bytes, attribute);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string faces = "property list uchar int vertex_indices\n";

/// A triangle whose vertices have one property of a type, by the name "n" or another.
template <class T>
std::string triangle(Form form, const std::string& type, const std::vector<T>& values,
                     const std::string& name) {
    PlyWriter ply(form, "element vertex 3\nproperty " + type + " " + name + "\n" + xyz +
                            "property list uchar short tags\nelement face 1\n" + faces);
    for (int i = 0; i < 3; ++i) {
        ply.add(values[static_cast<std::size_t>(i)]);
        ply.add(static_cast<float>(i));
        ply.add(static_cast<float>(i * i));
        ply.add(0.0F);
        ply.add<std::uint8_t>(2);
        ply.add<std::int16_t>(7);
        ply.add<std::int16_t>(8);
        ply.end_row();
    }
    ply.add<std::uint8_t>(3);
    for (int i = 0; i < 3; ++i) ply.add<std::int32_t>(i);
    return ply.bytes();
}

template <class T>
void check_type(const std::vector<std::string>& types) {
    const std::vector<T> values = {
        std::numeric_limits<T>::lowest(), static_cast<T>(3),
        static_cast<T>(std::numeric_limits<T>::is_integer ? std::numeric_limits<T>::max()
                                                          : static_cast<T>(0.25))};
    for (const Form form : {Form::ascii, Form::little, Form::big}) {
        if (form == Form::ascii && !std::numeric_limits<T>::is_integer)
            continue;  // to_string writes six decimals
        for (const std::string& type : types) {
            const AttributedMesh plain = read(triangle(form, type, values, "n"), "n", 2);
            REQUIRE(plain.values.size() == 3);
            for (std::size_t i = 0; i < 3; ++i) CHECK(plain.values[i] == static_cast<double>(values[i]));
            CHECK(plain.mesh.vertices[2] == dvec3(4, 8, 0));
            CHECK(plain.mesh.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
            const AttributedMesh channel = read(triangle(form, type, values, "green"), "green");
            const double scale =
                std::numeric_limits<T>::is_integer ? static_cast<double>(std::numeric_limits<T>::max()) : 1;
            for (std::size_t i = 0; i < 3; ++i)
                CHECK(channel.values[i] == static_cast<double>(values[i]) / scale);
        }
    }
}

std::string ascii(const std::string& body, const std::string& vertices = "4",
                  const std::string& count = "1") {
    return "ply\nformat ascii 1.0\nelement vertex " + vertices + "\n" + xyz +
           "property float n\nelement face " + count + "\n" + faces + "end_header\n" + body;
}

const std::string square = "0 0 0 1\n4 0 0 2\n4 4 0 3\n0 4 0 4\n";

}  // namespace

TEST_CASE("numbers of every type and encoding are read, integer colours as 0 to 1") {
    check_type<std::uint8_t>({"uchar", "uint8"});
    check_type<std::int8_t>({"char", "int8"});
    check_type<std::uint16_t>({"ushort", "uint16"});
    check_type<std::int16_t>({"short", "int16"});
    check_type<std::uint32_t>({"uint", "uint32"});
    check_type<std::int32_t>({"int", "int32"});
    check_type<float>({"float", "float32"});
    check_type<double>({"double", "float64"});
}

TEST_CASE("polygons are cut, and equal corners keep numbers of their own") {
    const AttributedMesh mesh =
        read(ascii("0 0 0 1\n0 0 0 2\n4 0 0 3\n4 4 0 4\n0 4 0 nan\n4 0 2 3 4\n3 1 2 3\n", "5", "2"), "n");
    CHECK(mesh.mesh.vertices.size() == 5);
    CHECK(mesh.mesh.vertices[0] == mesh.mesh.vertices[1]);
    CHECK(mesh.values[0] == 1);
    CHECK(mesh.values[1] == 2);
    CHECK(std::isnan(mesh.values[4]));
    CHECK(mesh.mesh.triangles.size() == 3);
    double area = 0;
    for (const auto& [a, b, c] : mesh.mesh.triangles) {
        const auto& v = mesh.mesh.vertices;
        area += glm::cross(v[b] - v[a], v[c] - v[a]).z / 2;
    }
    CHECK(area == 16 + 8);
}

TEST_CASE("faces without extent are left out, and there must be others") {
    CHECK(read(ascii(square + "3 0 0 1\n3 0 1 2\n", "4", "2"), "n").mesh.triangles.size() == 1);
    CHECK(message_of(ascii(square + "3 0 0 1\n")) == "a.ply: none of its faces has an extent");
    CHECK(message_of(ascii(square + "2 0 1\n")) == "a.ply: none of its faces has an extent");
    CHECK(message_of(ascii("0 0 0 0\n", "1", "0")) == "a.ply: none of its faces has an extent");
}

TEST_CASE("a file that cannot give the number says which ones it has") {
    CHECK(message_of(ascii(square + "3 0 1 2\n"), "q") ==
          "a.ply: its vertices have no number named \"q\"; there are \"n\"");
    CHECK(message_of("ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "end_header\n0 0 0\n") ==
          "a.ply: its vertices have no number named \"n\"; there is none beside x, y and z");
    CHECK(message_of("solid cube\n").find("a.ply: a PLY file begins with a line \"ply\"") == 0);
    CHECK(message_of("").find("a.ply: a PLY file begins with a line \"ply\"") == 0);
    CHECK(message_of("ply\n").find("end_header") != std::string::npos);
}

TEST_CASE("a mesh that is not whole is refused rather than mended") {
    CHECK(message_of(ascii(square + "3 0 1 9\n")) == "a.ply: face 1 points to a vertex that does not exist");
    CHECK(message_of(ascii(square + "3 0 1 -1\n")) == "a.ply: face 1 points to a vertex that does not exist");
    CHECK(message_of(ascii("nan 0 0 1\n4 0 0 2\n4 4 0 3\n0 4 0 4\n3 0 1 2\n")) ==
          "a.ply: face 1 has a corner that is NaN, infinite or absurdly large");
    CHECK(message_of(ascii(square)).find("a.ply: the file is cut off: its header announces 1 face element") ==
          0);
    CHECK(message_of(ascii(square + "3 0 1 2\n", "4000000000", "1")).find("a.ply: ") == 0);
    CHECK(message_of(ascii(square + "3 0 1 2\n", "4", "9000000000000000000"))
              .find("a.ply: the file is cut off") == 0);
    CHECK(message_of(ascii(square + "2000000000 0 1 2\n")).find("a.ply: ") == 0);
    CHECK(message_of(ascii(square + "3 0 x 2\n")).find("line 15: \"x\" is not a number") !=
          std::string::npos);
}

TEST_CASE("a binary file cut off anywhere is refused") {
    const std::string whole = triangle<std::uint8_t>(Form::big, "uchar", {1, 2, 3}, "n");
    CHECK(message_of(whole).empty());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        if (message_of(whole.substr(0, length)).empty()) FAIL("read whole from " << length << " bytes");
    }
}

}  // namespace mesh_attribute_test
