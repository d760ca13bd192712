// NetworkHost: a printer on the network, behind one interface whatever it speaks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hosts/transfer/http_connection.h"
#include "hosts/transfer/upload_source.h"

namespace lamella {

/// What a host says of itself.
struct HostFacts {
    std::string software;                       ///< name and version
    std::string machine;                        ///< the printer's own name or model; may be empty
    std::optional<std::uint64_t> free_bytes{};  ///< room for files
    std::string formats{};  ///< endings of files that it takes, with spaces between; empty: unknown
};

/// A file that a host has.
struct HostFile {
    std::optional<std::uint64_t> size{};  ///< bytes; nothing: the host does not tell
    std::string hash{};  ///< hexadecimal digits of MD5, SHA-1 or SHA-256; empty: the host does not tell
};

enum class PrintState : unsigned char {
    offline,  ///< the host runs, and its printer does not
    idle,     ///< ready for a print
    busy,     ///< neither printing nor ready: homing, heating, waiting for a person
    printing,
    paused,
    finished,   ///< the last print ended well; ready for another
    cancelled,  ///< the last print was cancelled; ready for another
    failed      ///< the last print or the machine failed
};

/// A heater: temperatures, degrees Celsius.
struct HostHeater {
    std::string name;
    double now = 0, target = 0;
};

struct HostStatus {
    PrintState state = PrintState::idle;
    std::string file;                         ///< that is printed, or was printed last; may be empty
    std::optional<double> progress{};         ///< 0 to 1
    std::optional<double> elapsed{}, left{};  ///< s
    std::optional<int> layer{}, layers{};     ///< current layer, counted from 1; layers of the job
    std::vector<HostHeater> heaters{};
    std::string message;  ///< the machine's own words; may be empty
};

/// What a host asks to know before the first byte of a file.
enum class UploadNeeds : unsigned char { nothing, size, size_and_hash };

/// A printer on the network. Every request throws HostError when it fails, InputError when a key or a
/// certificate is not accepted, and Interrupted. Used by one thread.
class NetworkHost {
  public:
    NetworkHost() = default;
    virtual ~NetworkHost() = default;
    NetworkHost(const NetworkHost&) = delete;
    NetworkHost& operator=(const NetworkHost&) = delete;

    virtual HostFacts facts() = 0;
    virtual UploadNeeds needs() const = 0;
    /// Returns the file of this name if the host has it whole.
    virtual std::optional<HostFile> find(const std::string& name) = 0;
    /// Uploads a file, replacing one of its name, and returns what was sent when the host says that it has
    /// it. `on_sent` is called with the bytes sent so far.
    virtual UploadFacts upload(const std::string& name, UploadSource& source,
                               const std::function<void(std::uint64_t)>& on_sent) = 0;
    /// Asks the host to print a file that it has.
    virtual void start(const std::string& name) = 0;
    virtual HostStatus status() = 0;
    virtual void pause() = 0;
    virtual void resume() = 0;
    virtual void cancel() = 0;
    /// Returns whether everything that is sent can be read on the way.
    virtual bool is_plain() const = 0;
};

/// A kind of host, as the user names it.
struct HostKind {
    const char* name;
    const char* description;  ///< one line
    std::unique_ptr<NetworkHost> (*make)(const HostAccess& access, const std::string& storage,
                                         const CancelToken* cancel);
    const char* default_storage = "";  ///< where files go unless the user says otherwise
    const char* default_user = "";  ///< whose password the key is, where the user says no other; empty: none
};

std::span<const HostKind> host_kinds();
/// Returns the kind of this name. Throws InputError, with `where` at the front, for an unknown one.
const HostKind& find_host_kind(std::string_view name, const std::string& where);

/// Returns a state in one word, as it is shown and written to JSON.
const char* state_word(PrintState state);
/// Returns true while a print is under way.
bool is_active(PrintState state);

}  // namespace lamella
