// Uncompressed entries.
#include "printers/archive/stored_zip.h"

#include <libdeflate.h>

namespace lamella {

std::string StoredZip::entry(const std::string& name, std::string_view file) {
    std::string bytes =
        begin_entry({name, 0, file.size(), file.size(), libdeflate_crc32(0, file.data(), file.size())});
    bytes += file;
    return bytes;
}

}  // namespace lamella
