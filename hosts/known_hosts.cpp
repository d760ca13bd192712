// Reads hosts.toml. Messages never hold a value of `key`.
#include "hosts/known_hosts.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "engine/base/user_config.h"
#include "engine/base/whole_file.h"
#include "recipe/settings.h"
#include "recipe/toml_value.h"

namespace lamella {

namespace {

constexpr const char* accepted_keys = "kind, url, key, key_env, user, certificate, storage, done, webhook";

std::string environment(const std::string& name) {
    const char* value = std::getenv(name.c_str());  // NOLINT(concurrency-mt-unsafe): nothing sets it
    return value != nullptr ? value : "";
}

bool is_web_address(std::string_view url) {
    return url.starts_with("http://") || url.starts_with("https://");
}

/// Throws InputError for an address that is none, or that holds a secret.
void check_address(const std::string& url, const std::string& where) {
    const std::size_t host = url.find("://") + 3;
    const bool is_plain_text = std::ranges::all_of(url, [](unsigned char c) { return c > ' ' && c < 127; });
    if (!is_web_address(url) || url.size() <= host || url[host] == '/' || !is_plain_text)
        throw InputError(where +
                         ": is no address; accepted: http://HOST or https://HOST, with :PORT or without");
    if (url.substr(host, url.find('/', host) - host).find('@') != std::string::npos)
        throw InputError(where + ": holds a name or password; accepted: `user` and `key` in hosts.toml");
}

/// Paths of requests begin with a slash.
std::string without_slash(std::string url) {
    while (url.ends_with('/')) url.pop_back();
    return url;
}

/// Reads one table of the file.
class HostReader {
  public:
    HostReader(const std::string& path, const toml::table& table) : path_(path), table_(table) {}

    KnownHost read(const std::string& name) {
        KnownHost host;
        host.access.name = name;
        const std::string kind = text("kind");
        if (kind.empty())
            throw mistake(table_, name + ": has no `kind`; accepted: such as kind = \"moonraker\"");
        host.kind = &find_host_kind(kind, where(*table_.get("kind")) + "kind");
        host.access.url = text("url");
        if (host.access.url.empty())
            throw mistake(table_, name + ": has no `url`; accepted: such as url = \"http://voron.local\"");
        check_address(host.access.url, where(*table_.get("url")) + "url");
        host.access.url = without_slash(host.access.url);
        host.access.user = table_.contains("user") ? text("user") : host.kind->default_user;
        host.access.key = text("key");
        if (const std::string variable = text("key_env"); !variable.empty()) {
            host.access.key = environment(variable);
            if (host.access.key.empty())
                throw mistake(*table_.get("key_env"),
                              "key_env: the environment has no " + variable +
                                  "; accepted: the name of a variable that holds the key");
        }
        host.access.certificate_file = text("certificate");
        host.storage = table_.contains("storage") ? text("storage") : host.kind->default_storage;
        host.webhook = text("webhook");
        if (!host.webhook.empty()) check_address(host.webhook, where(*table_.get("webhook")) + "webhook");
        host.done = words("done");
        for (const auto& [key, value] : table_) {
            if (used_.find(" " + std::string(key.str()) + " ") == std::string::npos)
                throw mistake(value, fmt::format("`{}` is unknown; accepted: {}", key.str(), accepted_keys));
        }
        return host;
    }

  private:
    std::string where(const toml::node& node) const {
        return fmt::format("{}:{}: ", path_, node.source().begin.line);
    }
    InputError mistake(const toml::node& node, const std::string& text) const {
        return InputError(where(node) + text);
    }

    std::string text(const std::string& key) {
        used_ += key + " ";
        const toml::node* node = table_.get(key);
        if (node == nullptr) return "";
        const auto value = node->value<std::string>();
        if (!node->is_string() || !value || value->find('\n') != std::string::npos ||
            value->find('\r') != std::string::npos)
            throw mistake(*node, key + ": must be a text of one line between quotes");
        return *value;
    }

    std::vector<std::string> words(const std::string& key) {
        used_ += key + " ";
        std::vector<std::string> list;
        const toml::node* node = table_.get(key);
        if (node == nullptr) return list;
        const toml::array* array = node->as_array();
        if (array == nullptr || array->empty())
            throw mistake(*node,
                          key + ": must be a program and its arguments, such as [\"notify-send\", \"done\"]");
        for (const toml::node& each : *array) {
            const auto value = each.value<std::string>();
            if (!each.is_string() || !value) throw mistake(each, key + ": every argument must be a text");
            list.push_back(*value);
        }
        return list;
    }

    const std::string& path_;
    const toml::table& table_;
    std::string used_ = " ";
};

/// Throws InputError for a file with keys that others may read.
void check_rights(const std::string& path, const std::vector<KnownHost>& hosts) {
    const bool holds_keys =
        std::ranges::any_of(hosts, [](const KnownHost& host) { return !host.access.key.empty(); });
    struct stat status {};
    if (!holds_keys || ::stat(path.c_str(), &status) != 0) return;
    if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
        throw InputError(fmt::format(
            "{}: others may read it, and it holds keys; accepted: a file of your own: chmod 600 {}", path,
            path));
    }
}

/// Returns the host of KIND+URL; nothing for a name.
std::optional<KnownHost> host_of_address(const std::string& named) {
    const std::size_t plus = named.find('+');
    if (plus == std::string::npos || !is_web_address(std::string_view(named).substr(plus + 1)))
        return std::nullopt;
    KnownHost host;
    host.kind = &find_host_kind(named.substr(0, plus), "--host");
    host.access.url = without_slash(named.substr(plus + 1));
    check_address(host.access.url, "--host");
    host.access.name = host.access.url.substr(host.access.url.find("://") + 3);
    host.access.user = host.kind->default_user;
    host.storage = host.kind->default_storage;
    return host;
}

}  // namespace

std::string hosts_file() {
    const std::string folder = user_config_folder();
    return folder.empty() ? "" : folder + "/hosts.toml";
}

std::vector<KnownHost> read_hosts(const std::string& path) {
    std::error_code error;
    if (path.empty() || !std::filesystem::exists(path, error)) return {};
    const toml::table all = parse_toml(whole_file(path, "a file of hosts"), path);
    std::vector<KnownHost> hosts;
    for (const auto& [key, value] : all) {
        if (!value.is_table())
            throw InputError(
                fmt::format("{}:{}: `{}` must be a table; accepted: [voron] with kind and url below it", path,
                            value.source().begin.line, key.str()));
        hosts.push_back(HostReader(path, *value.as_table()).read(std::string(key.str())));
    }
    check_rights(path, hosts);
    return hosts;
}

std::optional<KnownHost> known_host(const std::string& name) {
    for (const KnownHost& host : read_hosts(hosts_file())) {
        if (host.access.name == name) return host;
    }
    return std::nullopt;
}

KnownHost find_host(const std::string& named) {
    std::optional<KnownHost> host = host_of_address(named);
    if (!host) host = known_host(named);
    if (!host) {
        std::vector<std::string> names;
        for (const KnownHost& other : read_hosts(hosts_file())) names.push_back(other.access.name);
        const std::string near = nearest(named, names);
        throw InputError(fmt::format(
            "host \"{}\" is unknown{}; accepted: a name in {}, or an address with its kind, such as "
            "moonraker+http://voron.local",
            named.substr(0, 64), near.empty() ? "" : fmt::format(", did you mean `{}`?", near),
            hosts_file()));
    }
    host->named = named;
    if (const std::string key = environment("LAMELLA_HOST_KEY"); !key.empty()) host->access.key = key;
    return *host;
}

}  // namespace lamella
