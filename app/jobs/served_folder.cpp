// Resolves names within one folder.
#include "app/jobs/served_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/http/http_server.h"
#include "engine/base/complete_file.h"
#include "engine/base/whole_file.h"
#include "recipe/machine_profiles.h"
#include "recipe/recipe_edit.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 14> endings{".stl", ".obj",  ".ply", ".3mf", ".off", ".csv",  ".png",
                                                   ".jpg", ".jpeg", ".tif", ".vm",  ".svg", ".nrrd", ".toml"};

bool is_plain(const std::string& name) {
    const bool is_readable = std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
               c == '_' || c == '.' || c == ' ';
    });
    std::string ending = fs::path(name).extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return is_readable && name.size() <= 128 && !name.starts_with('.') &&
           std::ranges::find(endings, ending) != endings.end();
}

bool lies_within(const fs::path& path, const fs::path& folder) {
    return std::ranges::mismatch(folder, path).in1 == folder.end();
}

bool has_content(const fs::path& path, std::string_view bytes) {
    std::error_code error;
    return fs::file_size(path, error) == bytes.size() && !error &&
           whole_file(path.string(), "a file") == bytes;
}

}  // namespace

ServedFolder::ServedFolder(const fs::path& folder) {
    std::error_code error;
    folder_ = fs::canonical(folder, error);
    if (error || !fs::is_directory(folder_)) throw InputError(folder.string() + ": there is no such folder");
}

fs::path ServedFolder::file(const std::string& name) const {
    const fs::path given(name);
    std::error_code error;
    fs::path path = fs::weakly_canonical(folder_ / given, error);
    if (name.empty() || name.find('\0') != std::string::npos || error || !lies_within(path, folder_))
        throw HttpError(400,
                        fmt::format("{}: lies outside the served folder; accepted: a path within it", name));
    return path;
}

void ServedFolder::check_recipe(std::string_view text) const {
    for (const GivenKey& given : given_keys(text)) {
        const Setting& setting = *find_setting(given.section, given.key);
        const bool is_profile = setting.name() == "printer.profile" && names_profile_file(given.value);
        if ((setting.type == ValueType::path || is_profile) && !given.value.empty()) file(given.value);
    }
}

std::string ServedFolder::keep(const std::string& name, std::string_view bytes) const {
    if (!is_plain(name)) {
        throw HttpError(400, fmt::format("{}: no name for a file here; accepted: letters, digits, - _ . and "
                                         "spaces, with the ending of a mesh, picture, table or recipe",
                                         name.substr(0, 128)));
    }
    const fs::path given(name);
    for (int number = 1; number < 1000; ++number) {
        std::string tried =
            number == 1 ? name
                        : fmt::format("{}-{}{}", given.stem().string(), number, given.extension().string());
        const fs::path path = file(tried);
        if (fs::exists(path)) {
            if (has_content(path, bytes)) return tried;
            continue;
        }
        write_complete_file(path.string(), [&](std::ostream& out) {
            out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        });
        return tried;
    }
    throw HttpError(400, name + ": too many files have this name");
}

}  // namespace lamella
