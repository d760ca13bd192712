// Bytes as the model part of a 3MF package: mutations of a package itself rarely get past its checksums.
#pragma once

#include <zip.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace lamella {

/// Packs the bytes, and a picture under the name "a.png" unless it is empty.
inline std::string packed_model(const std::uint8_t* data, std::size_t size, std::string_view picture = {}) {
    zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, nullptr);
    zip_source_keep(target);
    zip_t* zip = zip_open_from_source(target, ZIP_TRUNCATE, nullptr);
    const zip_int64_t index = zip_file_add(zip, "3D/3dmodel.model", zip_source_buffer(zip, data, size, 0), 0);
    zip_set_file_compression(zip, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0);
    if (!picture.empty())
        zip_file_add(zip, "a.png", zip_source_buffer(zip, picture.data(), picture.size(), 0), 0);
    if (zip_close(zip) != 0 || zip_source_open(target) != 0) std::abort();
    zip_source_seek(target, 0, SEEK_END);
    std::string bytes(static_cast<std::size_t>(zip_source_tell(target)), '\0');
    zip_source_seek(target, 0, SEEK_SET);
    zip_source_read(target, bytes.data(), bytes.size());
    zip_source_close(target);
    zip_source_free(target);
    return bytes;
}

}  // namespace lamella
