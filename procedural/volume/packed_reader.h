// PackedReader: reads what ZlibWriter packed behind the magic of a file.
#pragma once

#include <array>
#include <cstdint>
#include <istream>
#include <string>

#include "procedural/volume/gzip_stream.h"

namespace lamella {

/// The first bytes of a packed file of bricks.
using PackedMagic = std::array<char, 16>;

class PackedReader {
  public:
    /// The stream, whose length has to be known, and the name for messages have to outlive the reader. `what`
    /// says what such files hold. Throws InputError ("name: ...") for another magic.
    PackedReader(std::istream& in, const std::string& name, const PackedMagic& magic, const char* what);

    /// Reads numbers as they lie in memory: little endian. Throws InputError when fewer are there.
    template <class Number>
    void take(Number* numbers, std::size_t count) {
        take_bytes(numbers, count * sizeof(Number));
    }
    /// Throws InputError when the file cannot hold this many bytes, however well packed: to be called before
    /// memory is taken for them.
    void check_length(std::uint64_t bytes) const;
    /// Throws InputError when more follows.
    void finish();

  private:
    void take_bytes(void* out, std::size_t bytes);

    const std::string& name_;
    std::uint64_t most_;  ///< bytes that the file can hold
    GzipStream packed_;
};

}  // namespace lamella
