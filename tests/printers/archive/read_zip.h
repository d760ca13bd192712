// Reading archives back with libzip, which shares no code with our writer.
#pragma once

#include <zip.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lamella::test {

/// The entries of an archive, in the directory's order, checked for consistency and by their checksums.
inline std::vector<std::pair<std::string, std::string>> read_zip(const std::filesystem::path& path) {
    int error = 0;
    zip_t* zip = zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &error);
    INFO("libzip error " << error);
    REQUIRE(zip != nullptr);
    std::vector<std::pair<std::string, std::string>> entries;
    for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
        zip_stat_t stat;
        REQUIRE(zip_stat_index(zip, static_cast<zip_uint64_t>(i), 0, &stat) == 0);
        std::string content(stat.size, '\0');
        zip_file_t* file = zip_fopen_index(zip, static_cast<zip_uint64_t>(i), 0);
        REQUIRE(file != nullptr);
        REQUIRE(zip_fread(file, content.data(), stat.size) == static_cast<zip_int64_t>(stat.size));
        char beyond = 0;
        REQUIRE(zip_fread(file, &beyond, 1) == 0);
        REQUIRE(zip_fclose(file) == 0);
        entries.emplace_back(stat.name, std::move(content));
    }
    zip_discard(zip);
    return entries;
}

}  // namespace lamella::test
