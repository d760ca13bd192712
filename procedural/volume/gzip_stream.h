// Bytes that are read block by block, and those that zlib decompresses.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace lamella {

/// A stream of bytes, read block by block.
class ByteStream {
  public:
    virtual ~ByteStream() = default;
    /// Reads up to `count` bytes into `out`; returns how many.
    virtual std::size_t read(char* out, std::size_t count) = 0;
};

/// Decompresses one or more members of a gzip file, or a zlib stream. Throws InputError ("name: ...") for
/// data that are damaged or cut off.
class GzipStream : public ByteStream {
  public:
    static constexpr std::uint64_t max_packing = 1032;  ///< maximum ratio of deflate

    GzipStream(std::istream& in, const std::string& name);
    ~GzipStream() override;
    GzipStream(const GzipStream&) = delete;
    GzipStream& operator=(const GzipStream&) = delete;

    std::size_t read(char* out, std::size_t count) override;

  private:
    void refill();

    std::istream& in_;
    const std::string& name_;
    std::vector<char> input_;
    z_stream zlib_{};
    bool at_end_ = false;
};

/// Returns the number of bytes from here to the end of the file. Throws InputError ("name: ...") for a stream
/// whose length is unknown.
std::uint64_t bytes_left(std::istream& in, const std::string& name);

}  // namespace lamella
