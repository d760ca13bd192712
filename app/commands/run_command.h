// The whole command as a function from arguments to an exit code.
#pragma once

#include <string>
#include <vector>

namespace lamella {

/// Runs `lamella` with these arguments (the first is the program's name). Never throws. Returns 0: done, 1:
/// constraint violated, 2: bad input, 3: fault while running, 130: interrupted.
int run_command(const std::vector<std::string>& arguments);

}  // namespace lamella
