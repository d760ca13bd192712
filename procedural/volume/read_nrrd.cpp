// Reads the samples of an NRRD file: raw, gzip or text.
#include <algorithm>
#include <bit>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <istream>
#include <limits>
#include <type_traits>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "procedural/volume/gzip_stream.h"
#include "procedural/volume/nrrd_header.h"
#include "procedural/volume/volume.h"

namespace lamella {
namespace {

[[noreturn]] void fail(const std::string& name, const std::string& what) {
    throw InputError(name + ": " + what);
}

class PlainStream : public ByteStream {
  public:
    explicit PlainStream(std::istream& in) : in_(in) {}
    std::size_t read(char* out, std::size_t count) override {
        in_.read(out, static_cast<std::streamsize>(count));
        return static_cast<std::size_t>(in_.gcount());
    }

  private:
    std::istream& in_;
};

/// Splits text into tokens separated by white space or commas.
class TokenStream {
  public:
    explicit TokenStream(ByteStream& bytes) : bytes_(bytes), block_(std::size_t{1} << 16U) {}

    /// Returns the next token, empty at the end. Tokens are truncated, but to more than any number needs.
    std::string_view next() {
        constexpr std::size_t longest = 400;
        token_.clear();
        for (int c = get(); c >= 0; c = get()) {
            const bool separates = c == ' ' || c == ',' || (c >= '\t' && c <= '\r');
            if (separates && !token_.empty()) break;
            if (!separates && token_.size() < longest) token_.push_back(static_cast<char>(c));
        }
        return token_;
    }

  private:
    int get() {
        if (at_ == size_) {
            size_ = bytes_.read(block_.data(), block_.size());
            at_ = 0;
        }
        return at_ < size_ ? static_cast<unsigned char>(block_[at_++]) : -1;
    }

