// Common parts of 3MF packages: content types, relationships, box meshes, escaped attributes.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/geometry.h"
#include "printers/archive/zip_writer.h"

namespace lamella {

/// [Content_Types].xml of a package without images.
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

/// Writes the parts of a package without images up to the model, which comes next.
void begin_model(ZipWriter& zip);

/// [Content_Types].xml of a package with PNG images.
inline constexpr std::string_view package_content_types_with_png =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    "<Default Extension=\"png\" ContentType=\"image/png\"/>\n"
    "</Types>\n";

/// Returns a box as a <mesh> of 12 triangles. Coordinates have `plane_decimals` decimals in x and y and
/// `height_decimals` in z.
std::string box_mesh(const Box& box, int plane_decimals, int height_decimals);

/// Escapes a text for the value of an XML attribute. Drops characters that XML cannot represent.
std::string xml_attribute(std::string_view text);

}  // namespace lamella
