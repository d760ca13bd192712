// What every 3MF package holds: its list of content types, the way to its model, and text in attributes.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/geometry.h"

namespace lamella {

/// [Content_Types].xml
inline constexpr std::string_view package_content_types =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    "</Types>\n";
/// _rels/.rels: the model is 3D/3dmodel.model.
inline constexpr std::string_view package_relationships =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
    "<Relationship Id=\"rel0\" Target=\"/3D/3dmodel.model\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n"
    "</Relationships>\n";

/// The same of a package with PNG images.
inline constexpr std::string_view package_content_types_with_png =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    "<Default Extension=\"png\" ContentType=\"image/png\"/>\n"
    "</Types>\n";

/// A box as a <mesh> of 12 triangles, its coordinates with so many decimals in the plane and along z.
std::string box_mesh(const Box& box, int plane_decimals, int height_decimals);

/// The text as the value of an XML attribute: what no attribute can hold is left out.
std::string xml_attribute(std::string_view text);

}  // namespace lamella
