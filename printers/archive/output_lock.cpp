// OutputLock by flock(2), which also works on folders.
#include "printers/archive/output_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "engine/base/error.h"

namespace lamella {

void OutputLock::take(const std::filesystem::path& path) {
    release();
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0 || flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    const bool taken = errno == EWOULDBLOCK;
    release();
    if (taken)
        throw InputError(path.string() +
                         " is being written by another run; wait until that ends, or choose another name");
}

void OutputLock::release() {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
}

}  // namespace lamella
