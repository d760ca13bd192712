// The `lamella` command: parses the command line, runs a subcommand, and turns exceptions into messages and
// exit codes.
#include <csignal>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "app/commands/run_command.h"

int main(int argc, char** argv) {
    // A closed pipe is detected where it is written to, so that a lost progress display cannot end a print.
    std::signal(SIGPIPE, SIG_IGN);
    // Exceeding the file size limit is treated like a full disk: reported as a fault, and the run can be
    // resumed.
    std::signal(SIGXFSZ, SIG_IGN);
#ifdef __GLIBC__
    // One heap for all threads: with one heap each, holes in one heap are of no use to others, and memory
    // grows with the number of layers. Threads rarely allocate at the same time, and they cache small blocks.
    mallopt(M_ARENA_MAX, 1);
#endif
    return lamella::run_command({argv, argv + argc});
}
