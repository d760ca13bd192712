// Input in blocks of 64 KiB, decompressed straight into what is asked for.
#include "procedural/volume/gzip_stream.h"

#include <algorithm>

#include "engine/base/error.h"

namespace lamella {

GzipStream::GzipStream(std::istream& in, const std::string& name)
    : in_(in), name_(name), input_(std::size_t{1} << 16U) {
    constexpr int largest_window = 15, gzip_or_zlib = 32;
    if (inflateInit2(&zlib_, largest_window + gzip_or_zlib) != Z_OK)
        throw FaultError("zlib cannot be started");
}

GzipStream::~GzipStream() { inflateEnd(&zlib_); }

std::size_t GzipStream::read(char* out, std::size_t count) {
    std::size_t got = 0;
    while (got < count) {
        if (zlib_.avail_in == 0) refill();
        if (at_end_ && zlib_.avail_in == 0) break;
        if (at_end_) inflateReset(&zlib_);  // another member follows
        const std::size_t block = std::min(count - got, std::size_t{1} << 30U);
        zlib_.next_out = reinterpret_cast<Bytef*>(out + got);
        zlib_.avail_out = static_cast<uInt>(block);
        const int status = inflate(&zlib_, Z_NO_FLUSH);
        got += block - zlib_.avail_out;
        if (status == Z_BUF_ERROR && got == 0) throw InputError(name_ + ": the gzip data are cut off");
        if (status == Z_BUF_ERROR) break;  // end of input
        at_end_ = status == Z_STREAM_END;
        if (!at_end_ && status != Z_OK) throw InputError(name_ + ": the gzip data are damaged");
    }
    return got;
}

void GzipStream::refill() {
    in_.read(input_.data(), static_cast<std::streamsize>(input_.size()));
    zlib_.next_in = reinterpret_cast<Bytef*>(input_.data());
    zlib_.avail_in = static_cast<uInt>(in_.gcount());
}

std::uint64_t bytes_left(std::istream& in, const std::string& name) {
    const std::istream::pos_type here = in.tellg();
    in.seekg(0, std::ios::end);
    const std::istream::pos_type end = in.tellg();
    in.seekg(here);
    if (!in || here < 0 || end < here)
        throw InputError(name + ": it must be a plain file, whose size is known");
    return static_cast<std::uint64_t>(end - here);
}

}  // namespace lamella
