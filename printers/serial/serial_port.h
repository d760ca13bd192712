// SerialPort: a tty of Linux, opened for a printer.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// What a read or a write came to.
struct PortOutcome {
    std::size_t bytes = 0;
    bool lost = false;  ///< the device is gone
};

/// Raw, exclusive, never blocking. Closing leaves DTR alone, so that the board behind it is not reset.
class SerialPort {
  public:
    SerialPort() = default;
    SerialPort(SerialPort&& other) noexcept;
    SerialPort& operator=(SerialPort&& other) noexcept;
    ~SerialPort();

    /// Throws InputError for what is no serial port or is not free, FaultError for what fails otherwise.
    static SerialPort open(const std::string& path, int baud);

    int descriptor() const { return descriptor_; }
    bool is_open() const { return descriptor_ >= 0; }
    /// Appends what has arrived.
    PortOutcome read(std::string& bytes);
    /// Writes as much as there is room for.
    PortOutcome write(std::string_view bytes);
    /// Pulls DTR for a moment, which resets most boards. False where the port has no such line.
    bool reset_board();
    void close();

  private:
    explicit SerialPort(int descriptor) : descriptor_(descriptor) {}
    int descriptor_ = -1;
};

/// The name of a port that stays the same when the device is plugged in again: its link in
/// /dev/serial/by-id, or the path itself.
std::string lasting_name(const std::string& path);

struct PortInfo {
    std::string path;         ///< /dev/ttyUSB0
    std::string by_id;        ///< its lasting name; empty when there is none
    std::string description;  ///< maker and product, as the device tells
};

/// The serial ports of this computer: USB and the built-in ones that exist.
std::vector<PortInfo> serial_ports();

}  // namespace lamella
