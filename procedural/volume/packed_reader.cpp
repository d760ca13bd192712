// The magic first, then a zlib stream to the end of the file.
#include "procedural/volume/packed_reader.h"

#include "engine/base/error.h"

namespace lamella {

namespace {

/// Returns the number of bytes behind the magic.
std::uint64_t bytes_behind(const PackedMagic& magic, std::istream& in, const std::string& name,
                           const char* what) {
    PackedMagic begins{};
    if (!in.read(begins.data(), begins.size()) || begins != magic)
        throw InputError(name + ": this is no file of " + what);
    return bytes_left(in, name);
}

}  // namespace

PackedReader::PackedReader(std::istream& in, const std::string& name, const PackedMagic& magic,
                           const char* what)
    : name_(name), most_(bytes_behind(magic, in, name, what) * GzipStream::max_packing), packed_(in, name) {}

void PackedReader::take_bytes(void* out, std::size_t bytes) {
    if (packed_.read(static_cast<char*>(out), bytes) < bytes)
        throw InputError(name_ + ": fewer bricks are there than the header announces");
}

void PackedReader::check_length(std::uint64_t bytes) const {
    if (bytes > most_) throw InputError(name_ + ": it is too short for the bricks that it announces");
}

void PackedReader::finish() {
    char beyond = 0;
    if (packed_.read(&beyond, 1) > 0) throw InputError(name_ + ": more follows after the last brick");
}

}  // namespace lamella
