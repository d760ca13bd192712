// The `lamella` command: parses the command line, runs a subcommand, and turns exceptions into messages and
// exit codes.
#include <csignal>

#include "app/run_command.h"

int main(int argc, char** argv) {
    // A closed pipe is seen where it is written to, so that a lost progress display cannot end a print.
    std::signal(SIGPIPE, SIG_IGN);
    // A file that grows beyond what is allowed is a full disk: told as a fault, and to be continued.
    std::signal(SIGXFSZ, SIG_IGN);
    return lamella::run_command({argv, argv + argc});
}
