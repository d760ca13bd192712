// Sends a file to a host and starts it: once, and only when the host has it whole.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "hosts/network_host.h"

namespace lamella {

/// How often and how long something is tried again.
struct RetryPolicy {
    int attempts = 5;       ///< tries of each request in all
    double first_wait = 1;  ///< before the second try, s; doubled for each further one
    double confirm = 20;    ///< time within which a start shows in the host's status, s
};

struct SendSettings {
    std::string name;    ///< of the file at the host
    bool start = false;  ///< prints it
    bool again = false;  ///< uploads it even if the host has a file of this name
    RetryPolicy retry{};
    const CancelToken* cancel = nullptr;
    /// Called with what a person should know: retries, what was found. May be empty.
    std::function<void(const std::string& text)> on_note{};
    /// Called with the bytes sent by the present try, and with those of the whole file where they are known
    /// before. May be empty.
    std::function<void(std::uint64_t bytes, std::optional<std::uint64_t> of)> on_sent{};
};

struct SendReport {
    std::uint64_t size = 0;  ///< of the file at the host, bytes
    bool uploaded = false;   ///< false: the host had it
    int attempts = 0;        ///< tries of the upload
    bool started = false;    ///< by this call
    bool prints = false;     ///< the host prints it: started by this call or before
};

/// Asks the host what it is, before work begins whose result it would refuse; tells if it prints although a
/// print is to be started. Throws as send_upload.
HostFacts greet_host(NetworkHost& host, const SendSettings& settings);

/// Uploads `source` unless the host has it already, or no room, or takes no such files; asks the host whether
/// it has all of it, and starts it if asked. An upload that breaks is repeated from its beginning. A start is
/// never repeated unless the host has said that it did not happen: where its answer is lost, the host's
/// status decides. Throws InputError for a file that the host cannot take and when it prints another,
/// HostError, FaultError and Interrupted.
SendReport send_upload(NetworkHost& host, UploadSource& source, const SendSettings& settings);

/// Returns a name that every host takes: letters, digits, '.', '-' and '_', `stem` shortened, the first
/// digits of `hash` (hexadecimal) so that other content has another name, and the ending.
std::string upload_name(const std::string& stem, const std::string& hash, const std::string& ending);

}  // namespace lamella
