// The command is spawned from its list of arguments, so nothing in a file's name is ever read by a shell.
#include "hosts/print_end.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <nlohmann/json.hpp>
#include <system_error>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX has it in no header

namespace lamella {

namespace {

void run_command(const std::vector<std::string>& command, const std::vector<std::string>& facts) {
    std::vector<std::string> texts = facts;
    std::vector<char*> environment;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        // A key is for the host alone.
        if (!std::string_view(*variable).starts_with("LAMELLA_HOST_KEY=")) environment.push_back(*variable);
    }
    for (std::string& text : texts) environment.push_back(text.data());
    environment.push_back(nullptr);
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t process = 0;
    if (const int error =
            ::posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environment.data());
        error != 0)
        throw FaultError(
            fmt::format("{}: cannot be run: {}", command[0], std::generic_category().message(error)));
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw FaultError(WIFEXITED(status)
                             ? fmt::format("{}: ended with exit code {}", command[0], WEXITSTATUS(status))
                             : fmt::format("{}: was ended by signal {}", command[0], WTERMSIG(status)));
    }
}

}  // namespace

void tell_end(const EndNotice& notice, const std::string& host, const HostStatus& status) {
    const char* state = state_word(status.state);
    if (!notice.command.empty())
        run_command(notice.command, {"LAMELLA_HOST=" + host, "LAMELLA_FILE=" + status.file,
                                     std::string("LAMELLA_STATE=") + state});
    if (!notice.webhook.empty()) {
        HttpConnection connection({.name = "webhook", .url = notice.webhook});
        const nlohmann::ordered_json text{{"host", host}, {"file", status.file}, {"state", state}};
        connection.ask({.method = "POST",
                        .path = "",
                        .headers = {"Content-Type: application/json"},
                        .content = text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)});
    }
}

}  // namespace lamella
