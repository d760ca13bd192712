// Recognises the format of a job by its first bytes and its content.
#include "printers/readers/read_job.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "printers/readers/job_readers.h"

namespace lamella {
namespace {

/// Returns the first bytes of a file; empty if it cannot be read, which a later reader reports.
std::string first_bytes(const std::string& path) {
    constexpr std::size_t enough = 12;
    std::string bytes(enough, '\0');
    std::ifstream in(path, std::ios::binary);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
}

/// A file or folder that may be a job.
struct Candidate {
    std::string path, begin;  ///< its name and its first bytes
    bool is_folder = false;
    std::optional<JobArchive> archive;  ///< its entries, if it is a ZIP archive
};

/// A format of jobs.
struct JobFormat {
    const char* name;                  ///< with its article
    std::vector<const char*> endings;  ///< that promise a job of this format
    bool (*fits)(const Candidate& candidate);
    std::unique_ptr<JobFile> (*read)(Candidate& candidate);
};

bool has_entry(const Candidate& candidate, std::initializer_list<const char*> names) {
    return candidate.archive &&
           std::ranges::any_of(names, [&](const char* name) { return candidate.archive->has(name); });
}

std::span<const JobFormat> job_formats() {
    static const std::vector<JobFormat> list{
        {"an SL1 archive",
         {".sl1", ".sl1s"},
         [](const Candidate& c) { return has_entry(c, {"config.ini"}); },
         [](Candidate& c) { return read_sl1(std::move(*c.archive)); }},
        {"a GOO file",
         {".goo"},
         [](const Candidate& c) { return begins_as_goo(c.begin); },
         [](Candidate& c) { return read_goo(c.path); }},
        {"a NanoDLP archive",
         {".nanodlp"},
         [](const Candidate& c) {
             return has_entry(c, {"plate.json", "meta.json", "slicer.json"});
         },
         [](Candidate& c) { return read_nanodlp(std::move(*c.archive)); }},
        {"an Ember archive",
         {".tar.gz", ".tgz"},
         [](const Candidate& c) { return c.begin.starts_with("\x1f\x8b"); },
         [](Candidate& c) { return read_ember(c.path); }},
        {"a folder of masks with a job.json",
         {},
         [](const Candidate& c) { return c.is_folder; },
         [](Candidate& c) { return read_png_stack(c.path); }}};
    return list;
}

/// Looks at a file or folder. Models in 3MF are ZIP archives that are not opened here.
Candidate look_at(const std::string& path, const std::string& name) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) return {path, "", true, std::nullopt};
    Candidate candidate{path, first_bytes(path), false, std::nullopt};
    const bool is_zip =
        candidate.begin.starts_with("PK\x03\x04") || candidate.begin.starts_with("PK\x05\x06");
    if (is_zip && !name.ends_with(".3mf")) candidate.archive.emplace(path);
    return candidate;
}

}  // namespace

std::vector<std::string> job_endings() {
    std::vector<std::string> endings;
    for (const JobFormat& format : job_formats())
        endings.insert(endings.end(), format.endings.begin(), format.endings.end());
    return endings;
}

std::unique_ptr<JobFile> open_if_job(const std::string& path) {
    const std::string name = lower_case(path);
    Candidate candidate = look_at(path, name);
    for (const JobFormat& format : job_formats()) {
        if (format.fits(candidate)) return format.read(candidate);
    }
    if (candidate.archive) {
        if (candidate.archive->has("[Content_Types].xml")) return nullptr;
        throw InputError(
            path +
            ": this ZIP archive holds neither config.ini, as SL1 archives do, nor plate.json, as "
            "NanoDLP archives do");
    }
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return nullptr;
    for (const JobFormat& format : job_formats()) {
        for (const char* ending : format.endings) {
            if (!name.ends_with(ending)) continue;
            throw InputError(path + ": named like " + format.name +
                             ", but it does not begin as one; the file is damaged or something else");
        }
    }
    return nullptr;
}

std::unique_ptr<JobFile> open_job(const std::string& path) {
    if (!std::filesystem::exists(path)) throw InputError(path + ": there is no such file or folder");
    std::unique_ptr<JobFile> job = open_if_job(path);
    if (job) return job;
    std::string names;
    for (const JobFormat& format : job_formats())
        names += std::string(names.empty() ? "" : ", ") + format.name;
    throw InputError(path + ": no job with layer masks; accepted: " + names);
}

}  // namespace lamella
