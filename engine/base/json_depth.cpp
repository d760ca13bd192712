// Counts brackets outside of strings.
#include "engine/base/json_depth.h"

namespace lamella {

std::string_view shallow_json(std::string_view text) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > deepest_json) return {};
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return text;
}

}  // namespace lamella
