// Reads the archive through libzip; checks every size during unpacking.
#include "engine/io/opc_package.h"

#include <zip.h>

#include <algorithm>

namespace lamella {

OpcPackage::OpcPackage(const MeshSource& source) : source_(source) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* bytes = zip_source_buffer_create(source.bytes.data(), source.bytes.size(), 0, &error);
    if (bytes != nullptr) zip_.reset(zip_open_from_source(bytes, ZIP_RDONLY, &error));
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    if (!zip_) {
        if (bytes != nullptr) zip_source_free(bytes);
        reject(source, "a 3MF file is a ZIP archive, and this one cannot be opened (" + why +
                           "); the file is damaged or cut off");
    }
}

void OpcPackage::Discard::operator()(struct zip* archive) const { zip_discard(archive); }

bool OpcPackage::has(const std::string& part) const {
    return zip_name_locate(zip_.get(), part.c_str(), ZIP_FL_NOCASE) >= 0;
}

std::string OpcPackage::read(const std::string& part) {
    const zip_int64_t index = zip_name_locate(zip_.get(), part.c_str(), ZIP_FL_NOCASE);
    if (index < 0) reject(source_, "the archive has no part " + excerpt(part));
    std::unique_ptr<zip_file_t, void (*)(zip_file_t*)> file(
        zip_fopen_index(zip_.get(), static_cast<zip_uint64_t>(index), 0), [](zip_file_t* f) {
            if (f != nullptr) zip_fclose(f);
        });
    if (!file)
        reject(source_, "part " + excerpt(part) + " cannot be unpacked (" + zip_strerror(zip_.get()) + ")");
    zip_stat_t stat;
    zip_stat_init(&stat);
    const bool has_size = zip_stat_index(zip_.get(), static_cast<zip_uint64_t>(index), 0, &stat) == 0 &&
                          (stat.valid & ZIP_STAT_SIZE) != 0;
    if (has_size && stat.size > unpacked_left_) reject_size();
    std::string text;
    for (std::size_t used = 0;; used = text.size()) {
        const std::size_t step = std::clamp(used, std::size_t{1} << 14U, std::size_t{1} << 24U);
        text.resize(used + step);
        const zip_int64_t got = zip_fread(file.get(), text.data() + used, step);
        if (got < 0)
            reject(source_, "part " + excerpt(part) + " cannot be unpacked (" +
                                zip_file_strerror(file.get()) + "); the file is damaged or cut off");
        text.resize(used + static_cast<std::size_t>(got));
        if (got == 0) return text;
        if (text.size() > unpacked_left_) reject_size();  // the stated size was wrong
    }
}

void OpcPackage::account(std::size_t bytes) { unpacked_left_ -= std::min(bytes, unpacked_left_); }

void OpcPackage::reject_size() const {
    reject(source_, "it unpacks to more than 512 MiB, the most that is read from one 3MF file");
}

std::string part_name(std::string_view target) {
    while (!target.empty() && target.front() == '/') target.remove_prefix(1);
    return std::string(target);
}

}  // namespace lamella
