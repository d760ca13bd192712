// OutputLock: tells the runs of one machine which unfinished outputs are being written.
#pragma once

#include <filesystem>

namespace lamella {

/// An advisory lock on a file or folder that a run writes. It ends with the object, or with the process
/// however that ends. File systems without locks give none, and then no run notices another.
class OutputLock {
  public:
    OutputLock() = default;
    ~OutputLock() { release(); }
    OutputLock(const OutputLock&) = delete;
    OutputLock& operator=(const OutputLock&) = delete;

    /// Locks an unfinished output that may exist already. Throws InputError when another run writes it.
    void take(const std::filesystem::path& path);
    void release();

  private:
    int descriptor_ = -1;
};

}  // namespace lamella
