// Words in SVG.
#pragma once

#include <string>

namespace lamella {

/// Returns a text element at a place (px); `more` holds further attributes.
std::string svg_label(double x, double y, const std::string& words, const char* more = "");

/// Returns words with < and & as entities.
std::string svg_escaped(const std::string& words);

}  // namespace lamella
