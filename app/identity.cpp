// FNV-1a over the settings table and the bytes of the mesh.
#include "app/identity.h"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "app/settings.h"
#include "engine/error.h"

namespace lamella {

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

std::string job_identity(const Recipe& recipe) {
    Fnv128 hash;
    hash.add("lamella " LAMELLA_VERSION "\n");
    for (const Setting& setting : settings()) {
        if (setting.section == "foam" && !recipe.foam) continue;
        if (setting.section == "skin" && !recipe.skin) continue;
        std::string value = format_value(setting.load(recipe));
        if (setting.name() == "part.mesh" && !recipe.part.mesh.empty()) value = hash_file(recipe.part.mesh);
        hash.add(setting.name() + "=" + value + "\n");
    }
    return hash.hex();
}

}  // namespace lamella
