// OpcPackage: the ZIP archive of a 3MF file, in memory.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "engine/io/mesh_source.h"

struct zip;

namespace lamella {

/// Reads the parts of a package. The source must outlive it.
class OpcPackage {
  public:
    /// Limit on the unpacked size of one file's XML in total, and of any other part.
    static constexpr std::size_t max_bytes = std::size_t{512} << 20U;

    /// Throws InputError when the source is no ZIP archive.
    explicit OpcPackage(const MeshSource& source);

    bool has(const std::string& part) const;
    /// Returns a part's content. Its size is limited to the rest of max_bytes after `account`, because a
    /// small archive can unpack to more than the available memory. Throws InputError when the part is
    /// missing, damaged or too large.
    std::string read(const std::string& part);
    /// Subtracts bytes that stay in memory from the limit.
    void account(std::size_t bytes);

  private:
    [[noreturn]] void reject_size() const;

    struct Discard {
        void operator()(struct zip* archive) const;
    };
    const MeshSource& source_;
    std::unique_ptr<struct zip, Discard> zip_;
    std::size_t unpacked_left_ = max_bytes;
};

/// Returns the name of the part that a reference within a package means: without leading slashes.
std::string part_name(std::string_view target);

}  // namespace lamella
