// Buffered writing that checks every error, and the rename that completes a file.
#include "app/console/text_output.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace lamella {

TextOutput::TextOutput(const std::string& path) : path_(path == "-" ? "" : path), file_(stdout) {
    if (path_.empty()) return;
    std::error_code ignored;
    if (std::filesystem::is_directory(path_, ignored))
        throw InputError(path_ + ": is a folder; a file name is needed");
    // Devices and pipes cannot be renamed: they are written in place.
    const bool in_place =
        std::filesystem::exists(path_, ignored) && !std::filesystem::is_regular_file(path_, ignored);
    if (!in_place) temporary_ = path_ + ".part";
    file_ = std::fopen((in_place ? path_ : temporary_).c_str(), "wb");
    if (!file_)
        throw FaultError((in_place ? path_ : temporary_) + ": cannot be made: " + std::strerror(errno));
}

TextOutput::~TextOutput() {
    if (path_.empty() || !file_) return;
    std::fclose(file_);
    if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void TextOutput::fail(const std::string& what) const {
    const int error = errno;
    if (error == EPIPE) throw ReaderGone();
    throw FaultError((path_.empty() ? "standard output" : path_) + ": cannot be " + what + ": " +
                     std::strerror(error));
}

void TextOutput::write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("written");
}

void TextOutput::flush() {
    if (std::fflush(file_) != 0) fail("written");
}

void TextOutput::close() {
    flush();
    if (path_.empty()) return;
    std::FILE* file = file_;
    file_ = nullptr;
    if (std::fclose(file) != 0) fail("written");
    if (!temporary_.empty() && std::rename(temporary_.c_str(), path_.c_str()) != 0)
        fail("renamed from its temporary name");
}

bool TextOutput::to_terminal() const { return isatty(fileno(file_)) != 0; }

}  // namespace lamella
