// Kinds: sections whose other keys depend on one word, and which keys go with which word.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "recipe/settings.h"

namespace lamella {

/// The word of [[field]] and [[grading]] for what the embedding program gives.
inline constexpr std::string_view host_kind = "host";

/// A word and the keys of its section that go with it. Keys that no word of the section names go with all.
struct Kind {
    std::string word;
    std::vector<std::string> needs;  ///< "rows|file": one of them and not both
    std::vector<std::string> takes;  ///< may be left out
};

/// The kinds of a section; none for sections whose keys stand alone.
struct KindSection {
    std::string section;
    std::string key;       ///< that holds the word: "kind", of [part] "shape"
    std::string fallback;  ///< the word where the key is missing; empty when it must be given
    std::vector<Kind> kinds;
};

/// All of them, in the order of the sections.
const std::vector<KindSection>& kind_sections();

/// The words of a section, for the settings table.
std::vector<std::string> kind_words(std::string_view section);

/// The alternatives of a need: "rows|file" is rows and file.
std::vector<std::string> alternatives(const std::string& need);

}  // namespace lamella
