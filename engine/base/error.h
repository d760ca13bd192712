// The exceptions of the library. All derive from Error, and each maps to one exit code of the command.
#pragma once

#include <stdexcept>
#include <string>

namespace lamella {

/// Base of everything the library throws.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// The command's exit code: 1 constraint violated, 2 bad input, 3 fault while running, 130 interrupted.
    virtual int exit_code() const { return 3; }
};

/// The user's input is wrong: a file, a key, a value. The message names it and says what would be right.
class InputError : public Error {
  public:
    using Error::Error;
    int exit_code() const override { return 2; }
};

/// A stated constraint does not hold.
class ConstraintError : public Error {
  public:
    using Error::Error;
    int exit_code() const override { return 1; }
};

/// Something failed while running: the disk is full, the printer is gone.
class FaultError : public Error {
  public:
    using Error::Error;
};

/// The user asked to stop. The message says how to go on.
class Interrupted : public Error {
  public:
    using Error::Error;
    int exit_code() const override { return 130; }
};

}  // namespace lamella
