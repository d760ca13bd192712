// Local headers, deflated data, data descriptors and the central directory.
#include "printers/zip_writer.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

#include "engine/error.h"

namespace lamella {
namespace {

constexpr std::uint64_t most_bytes = std::numeric_limits<std::uint32_t>::max() - 1;
constexpr std::uint32_t version = 20;        // deflate and folders
constexpr std::uint32_t flags = 0x0808;      // sizes follow the data; names are UTF-8
constexpr std::uint32_t deflated = 8;        // the method
constexpr std::uint32_t first_day = 0x0021;  // 1980-01-01

void put_u16(std::string& out, std::uint64_t value) {
    out.push_back(static_cast<char>(value & 0xff));
    out.push_back(static_cast<char>(value >> 8 & 0xff));
}

void put_u32(std::string& out, std::uint64_t value) {
    put_u16(out, value & 0xffff);
    put_u16(out, value >> 16);
}

/// What local headers and the directory have in common, from the version needed to the length of the name.
void put_common(std::string& out, std::uint32_t crc, std::uint64_t packed, std::uint64_t size,
                const std::string& name) {
    put_u16(out, version);
    put_u16(out, flags);
    put_u16(out, deflated);
    put_u16(out, 0);  // midnight
    put_u16(out, first_day);
    put_u32(out, crc);
    put_u32(out, packed);
    put_u32(out, size);
    put_u16(out, name.size());
    put_u16(out, 0);  // no extra field
}

}  // namespace

struct ZipWriter::Deflater {
    z_stream stream{};

    Deflater() {
        constexpr int raw_window = -15, memory = 8;
        if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, raw_window, memory,
                         Z_DEFAULT_STRATEGY) != Z_OK) {
            throw FaultError("there is no memory left to compress with");
        }
    }
    ~Deflater() { deflateEnd(&stream); }
    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;
};

ZipWriter::ZipWriter(std::filesystem::path path)
    : path_(std::move(path)), unfinished_(path_), deflater_(std::make_unique<Deflater>()) {
    if (path_.filename().empty()) throw InputError("'" + path_.string() + "' does not name an output file");
    if (std::filesystem::is_directory(path_)) throw InputError(path_.string() + " is a folder; name a file");
    unfinished_ += ".tmp";
    file_ = OutputFile::create(unfinished_);
}

ZipWriter::~ZipWriter() {
    if (finished_) return;
    std::error_code ignored;  // the error that brought us here is the one to report
    std::filesystem::remove(unfinished_, ignored);
}

void ZipWriter::put(std::string_view bytes) {
    if (file_.size() + bytes.size() > most_bytes)
        throw FaultError(path_.string() + " would exceed 4 GiB, the most that a ZIP archive holds");
    file_.write(bytes);
}

void ZipWriter::begin_entry(std::string name) {
    end_entry();
    constexpr std::size_t longest_name = 1024, most_entries = 65535;
    if (name.empty() || name.size() > longest_name || entries_.size() == most_entries)
        throw FaultError(path_.string() +
                         ": an archive holds up to 65535 entries with names of 1 to 1024 bytes");
    entries_.push_back({std::move(name), file_.size()});
    std::string header;
    put_u32(header, 0x04034b50);
    put_common(header, 0, 0, 0, entries_.back().name);
    header += entries_.back().name;
    put(header);
    deflateReset(&deflater_->stream);
    open_ = true;
}

void ZipWriter::write(std::string_view text) {
    if (!open_) throw FaultError(path_.string() + ": nothing can be written outside an entry");
    // zlib counts in 32 bits.
    constexpr std::size_t step = std::size_t{1} << 30U;
    for (; !text.empty(); text.remove_prefix(std::min(step, text.size()))) {
        const std::string_view part = text.substr(0, step);
        Entry& entry = entries_.back();
        entry.size += part.size();
        if (entry.size > most_bytes)
            throw FaultError(path_.string() + ": " + entry.name +
                             " would exceed 4 GiB, the most a ZIP entry holds");
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): zlib speaks of unsigned char
        const auto* bytes = reinterpret_cast<const Bytef*>(part.data());
        entry.crc = static_cast<std::uint32_t>(crc32(entry.crc, bytes, static_cast<uInt>(part.size())));
        deflate_all(part, false);
    }
}

void ZipWriter::deflate_all(std::string_view text, bool last) {
    z_stream& stream = deflater_->stream;
    std::array<char, 1 << 16> packed;
    // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast, cppcoreguidelines-pro-type-const-cast): zlib's
    // input is not const, though it is never written to
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    do {
        stream.next_out = reinterpret_cast<Bytef*>(packed.data());
        stream.avail_out = static_cast<uInt>(packed.size());
        deflate(&stream, last ? Z_FINISH : Z_NO_FLUSH);
        const std::size_t made = packed.size() - stream.avail_out;
        entries_.back().packed += made;
        put({packed.data(), made});
    } while (stream.avail_out == 0);
    // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast, cppcoreguidelines-pro-type-const-cast)
}

void ZipWriter::end_entry() {
    if (!open_) return;
    deflate_all({}, true);
    open_ = false;
    const Entry& entry = entries_.back();
    std::string descriptor;
    put_u32(descriptor, 0x08074b50);
    put_u32(descriptor, entry.crc);
    put_u32(descriptor, entry.packed);
    put_u32(descriptor, entry.size);
    put(descriptor);
}

void ZipWriter::finish() {
    end_entry();
    std::string directory;
    for (const Entry& entry : entries_) {
        put_u32(directory, 0x02014b50);
        put_u16(directory, version);
        put_common(directory, entry.crc, entry.packed, entry.size, entry.name);
        put_u16(directory, 0);  // no comment
        put_u16(directory, 0);  // disk 0
        put_u16(directory, 0);  // no internal attributes
        put_u32(directory, 0);  // no external attributes
        put_u32(directory, entry.offset);
        directory += entry.name;
    }
    const std::uint64_t start = file_.size(), length = directory.size();
    put_u32(directory, 0x06054b50);
    put_u16(directory, 0);  // this disk
    put_u16(directory, 0);  // the directory's disk
    put_u16(directory, entries_.size());
    put_u16(directory, entries_.size());
    put_u32(directory, length);
    put_u32(directory, start);
    put_u16(directory, 0);  // no comment
    put(directory);
    file_.sync();
    file_.close();
    rename_output(unfinished_, path_);
    finished_ = true;
}

}  // namespace lamella
