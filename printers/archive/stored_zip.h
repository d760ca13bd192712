// StoredZip: a ZIP archive of files that are already compressed.
#pragma once

#include <string>
#include <string_view>

#include "printers/archive/growing_zip.h"

namespace lamella {

class StoredZip : public GrowingZip {
  public:
    StoredZip() : GrowingZip(ZipMethod::stored) {}
    /// Returns the bytes of an entry. Throws FaultError for a name of more than 1,024 bytes, or a file of 4
    /// GiB or more.
    std::string entry(const std::string& name, std::string_view file);
};

}  // namespace lamella
