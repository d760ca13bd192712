// `lamella hosts`: the printers on the network that are known, and what they say of themselves.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/interrupt.h"
#include "app/console/text_output.h"
#include "engine/base/error.h"
#include "engine/base/text.h"
#include "hosts/find_hosts.h"
#include "hosts/known_hosts.h"
#include "hosts/watch_print.h"

namespace lamella {

namespace {

struct HostsOptions {
    std::string host;
    std::optional<std::string> find;  ///< address to be asked; empty: the local network
    bool json = false;
};

void write(const std::string& text) {
    TextOutput out("");
    out.write(text);
    out.close();
}

void list_hosts(const HostsOptions& options) {
    const std::vector<KnownHost> hosts = read_hosts(hosts_file());
    if (options.json) {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const KnownHost& host : hosts)
            list.push_back({{"name", host.access.name}, {"kind", host.kind->name}, {"url", host.access.url}});
        return write(list.dump(2) + "\n");
    }
    std::string text;
    for (const KnownHost& host : hosts)
        text += fmt::format("{}  {}  {}\n", host.access.name, host.kind->name, host.access.url);
    if (hosts.empty()) text = "no host is known; " + hosts_file() + " would name them\n";
    text += "\nkinds:\n";
    for (const HostKind& kind : host_kinds())
        text += fmt::format("  {:10}  {}\n", kind.name, kind.description);
    write(text);
}

void search_hosts(const HostsOptions& options) {
    constexpr double seconds = 2;
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const HostSearch search = find_hosts(*options.find, seconds, &cancel);
    if (!search.trouble.empty()) std::fputs((search.trouble + "\n").c_str(), stderr);
    if (options.json) {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const FoundHost& host : search.hosts)
            list.push_back({{"host", host.named}, {"about", host.about}});
        return write(list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    }
    std::string text;
    for (const FoundHost& host : search.hosts) text += host.named + "  " + host.about + "\n";
    write(text.empty() ? "no printer has answered\n" : text);
}

void test_host(const HostsOptions& options) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const KnownHost known = find_host(options.host);
    const auto host = known.connect(&cancel);
    const HostFacts facts = host->facts();
    const HostStatus status = host->status();
    if (options.json) {
        nlohmann::ordered_json json{{"host", known.access.name},
                                    {"kind", known.kind->name},
                                    {"software", facts.software},
                                    {"machine", facts.machine},
                                    {"encrypted", !host->is_plain()}};
        if (facts.free_bytes) json["free_bytes"] = *facts.free_bytes;
        if (!facts.formats.empty()) json["formats"] = facts.formats;
        json["status"] = status_json(status);
        return write(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    }
    std::string text = fmt::format("{}: {}", known.access.name, facts.software);
    if (!facts.machine.empty()) text += ", " + facts.machine;
    text += host->is_plain() ? "; nothing is encrypted on the way there\n" : "\n";
    if (facts.free_bytes) text += fmt::format("free: {} MiB\n", grouped(*facts.free_bytes >> 20));
    if (!facts.formats.empty()) text += "takes: " + facts.formats + "\n";
    write(text + status_text(status) + "\n");
}

}  // namespace

void add_hosts_command(CLI::App& root) {
    auto options = std::make_shared<HostsOptions>();
    CLI::App& command = *root.add_subcommand("hosts", "List printers on the network, or test the way to one");
    command.add_option(
        "HOST", options->host,
        "Host to be tested: a name in hosts.toml, or KIND+URL; default: list those in hosts.toml");
    command
        .add_option(
            "--find", options->find,
            "Ask the local network for printers, by mDNS and by SDCP's broadcast; or the machine at ADDRESS, "
            "by SDCP")
        ->type_name("[ADDRESS]")
        ->expected(0, 1)
        ->default_str("");
    command.add_flag("--json", options->json, "Write JSON");
    finish_command(
        command,
        "  lamella hosts\n"
        "  lamella hosts --find\n"
        "  lamella hosts voron\n"
        "  lamella hosts moonraker+http://192.168.1.20\n"
        "~/.config/lamella/hosts.toml has a table for each host; it holds keys, so nobody else may read\n"
        "it (chmod 600):\n"
        "  [voron]\n"
        "  kind = \"moonraker\"\n"
        "  url = \"http://voron.local\"\n"
        "  key = \"...\"                  # or key_env = \"VORON_KEY\"; none where none is asked for\n"
        "  certificate = \"voron.pem\"    # to be trusted, where the host has made its own\n"
        "  done = [\"notify-send\", \"The print has ended\"]\n"
        "  webhook = \"https://example.org/print-ended\"");
    command.callback([options] {
        if (options->find) return search_hosts(*options);
        options->host.empty() ? list_hosts(*options) : test_host(*options);
    });
}

}  // namespace lamella
