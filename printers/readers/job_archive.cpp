// Reads by libzip under a lock, with a limit on the unpacked size.
#include "printers/readers/job_archive.h"

#include <zip.h>

#include <algorithm>
#include <mutex>

#include "engine/base/error.h"

namespace lamella {

struct JobArchive::Open {
    explicit Open(zip_t* opened) : zip(opened) {}
    ~Open() { zip_discard(zip); }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;

    zip_t* zip;
    std::mutex busy;
};

JobArchive::JobArchive(const std::string& path) : path_(path) {
    int code = 0;
    zip_t* const zip = zip_open(path.c_str(), ZIP_RDONLY, &code);
    if (zip == nullptr) {
        zip_error_t error;
        zip_error_init_with_code(&error, code);
        const std::string why = zip_error_strerror(&error);
        zip_error_fini(&error);
        throw InputError(path + ": cannot be opened as a ZIP archive (" + why +
                         "); the file is damaged or cut off");
    }
    open_ = std::make_shared<Open>(zip);
}

std::vector<std::string> JobArchive::names() const {
    const std::lock_guard lock(open_->busy);
    std::vector<std::string> names;
    const zip_int64_t count = zip_get_num_entries(open_->zip, 0);
    for (zip_int64_t i = 0; i < count; ++i) {
        const char* const name = zip_get_name(open_->zip, static_cast<zip_uint64_t>(i), ZIP_FL_ENC_RAW);
        if (name != nullptr) names.emplace_back(name);
    }
    return names;
}

bool JobArchive::has(const std::string& name) const {
    const std::lock_guard lock(open_->busy);
    return zip_name_locate(open_->zip, name.c_str(), ZIP_FL_ENC_RAW) >= 0;
}

std::string JobArchive::read(const std::string& name, std::size_t most) const {
    const std::lock_guard lock(open_->busy);
    const auto reject = [&](const std::string& why) { throw InputError(path_ + ": '" + name + "' " + why); };
    const zip_int64_t index = zip_name_locate(open_->zip, name.c_str(), ZIP_FL_ENC_RAW);
    if (index < 0) reject("is missing in the archive");
    const std::unique_ptr<zip_file_t, void (*)(zip_file_t*)> file(
        zip_fopen_index(open_->zip, static_cast<zip_uint64_t>(index), 0), [](zip_file_t* opened) {
            if (opened != nullptr) zip_fclose(opened);
        });
    if (!file) reject(std::string("cannot be unpacked (") + zip_strerror(open_->zip) + ")");
    std::string content;
    for (;;) {
        // The stated size may be wrong, so the bytes actually unpacked are counted.
        const std::size_t used = content.size();
        content.resize(used + std::clamp(used, std::size_t{1} << 14U, std::size_t{1} << 24U));
        const zip_int64_t got = zip_fread(file.get(), content.data() + used, content.size() - used);
        if (got < 0) {
            reject(std::string("cannot be unpacked (") + zip_file_strerror(file.get()) +
                   "); the file is damaged or cut off");
        }
        content.resize(used + static_cast<std::size_t>(got));
        if (content.size() > most) reject("unpacks to more than " + std::to_string(most) + " bytes");
        if (got == 0) return content;
    }
}

}  // namespace lamella
