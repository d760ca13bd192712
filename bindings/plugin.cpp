// Loads plugins; closes their back-ends when these are destroyed.
#include "bindings/plugin.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "bindings/context.h"
#include "bindings/host_backend.h"

namespace lamella {
namespace {

/// A plugin's library and the description that it filled in.
class Plugin {
  public:
    explicit Plugin(const std::string& path) : path_(path) {
        // The loader would search the system's folders for a name without a slash.
        const std::string full = std::filesystem::absolute(path).string();
        library_ = dlopen(full.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (library_ == nullptr) throw InputError(fmt::format("--plugin {}: {}", path, dlerror()));
        const auto entry = reinterpret_cast<lamella_plugin_entry_function>(
            dlsym(library_, "lamella_plugin_entry"));  // NOLINT
        if (entry == nullptr) refuse("is no plugin; accepted: a library that exports lamella_plugin_entry");
        told_.struct_size = sizeof told_;
        if (const std::int32_t status = entry(LAMELLA_ABI_VERSION, &told_); status != LAMELLA_OK) {
            refuse(
                fmt::format("will not be loaded (status {}); accepted: a plugin for version {} of the "
                            "interface",
                            status, LAMELLA_ABI_VERSION));
        }
        if (told_.open == nullptr) refuse("opens nothing: `open` is a null pointer");
        if (!fits_as_name(told_.name)) refuse("has no name; accepted: letters, digits, - and _");
    }
    ~Plugin() {
        if (library_ != nullptr) dlclose(library_);
    }
    Plugin(const Plugin&) = delete;
    Plugin& operator=(const Plugin&) = delete;

    const lamella_plugin& told() const { return told_; }

    lamella_backend open(const PrinterProfile& profile, const std::string& output, bool force) const {
        lamella_printer printer{};
        printer.struct_size = sizeof printer;
        printer.name = profile.name.c_str();
        printer.columns = profile.image.width;
        printer.rows = profile.image.height;
        printer.pixel_x = profile.image.pixel_x;
        printer.pixel_y = profile.image.pixel_y;
        printer.tolerance = profile.vector.tolerance;
        std::array<char, 1024> message{};
        lamella_backend backend{};
        backend.struct_size = sizeof backend;
        const std::int32_t status = told_.open(&printer, output.c_str(), force ? LAMELLA_FORCE : 0, &backend,
                                               message.data(), message.size());
        message.back() = '\0';
        if (status == LAMELLA_OK && (backend.render == nullptr || backend.write == nullptr))
            throw FaultError(path_ + ": its back-end has no render or no write");
        if (status == LAMELLA_OK) return backend;
        const std::string what =
            message.front() ? message.data() : fmt::format("fails with status {}", status);
        if (status == LAMELLA_BAD_INPUT) throw InputError(output + ": " + what);
        throw FaultError(output + ": " + what);
    }

  private:
    static bool fits_as_name(const char* name) {
        const std::string text = name ? name : "";
        return !text.empty() && std::ranges::all_of(text, [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                   c == '_';
        });
    }
    [[noreturn]] void refuse(const std::string& what) {
        dlclose(library_);
        library_ = nullptr;
        throw InputError(fmt::format("--plugin {}: {}", path_, what));
    }

    std::string path_;
    void* library_ = nullptr;
    lamella_plugin told_{};
};

/// Owns a back-end that a plugin opened, and closes it.
struct OpenBackend {
    OpenBackend(std::shared_ptr<const Plugin> from, const PrinterProfile& profile, const std::string& path,
                bool force)
        : plugin(std::move(from)), callbacks(plugin->open(profile, path, force)) {}
    ~OpenBackend() {
        if (plugin->told().close != nullptr) plugin->told().close(&callbacks);
    }
    OpenBackend(const OpenBackend&) = delete;
    OpenBackend& operator=(const OpenBackend&) = delete;

    std::shared_ptr<const Plugin> plugin;
    lamella_backend callbacks;
};

class PluginBackend : public Backend {
  public:
    PluginBackend(std::shared_ptr<const Plugin> plugin, const PrinterProfile& profile,
                  const std::string& path, bool force)
        : open_(std::move(plugin), profile, path, force), host_(open_.callbacks, force ? LAMELLA_FORCE : 0) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        return host_.open(job, range, resume);
    }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override { return host_.render(layer); }
    void write(const Layer& layer, LayerProduct& product) override { host_.write(layer, product); }
    void finish() override { host_.finish(); }

  private:
    OpenBackend open_;
    HostBackend host_;
};

}  // namespace

OutsideBackend load_plugin(const std::string& path) {
    const auto plugin = std::make_shared<const Plugin>(path);
    const lamella_plugin& told = plugin->told();
    return {told.name, told.ending ? told.ending : "",
            [plugin](const PrinterProfile& profile, const std::string& output, bool force) {
                return std::make_unique<PluginBackend>(plugin, profile, output, force);
            }};
}

}  // namespace lamella
