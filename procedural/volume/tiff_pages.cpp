// Follows the chain of a TIFF file's directories.
#include "procedural/volume/tiff_pages.h"

#include <algorithm>
#include <cstdint>
#include <istream>

#include "engine/base/error.h"

namespace lamella {
namespace {

/// Reads integers of a given byte order at file offsets.
class OrderedBytes {
  public:
    OrderedBytes(std::istream& in, bool big_endian) : in_(in), big_endian_(big_endian) {}

    /// Returns none beyond the end of the file.
    std::optional<std::uint64_t> number(std::uint64_t at, std::size_t bytes) {
        unsigned char raw[8] = {};
        in_.clear();
        if (at > std::uint64_t{1} << 62U || !in_.seekg(static_cast<std::streamoff>(at))) return std::nullopt;
        if (!in_.read(reinterpret_cast<char*>(raw), static_cast<std::streamsize>(bytes))) return std::nullopt;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes; ++i) value = value << 8U | raw[big_endian_ ? i : bytes - 1 - i];
        return value;
    }

    std::uint64_t size() {
        in_.clear();
        in_.seekg(0, std::ios::end);
        return static_cast<std::uint64_t>(in_.tellg());
    }

  private:
    std::istream& in_;
    bool big_endian_;
};

/// A directory entry with one number per strip or tile: its offset or its number of bytes.
struct Column {
    std::uint64_t at = 0;     ///< offset of the first number
    std::uint64_t count = 0;  ///< 0 if the directory has no such entry
    std::size_t bytes = 0;    ///< per number
};

/// The directories of one file.
class Directories {
  public:
    Directories(OrderedBytes bytes, bool wide) : bytes_(bytes), wide_(wide), file_size_(bytes_.size()) {}

    std::optional<std::uint64_t> first() { return bytes_.number(wide_ ? 8 : 4, offset_bytes()); }
    /// Returns the offset of the next directory, 0 at the end; none if this directory is truncated.
    std::optional<std::uint64_t> next(std::uint64_t at) {
        const auto entries = bytes_.number(at, count_bytes());
        if (!entries || *entries > 0xffffU) return std::nullopt;
        directory_bytes_ += count_bytes() + *entries * entry_bytes() + offset_bytes();
        return bytes_.number(at + count_bytes() + *entries * entry_bytes(), offset_bytes());
    }
    /// Returns whether the directories so far take more room than the file has: then one of them came twice.
    bool overlap() const { return directory_bytes_ > file_size_; }
    /// Returns whether the directories so far list more strips and tiles than the file has bytes.
    bool list_too_much() const { return listed_ > file_size_; }
    /// Returns whether all strips and tiles of a directory lie within the file.
    bool holds_its_samples(std::uint64_t at) {
        constexpr std::uint64_t strip_offsets = 273, strip_sizes = 279, tile_offsets = 324, tile_sizes = 325;
        return inside(column(at, strip_offsets), column(at, strip_sizes)) &&
               inside(column(at, tile_offsets), column(at, tile_sizes));
    }

  private:
    std::size_t offset_bytes() const { return wide_ ? 8 : 4; }
    std::size_t count_bytes() const { return wide_ ? 8 : 2; }
    std::size_t entry_bytes() const { return wide_ ? 20 : 12; }

    Column column(std::uint64_t at, std::uint64_t tag) {
        constexpr std::uint64_t short_number = 3, long_number = 4, long8_number = 16;
        const std::uint64_t entries = bytes_.number(at, count_bytes()).value_or(0);
        for (std::uint64_t i = 0; i < entries; ++i) {
            const std::uint64_t entry = at + count_bytes() + i * entry_bytes();
            if (bytes_.number(entry, 2) != tag) continue;
            const std::uint64_t type = bytes_.number(entry + 2, 2).value_or(0);
            Column found;
            found.bytes = type == short_number ? 2 : type == long_number ? 4 : type == long8_number ? 8 : 0;
            found.count = found.bytes > 0 ? bytes_.number(entry + 4, offset_bytes()).value_or(0) : 0;
            found.at = entry + 4 + offset_bytes();
            // Values that do not fit into the entry are stored elsewhere.
            if (found.count > offset_bytes() / std::max<std::size_t>(found.bytes, 1)) {
                found.at = bytes_.number(found.at, offset_bytes()).value_or(file_size_);
            }
            return found;
        }
        return {};
    }

    bool inside(const Column& offsets, const Column& sizes) {
        const std::uint64_t count = std::min(offsets.count, sizes.count);
        if (count > file_size_) return false;
        listed_ += count;
        if (list_too_much()) return true;
        for (std::uint64_t i = 0; i < count; ++i) {
            const auto offset = bytes_.number(offsets.at + i * offsets.bytes, offsets.bytes);
            const auto size = bytes_.number(sizes.at + i * sizes.bytes, sizes.bytes);
            if (!offset || !size || *offset > file_size_ || *size > file_size_ - *offset) return false;
        }
        return true;
    }

    OrderedBytes bytes_;
    bool wide_;
    std::uint64_t file_size_;
    std::uint64_t directory_bytes_ = 0;
    std::uint64_t listed_ = 0;
};

}  // namespace

std::optional<std::size_t> count_tiff_pages(std::istream& in, const std::string& name) {
    constexpr std::uint64_t classic = 42, big = 43;
    char order[2] = {};
    if (!in.read(order, 2) || order[0] != order[1] || (order[0] != 'I' && order[0] != 'M'))
        return std::nullopt;
    OrderedBytes bytes(in, order[0] == 'M');
    const auto magic = bytes.number(2, 2);
    const bool wide = magic == big;
    if (!wide && magic != classic) return std::nullopt;
    Directories directories(bytes, wide);
    auto at = directories.first();
    std::size_t pages = 0;
    for (; at && *at != 0; ++pages) {
        // Both limits keep the time for a hostile file proportional to its size.
        const auto next = directories.next(*at);
        if (next && directories.overlap()) throw InputError(name + ": its chain of TIFF pages has no end");
        if (next && !directories.holds_its_samples(*at)) {
            throw InputError(name + ": the file is cut off: samples of its page " + std::to_string(pages) +
                             " lie beyond its end");
        }
        if (directories.list_too_much()) {
            throw InputError(name + ": the file is damaged: up to page " + std::to_string(pages) +
                             " it lists more strips of samples than it has bytes");
        }
        at = next;
    }
    if (!at) throw InputError(name + ": the file is cut off: its chain of TIFF pages leads beyond its end");
    return pages;
}

}  // namespace lamella
