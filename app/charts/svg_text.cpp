// Text elements.
#include "app/charts/svg_text.h"

#include <fmt/format.h>

namespace lamella {

std::string svg_label(double x, double y, const std::string& words, const char* more) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, more, words);
}

std::string svg_escaped(const std::string& words) {
    std::string out;
    for (const char c : words) {
        if (c == '<') {
            out += "&lt;";
        } else if (c == '&') {
            out += "&amp;";
        } else {
            out += c;
        }
    }
    return out;
}

}  // namespace lamella
