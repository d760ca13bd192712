// The `lamella` command: parses the command line, runs a subcommand, and turns exceptions into messages and
// exit codes.
#include <csignal>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "app/commands/run_command.h"

int main(int argc, char** argv) {
    // A closed pipe is seen where it is written to, so that a lost progress display cannot end a print.
    std::signal(SIGPIPE, SIG_IGN);
    // A file that grows beyond what is allowed is a full disk: told as a fault, and to be continued.
    std::signal(SIGXFSZ, SIG_IGN);
#ifdef __GLIBC__
    // One heap for all threads: with one each, the holes in some are no use to the others, and memory grows
    // with the number of layers. Threads seldom allocate at once; small blocks they keep for themselves.
    mallopt(M_ARENA_MAX, 1);
#endif
    return lamella::run_command({argv, argv + argc});
}
