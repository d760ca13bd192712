// A temporary file of its own, and a rename.
#include "engine/base/complete_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "engine/base/error.h"

namespace lamella {

namespace {

/// Makes a file that no other thread or process has, with the rights that new files have.
std::string make_unfinished(const std::string& file) {
    constexpr int most_tries = 1000;
    for (int i = 0; i < most_tries; ++i) {
        std::string name = file + ".partial." + std::to_string(getpid()) + "." + std::to_string(i);
        const int descriptor = open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            close(descriptor);
            return name;
        }
        if (errno != EEXIST) break;
    }
    throw FaultError(file + " cannot be written");
}

}  // namespace

void write_complete_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
    const std::string unfinished = make_unfinished(file.string());
    std::error_code error, ignored;
    try {
        std::ofstream out(unfinished, std::ios::binary);
        write(out);
        out.close();
        if (!out) throw FaultError(file.string() + " cannot be written");
        std::filesystem::rename(unfinished, file, error);
        if (error) throw FaultError(file.string() + " cannot be written");
    } catch (...) {
        std::filesystem::remove(unfinished, ignored);
        throw;
    }
}

}  // namespace lamella
