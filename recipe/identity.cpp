// Hashes the settings table and the bytes of input files with FNV-1a.
#include "recipe/identity.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <vector>

#include "engine/base/error.h"
#include "procedural/volume/nrrd_header.h"
#include "recipe/inputs/input_cache.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

namespace fs = std::filesystem;

/// Returns the files of an input: the file itself; of a folder or pattern its pages, sorted by name; of a
/// detached NRRD header also its data file.
std::vector<std::string> input_files(const std::string& path) {
    std::error_code error;
    std::vector<std::string> files;
    const bool pattern = fs::path(path).filename().string().find_first_of("*?") != std::string::npos;
    const fs::path folder = pattern ? fs::path(path).parent_path() : fs::path(path);
    if (pattern || fs::is_directory(path, error)) {
        for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
            const std::string name = entry.path().filename().string();
            const bool page = pattern ? fnmatch(fs::path(path).filename().c_str(), name.c_str(), 0) == 0
                                      : !name.starts_with('.');
            if (page && entry.is_regular_file(error)) files.push_back(entry.path().string());
        }
        std::sort(files.begin(), files.end());
        return files;
    }
    files.push_back(path);
    if (path.ends_with(".nhdr")) {
        std::ifstream header(path, std::ios::binary);
        const std::string data = header ? read_nrrd_header(header, path).data_file : "";
        if (!data.empty()) files.push_back((fs::path(path).parent_path() / data).string());
    }
    return files;
}

}  // namespace

void Fnv128::add(std::string_view bytes) {
    // The prime is 2^88 + 0x13b, so the product is a shift and a multiplication by a small number.
    constexpr std::uint64_t small = 0x13b;
    for (const char c : bytes) {
        low_ ^= static_cast<unsigned char>(c);
        const std::uint64_t low_half = (low_ & 0xffffffffU) * small;
        const std::uint64_t high_half = (low_ >> 32) * small + (low_half >> 32);
        const std::uint64_t shifted = low_ << 24;
        high_ = high_ * small + (high_half >> 32) + shifted;
        low_ = (high_half << 32) | (low_half & 0xffffffffU);
    }
}

std::string Fnv128::hex() const { return fmt::format("{:016x}{:016x}", high_, low_); }

std::string hash_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(path + ": cannot be opened; a readable file is needed");
    Fnv128 hash;
    std::array<char, 1 << 16> block;
    while (file) {
        file.read(block.data(), block.size());
        hash.add({block.data(), static_cast<std::size_t>(file.gcount())});
    }
    if (file.bad()) throw InputError(path + ": cannot be read");
    return hash.hex();
}

std::string hash_input(const std::string& path, InputCache* cache) {
    Fnv128 hash;
    for (const std::string& file : input_files(path))
        hash.add((cache != nullptr ? cache->hash(file) : hash_file(file)) + "\n");
    return hash.hex();
}

std::string job_identity(const Recipe& recipe, InputCache* cache) {
    Fnv128 hash;
    hash.add("lamella " LAMELLA_VERSION "\n");
    for (const Section& section : sections()) {
        if (!section.decides_layers) continue;
        if (section.name == "foam" && !recipe.foam) continue;
        if (section.name == "frame" && !recipe.frame) continue;
        if (section.name == "skin" && !recipe.skin) continue;
        if (section.name == "optimize" && !recipe.optimize) continue;
        if (section.name == "cavity" && !recipe.cavity) continue;
        if (section.name == "shield" && !recipe.shield) continue;
        if (section.name == "process" && !recipe.process) continue;
        if (section.name == "repair" && !recipe.repair) continue;
        if (section.name == "support" && recipe.support == SupportKind::none) continue;
        const std::size_t entries = section.is_list() ? section.entries(recipe) : 1;
        for (std::size_t entry = 0; entry < entries; ++entry) {
            for (const Setting& setting : settings()) {
                if (setting.section != section.name) continue;
                std::string value = format_value(setting.load(recipe, entry));
                if (setting.type == ValueType::path && !value.empty()) value = hash_input(value, cache);
                hash.add(setting.name() + "=" + value + "\n");
            }
        }
    }
    for (const FieldRecipe& field : recipe.fields) {
        if (field.host.pointer) hash.add(field.host.identity + "\n");
    }
    for (const GradingRecipe& grading : recipe.gradings) {
        if (grading.host.pointer) hash.add(grading.host.identity + "\n");
    }
    // Both default to the overhang of the supports, whose section is hashed only when there are supports.
    if (recipe.cavity || recipe.shield) hash.add(fmt::format("{}\n", recipe.printer.support.overhang));
    return hash.hex();
}

}  // namespace lamella
