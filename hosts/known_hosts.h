// The user's hosts: names, addresses and keys, in a file that only the user may read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hosts/network_host.h"

namespace lamella {

/// A host as the user named it.
struct KnownHost {
    std::string named;  ///< by which find_host found it
    const HostKind* kind = nullptr;
    HostAccess access;
    std::string storage;            ///< where files go; the kind's default unless given
    std::vector<std::string> done;  ///< command that is run when a print has ended; empty: none
    std::string webhook;            ///< address that is told when a print has ended; empty: none

    std::unique_ptr<NetworkHost> connect(const CancelToken* cancel) const {
        return kind->make(access, storage, cancel);
    }
};

/// Returns the path of the user's file of hosts, hosts.toml in user_config_folder(); empty when none is
/// known.
std::string hosts_file();

/// Reads a file of hosts: a table for each, with kind, url, and key, key_env, user, certificate, storage,
/// done, webhook if wanted. Returns none for a file that does not exist. Throws InputError, with file and
/// line, for mistakes, and for a file with keys that others may read.
std::vector<KnownHost> read_hosts(const std::string& path);

/// Returns the host of this name in the user's file; nothing for others. Throws as read_hosts().
std::optional<KnownHost> known_host(const std::string& name);

/// Returns the host that `named` stands for: a name in the user's file, or KIND+URL, such as
/// moonraker+http://voron.local. The key of the environment, LAMELLA_HOST_KEY, goes before that of the file.
/// Throws InputError for an unknown name, with the nearest known one.
KnownHost find_host(const std::string& named);

}  // namespace lamella
