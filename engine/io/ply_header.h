// Header of a PLY file: its elements, and how their properties are stored.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/mesh_source.h"

namespace lamella::ply {

/// Encoding of the values behind the header.
enum class Encoding { text, little_endian, big_endian };

/// Type of a number.
struct Scalar {
    std::size_t bytes = 0;
    enum class Kind { signed_integer, unsigned_integer, real } kind = Kind::real;
};

/// A number, or a list of numbers, in every row of an element.
struct Property {
    std::string name;
    std::optional<Scalar> count;  // lists only
    Scalar value;
};

/// A table of rows: vertices, faces and any other data.
struct Element {
    std::string name;  // in lower case
    std::size_t count = 0;
    std::vector<Property> properties;

    /// Returns false if a row takes row_bytes() bytes in every binary file; true if it takes at least that
    /// many.
    bool has_lists() const {
        return std::any_of(properties.begin(), properties.end(),
                           [](const Property& p) { return p.count.has_value(); });
    }
    std::size_t row_bytes() const {
        std::size_t bytes = 0;
        for (const Property& p : properties) bytes += p.count ? p.count->bytes : p.value.bytes;
        return bytes;
    }
    /// Returns the property's index in a row; properties.size() when there is none of this name.
    std::size_t index_of(std::string_view property) const {
        const auto found = std::find_if(properties.begin(), properties.end(),
                                        [&](const Property& p) { return p.name == property; });
        return static_cast<std::size_t>(found - properties.begin());
    }
    /// The same for a name in lower case that the file may write in capitals.
    std::size_t index_of_word(std::string_view lower) const {
        const auto found = std::find_if(properties.begin(), properties.end(),
                                        [&](const Property& p) { return same_word(p.name, lower); });
        return static_cast<std::size_t>(found - properties.begin());
    }
    /// Returns the index of the list of vertices in a row of faces or strips; properties.size() without one.
    std::size_t index_of_corners() const {
        const std::size_t list = index_of_word("vertex_indices");
        return list < properties.size() ? list : index_of_word("vertex_index");
    }
};

/// The relevant content of a header.
struct Header {
    Encoding encoding = Encoding::text;
    std::vector<Element> elements;
    std::size_t data_at = 0;         ///< offset of the first byte behind the header
    std::vector<std::string> notes;  ///< lines that were skipped, for the user
};

/// Reads the header of a file for which is_ply() holds. Keywords and types may be in capitals; lines that
/// begin with any other word are skipped with a note. Throws InputError with the line.
Header read_header(const MeshSource& source);

}  // namespace lamella::ply
