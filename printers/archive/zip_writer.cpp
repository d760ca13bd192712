// Compressed entries and the data descriptors after them.
#include "printers/archive/zip_writer.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

#include "engine/base/error.h"

namespace lamella {
namespace {

constexpr std::uint64_t max_bytes = std::numeric_limits<std::uint32_t>::max() - 1;
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
    std::error_code ignored;  // the original error is the one to report
    std::filesystem::remove(unfinished_, ignored);
}

void ZipWriter::put(std::string_view bytes) {
    if (file_.size() + bytes.size() > max_bytes)
        throw FaultError(path_.string() + " would exceed 4 GiB, the most that a ZIP archive holds");
    file_.write(bytes);
}

void ZipWriter::begin_entry(std::string name) {
    end_entry();
    constexpr std::size_t longest_name = 1024, max_entries = 65535;
    if (name.empty() || name.size() > longest_name || entries_.size() == max_entries)
        throw FaultError(path_.string() +
                         ": an archive holds up to 65535 entries with names of 1 to 1024 bytes");
    ZipEntry entry;
    entry.name = std::move(name);
    entry.offset = file_.size();
    entries_.push_back(std::move(entry));
    std::string header;
    put_local_header(header, entries_.back(), ZipMethod::deflated);
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
        ZipEntry& entry = entries_.back();
        entry.size += part.size();
        if (entry.size > max_bytes)
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
    const ZipEntry& entry = entries_.back();
    std::string descriptor;
    put_little(descriptor, 0x08074b50, 4);
    put_little(descriptor, entry.crc, 4);
    put_little(descriptor, entry.packed, 4);
    put_little(descriptor, entry.size, 4);
    put(descriptor);
}

void ZipWriter::finish() {
    end_entry();
    std::string directory;
    put_directory(directory, entries_, file_.size(), ZipMethod::deflated);
    put(directory);
    file_.sync();
    file_.close();
    rename_output(unfinished_, path_);
    finished_ = true;
}

}  // namespace lamella
