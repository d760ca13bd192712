// MachinePort: an open connection to a machine; serial lines of this computer.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// Result of a read or a write.
struct PortOutcome {
    std::size_t bytes = 0;
    bool lost = false;  ///< the device is gone
};

/// An open connection to a machine, exclusive and non-blocking. Closing a serial line does not touch DTR, so
/// that the board is not reset.
class MachinePort {
  public:
    MachinePort() = default;
    MachinePort(MachinePort&& other) noexcept;
    MachinePort& operator=(MachinePort&& other) noexcept;
    ~MachinePort();

    /// Opens a tty in raw mode. Throws InputError if the path is not a serial line or is in use, FaultError
    /// for any other failure.
    static MachinePort open_serial(const std::string& path, int baud);
    /// Connects to the API socket of klippy. Throws InputError if the path is no socket, if nobody listens
    /// there, if this user may not, or if another print uses it, FaultError for any other failure.
    static MachinePort open_socket(const std::string& path);

    int descriptor() const { return descriptor_; }
    bool is_open() const { return descriptor_ >= 0; }
    /// Appends the bytes that have arrived.
    PortOutcome read(std::string& bytes);
    /// Writes as many bytes as the buffer takes.
    PortOutcome write(std::string_view bytes);
    /// Pulses DTR, which resets most boards. Returns false if the port has no DTR line.
    bool reset_board();
    void close();

  private:
    explicit MachinePort(int descriptor, int claim = -1) : descriptor_(descriptor), claim_(claim) {}
    int descriptor_ = -1;
    int claim_ = -1;  // of a socket: its name tells other prints that the machine is in use
};

/// Returns true if a path leads to a serial line or a pseudo-terminal below /dev. Opens nothing, because some
/// devices act when they are opened. The console and the terminal of this process are none.
bool is_serial_line(const std::string& path);

/// Returns a port name that survives replugging: the device's link in /dev/serial/by-id, or the path itself.
std::string lasting_name(const std::string& path);

struct PortInfo {
    std::string path;         ///< /dev/ttyUSB0
    std::string by_id;        ///< its lasting name; empty if there is none
    std::string description;  ///< manufacturer and product, as reported by the device
};

/// Returns the serial ports of this computer: USB ports and the built-in ones that exist.
std::vector<PortInfo> serial_ports();

}  // namespace lamella
