// Where exceptions become messages on standard error, and exit codes.
#pragma once

#include <string>

namespace lamella {

/// Says a message on standard error, each of its lines with the program's name before it. Returns the code.
int report_error(const std::string& message, int code);

/// Says what the exception that is being handled is about. Returns the exit code it stands for.
int report_exception();

}  // namespace lamella
