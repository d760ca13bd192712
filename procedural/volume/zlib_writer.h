// ZlibWriter: packs bytes into a zlib stream, whose end is a checksum (Adler-32).
#pragma once

#include <zlib.h>

#include <cstdint>
#include <ostream>
#include <span>
#include <vector>

namespace lamella {

class ZlibWriter {
  public:
    /// The stream has to outlive the writer. Throws FaultError when zlib cannot be started.
    explicit ZlibWriter(std::ostream& out);
    ~ZlibWriter() { deflateEnd(&zlib_); }
    ZlibWriter(const ZlibWriter&) = delete;
    ZlibWriter& operator=(const ZlibWriter&) = delete;

    void write(std::span<const std::uint8_t> bytes);
    /// Writes the number as it lies in memory: little endian.
    template <class Number>
    void write_number(const Number& number) {
        write({reinterpret_cast<const std::uint8_t*>(&number), sizeof number});
    }
    /// Ends the stream.
    void finish() { pack({}, Z_FINISH); }

  private:
    void pack(std::span<const std::uint8_t> bytes, int flush);

    std::ostream& out_;
    std::vector<Bytef> packed_;
    z_stream zlib_{};
};

}  // namespace lamella
