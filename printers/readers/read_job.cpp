// Recognises the format of a job by its first bytes and its content.
#include "printers/readers/read_job.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "printers/readers/job_readers.h"

namespace lamella {
namespace {

/// File name extensions that promise a job.
struct Ending {
    const char* ending;
    const char* promise;
};
constexpr std::array endings{Ending{".sl1", "an SL1 archive"},      Ending{".sl1s", "an SL1 archive"},
                             Ending{".goo", "a GOO file"},          Ending{".nanodlp", "a NanoDLP archive"},
                             Ending{".tar.gz", "an Ember archive"}, Ending{".tgz", "an Ember archive"}};

std::string lower(std::string text) {
    for (char& c : text) c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

/// Returns the first bytes of a file; empty if it cannot be read, which a later reader reports.
std::string first_bytes(const std::string& path) {
    constexpr std::size_t enough = 12;
    std::string bytes(enough, '\0');
    std::ifstream in(path, std::ios::binary);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
}

std::unique_ptr<JobFile> open_archive(const std::string& path, bool named_as_model) {
    if (named_as_model) return nullptr;
    JobArchive archive(path);
    if (archive.has("config.ini")) return read_sl1(std::move(archive));
    for (const char* entry : {"plate.json", "meta.json", "slicer.json"}) {
        if (archive.has(entry)) return read_nanodlp(std::move(archive));
    }
    if (archive.has("[Content_Types].xml")) return nullptr;
    throw InputError(path +
                     ": this ZIP archive holds neither config.ini, as SL1 archives do, nor plate.json, as "
                     "NanoDLP archives do");
}

}  // namespace

std::unique_ptr<JobFile> open_if_job(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) return read_png_stack(path);
    const std::string begin = first_bytes(path), name = lower(path);
    if (begins_as_goo(begin)) return read_goo(path);
    if (begin.starts_with("PK\x03\x04") || begin.starts_with("PK\x05\x06"))
        return open_archive(path, name.ends_with(".3mf"));
    if (begin.starts_with("\x1f\x8b")) return read_ember(path);
    if (!std::filesystem::exists(path, ignored)) return nullptr;
    for (const Ending& known : endings) {
        if (name.ends_with(known.ending)) {
            throw InputError(path + ": named like " + known.promise +
                             ", but it does not begin as one; the file is damaged or something else");
        }
    }
    return nullptr;
}

std::unique_ptr<JobFile> open_job(const std::string& path) {
    if (!std::filesystem::exists(path)) throw InputError(path + ": there is no such file or folder");
    std::unique_ptr<JobFile> job = open_if_job(path);
    if (!job) {
        throw InputError(
            path +
            ": no job with layer masks; accepted: an SL1 archive, a GOO file, a NanoDLP archive, "
            "an Ember tar.gz, a folder of masks with a job.json");
    }
    return job;
}

}  // namespace lamella
