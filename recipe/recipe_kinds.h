// Kinds: sections in which one key (such as `kind`) selects which other keys apply, and these keys.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "recipe/settings.h"

namespace lamella {

/// The kind of a [[field]] or [[grading]] that the embedding program gives.
inline constexpr std::string_view host_kind = "host";

/// A kind and the keys of its section that apply to it. Keys that no kind of the section lists apply to all.
struct Kind {
    std::string word;
    std::vector<std::string> needs;  ///< required keys; "rows|file": exactly one of them
    std::vector<std::string> takes;  ///< optional keys
};

/// The kinds of a section. Sections without a selecting key have none.
struct KindSection {
    std::string section;
    std::string key;       ///< the selecting key: "kind", in [part] "shape"
    std::string fallback;  ///< the kind when the key is missing; empty when the key is required
    std::vector<Kind> kinds;
};

/// Returns all kinds, in the order of the sections.
const std::vector<KindSection>& kind_sections();

/// Returns the names of a section's kinds, for the settings table.
std::vector<std::string> kind_words(std::string_view section);

/// Returns the alternatives of a required key: "rows|file" gives rows and file.
std::vector<std::string> alternatives(const std::string& need);

}  // namespace lamella
