// 3MF packages written down by hand, for the tests of what reads them.
#pragma once

#include <zip.h>

#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "engine/mesh/mesh.h"

namespace lamella::samples {

inline std::string number(double v) {
    std::ostringstream text;
    text.precision(17);
    text << v;
    return text.str();
}

/// A ZIP archive of the given parts.
inline std::string zip_of(const std::vector<std::pair<std::string, std::string>>& parts) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &error);
    REQUIRE(target != nullptr);
    zip_source_keep(target);
    zip_t* zip = zip_open_from_source(target, ZIP_TRUNCATE, &error);
    REQUIRE(zip != nullptr);
    for (const auto& [name, text] : parts) {
        zip_source_t* content = zip_source_buffer(zip, text.data(), text.size(), 0);
        REQUIRE(zip_file_add(zip, name.c_str(), content, ZIP_FL_ENC_UTF_8) >= 0);
    }
    REQUIRE(zip_close(zip) == 0);
    REQUIRE(zip_source_open(target) == 0);
    zip_source_seek(target, 0, SEEK_END);
    std::string bytes(static_cast<std::size_t>(zip_source_tell(target)), '\0');
    zip_source_seek(target, 0, SEEK_SET);
    REQUIRE(zip_source_read(target, bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size()));
    zip_source_close(target);
    zip_source_free(target);
    return bytes;
}

inline std::string object_xml(const std::string& id, const TriangleMesh& mesh,
                              const std::string& attributes = "") {
    std::string xml = "<object id=\"" + id + "\" " + attributes + "><mesh><vertices>";
    for (const dvec3& p : mesh.vertices) {
        xml += "<vertex x=\"" + number(p.x) + "\" y=\" " + number(p.y) + "\" z=\"" + number(p.z) + "\"/>\n";
    }
    xml += "</vertices><triangles>";
    for (const auto& [a, b, c] : mesh.triangles) {
        xml += "<triangle v1=\"" + std::to_string(a) + "\" v2=\"" + std::to_string(b) + "\" v3=\"" +
               std::to_string(c) + "\"/>\n";
    }
    return xml + "</triangles></mesh></object>";
}

inline std::string model_xml(const std::string& resources, const std::string& items,
                             const std::string& attributes = "") {
    return "<?xml version=\"1.0\"?><model "
           "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" " +
           attributes + "><resources>" + resources + "</resources><build>" + items + "</build></model>";
}

inline std::string threemf(const std::string& resources, const std::string& items,
                           const std::string& attributes = "") {
    return zip_of({{"3D/3dmodel.model", model_xml(resources, items, attributes)}});
}

}  // namespace lamella::samples
