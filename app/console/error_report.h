// Turns exceptions into messages on standard error and exit codes.
#pragma once

#include <string>

namespace lamella {

/// Prints a message on standard error, each line prefixed with the program's name. Returns `code`.
int report_error(const std::string& message, int code);

/// Prints the message of the exception being handled. Returns its exit code.
int report_exception();

}  // namespace lamella
