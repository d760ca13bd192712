// The ZIP archive that a 3MF file is, open for reading from memory.
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
    /// Most that is unpacked of one file's XML, and of any other part of it.
    static constexpr std::size_t max_bytes = std::size_t{512} << 20U;

    /// Throws InputError for what is no archive.
    explicit OpcPackage(const MeshSource& source);

    bool has(const std::string& part) const;
    /// A part's content. Its size is bounded by what `account` has left of max_bytes: a small archive can
    /// unpack to more than any memory. Throws InputError for a part that is missing, damaged or too large.
    std::string read(const std::string& part);
    /// Takes bytes that are kept off what may be unpacked.
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

/// The name of the part that a reference within a package means: without its leading slashes.
std::string part_name(std::string_view target);

}  // namespace lamella