    ByteStream& bytes_;
    std::vector<char> block_;
    std::size_t at_ = 0, size_ = 0;
    std::string token_;
};

template <class T>
bool parse(std::string_view token, T& value) {
    if constexpr (std::is_floating_point_v<T>) {
        const auto number = parse_double(token);
        if (number) value = static_cast<T>(*number);
        return number.has_value();
    } else {
        if (token.starts_with('+')) token.remove_prefix(1);
        const char* const end = token.data() + token.size();
        const auto [stop, status] = std::from_chars(token.data(), end, value);
        return status == std::errc() && stop == end && !token.empty();
    }
}

std::string announced(std::size_t n, std::string_view noun) {
    return "the header announces " + counted(n, noun) + ", but ";
}

template <class T>
std::vector<T> read_text(ByteStream& bytes, std::size_t count, const std::string& name) {
    TokenStream tokens(bytes);
    std::vector<T> samples(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view token = tokens.next();
        if (token.empty()) fail(name, announced(count, "number") + "only " + grouped(i) + " are there");
        if (!parse(token, samples[i])) {
            fail(name,
                 "number " + grouped(i + 1) + " of the data, " + excerpt(token) + ", does not fit the type");
        }
    }
    if (!tokens.next().empty()) fail(name, announced(count, "number") + "more are there");
    return samples;
}

template <class T>
std::vector<T> read_binary(ByteStream& bytes, std::size_t count, bool big_endian, const std::string& name) {
    std::vector<T> samples(count);
    const std::size_t size = count * sizeof(T);
    char* const data = reinterpret_cast<char*>(samples.data());
    const std::size_t got = bytes.read(data, size);
    if (got < size) fail(name, announced(size, "byte") + "only " + grouped(got) + " are there");
    char beyond = 0;
    if (bytes.read(&beyond, 1) > 0) fail(name, announced(size, "byte") + "more are there");
    if (sizeof(T) > 1 && big_endian != (std::endian::native == std::endian::big)) {
        for (std::size_t i = 0; i < size; i += sizeof(T)) std::reverse(data + i, data + i + sizeof(T));
    }
    return samples;
}

void skip(ByteStream& bytes, std::int64_t count, const std::string& name) {
    char block[4096];
    for (auto left = static_cast<std::uint64_t>(count); left > 0;) {
        const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(left, sizeof block));
        if (bytes.read(block, part) < part) fail(name, "it is shorter than the bytes to skip");
        left -= part;
    }
}

void skip_lines(std::istream& in, std::int64_t count, const std::string& name) {
    for (; count > 0; --count) {
        int c = in.get();
        while (c != '\n' && c != std::istream::traits_type::eof()) c = in.get();
        if (c != '\n') fail(name, "it has fewer lines than are to be skipped");
    }
}

/// A number of bytes for a message; computers of 32 bits say no larger one than they can address.
std::size_t shown(std::uint64_t bytes) {
    return static_cast<std::size_t>(std::min<std::uint64_t>(bytes, std::numeric_limits<std::size_t>::max()));
}

/// Rejects a file that is too short for its header, before memory is allocated for it.
void check_length(std::istream& in, const NrrdHeader& header, std::size_t count, const std::string& name) {
    const std::uint64_t left = bytes_left(in, name), size = std::uint64_t{count} * sample_bytes(header.type);
    const bool possible = header.encoding == NrrdEncoding::raw    ? left >= size
                          : header.encoding == NrrdEncoding::gzip ? left * GzipStream::max_packing >= size
                                                                  : left + 1 >= 2 * count;
    if (possible) return;
    if (header.encoding == NrrdEncoding::text) {
        fail(name, announced(count, "number") + "only " + counted(shown(left), "byte") + " follow");
    }
    fail(name, announced(shown(size), "byte") + "only " + grouped(shown(left)) +
                   (header.encoding == NrrdEncoding::gzip ? " packed ones are there" : " are there"));
}

template <class T>
std::vector<T> read_samples(std::istream& in, const NrrdHeader& header, const std::string& name) {
    const std::size_t count = header.size[0] * header.size[1] * header.size[2];
    skip_lines(in, header.line_skip, name);
    in.clear();
    check_length(in, header, count, name);
    if (header.byte_skip < 0) in.seekg(-static_cast<std::streamoff>(count * sizeof(T)), std::ios::end);
    PlainStream plain(in);
    if (header.encoding == NrrdEncoding::gzip) {
        GzipStream packed(in, name);
        skip(packed, header.byte_skip, name);
        return read_binary<T>(packed, count, header.big_endian, name);
    }
    if (header.byte_skip > 0) skip(plain, header.byte_skip, name);
    if (header.encoding == NrrdEncoding::text) return read_text<T>(plain, count, name);
    return read_binary<T>(plain, count, header.big_endian, name);
}

VolumeSamples samples_of(std::istream& in, const NrrdHeader& header, const std::string& name) {
    switch (header.type) {
        case NrrdType::int8:
            return read_samples<std::int8_t>(in, header, name);
        case NrrdType::uint8:
            return read_samples<std::uint8_t>(in, header, name);
        case NrrdType::int16:
            return read_samples<std::int16_t>(in, header, name);
        case NrrdType::uint16:
            return read_samples<std::uint16_t>(in, header, name);
        case NrrdType::int32:
            return read_samples<std::int32_t>(in, header, name);
        case NrrdType::uint32:
            return read_samples<std::uint32_t>(in, header, name);
        case NrrdType::int64:
            return read_samples<std::int64_t>(in, header, name);
        case NrrdType::uint64:
            return read_samples<std::uint64_t>(in, header, name);
        case NrrdType::real32:
            return read_samples<float>(in, header, name);
        case NrrdType::real64:
            return read_samples<double>(in, header, name);
    }
    fail(name, "unknown type of sample");
}

}  // namespace

Volume read_nrrd(std::istream& in, const std::string& name, const std::string& folder) {
    const NrrdHeader header = read_nrrd_header(in, name);
    Volume volume;
    volume.size = header.size;
    volume.box = header.box;
    in.clear();  // a detached header may end with the file
    if (header.data_file.empty()) {
        volume.samples = samples_of(in, header, name);
        return volume;
    }
    const std::string path = (std::filesystem::path(folder) / header.data_file).string();
    std::error_code error;
    std::ifstream data;
    if (std::filesystem::is_regular_file(path, error)) data.open(path, std::ios::binary);
    if (!data.is_open()) fail(name, "its data file " + path + " cannot be opened");
    volume.samples = samples_of(data, header, path);
    return volume;
}

}  // namespace lamella
