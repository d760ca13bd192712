// The directory of a growing archive.
#include "printers/archive/growing_zip.h"

#include <limits>
#include <utility>

#include "engine/base/error.h"
#include "printers/archive/zip_readback.h"

namespace lamella {

std::string GrowingZip::begin_entry(ZipEntry entry) {
    if (entry.name.empty() || entry.name.size() > longest_zip_name)
        throw FaultError("an archive holds names of 1 to 1024 bytes");
    constexpr std::uint64_t max_bytes = std::numeric_limits<std::uint32_t>::max() - 1;
    if (entry.size > max_bytes || entry.packed > max_bytes)
        throw FaultError(entry.name + " is 4 GiB or more, too much for an archive");
    entry.offset = size_;
    std::string bytes;
    const std::size_t whole =
        zip_local_header_size + entry.name.size() + static_cast<std::size_t>(entry.packed);
    bytes.reserve(whole);
    put_local_header(bytes, entry, method_);
    size_ += whole;
    entries_.push_back(std::move(entry));
    return bytes;
}

std::string GrowingZip::directory() const {
    std::string bytes;
    put_directory(bytes, entries_, size_, method_);
    return bytes;
}

void GrowingZip::take_up(const std::filesystem::path& path, std::uint64_t size) {
    entries_ = read_back_entries(path, size);
    size_ = size;
}

}  // namespace lamella
