// Made by mkdtemp: nobody else can have a folder of this name.
#include "app/jobs/temporary_folder.h"

#include <fmt/format.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is POSIX

#include <cerrno>
#include <system_error>

#include "engine/base/error.h"

namespace lamella {

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    std::string pattern = (std::filesystem::temp_directory_path(error) / "lamella-XXXXXX").string();
    if (error || ::mkdtemp(pattern.data()) == nullptr) {
        throw FaultError(fmt::format("{}: no folder for temporary files can be made there: {}", pattern,
                                     error ? error.message() : std::generic_category().message(errno)));
    }
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace lamella
