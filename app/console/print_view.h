// PrintView: the state of a print over a serial line, on standard error, and the keys that control it.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "printers/serial/print_link.h"

namespace lamella {

/// Redraws a line on a terminal, or writes one at intervals otherwise, on its own thread. While it lives and
/// standard input is a terminal, p pauses, r resumes, s stops and x halts the print, and 1 to 9 press a
/// button of a prompt from the printer.
class PrintView {
  public:
    /// `last_layer` is the number of layers, 0 when it is not known.
    PrintView(std::shared_ptr<PrintLink> link, int last_layer, bool quiet);
    ~PrintView() { close(); }
    PrintView(const PrintView&) = delete;
    PrintView& operator=(const PrintView&) = delete;

    /// Prints a message above the line.
    void show_message(const std::string& text);
    /// Ends the line, and restores the terminal's keyboard mode.
    void close();

  private:
    void work();
    void show(const LinkStatus& status);
    void greet(const LinkStatus& status);
    void tell_trouble(const LinkStatus& status);
    void write_line(const std::string& text);
    void read_keys();

    std::shared_ptr<PrintLink> link_;
    int last_layer_;
    bool quiet_;
    bool terminal_;
    bool keys_;
    bool line_open_ = false;
    bool greeted_ = false;
    std::string told_wait_, told_trouble_;
    double last_line_ = -100;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool ending_ = false;
    std::thread thread_;
};

/// Returns "layer 12/80  4711 lines  Z 2.4  nozzle 209.8/210  bed 60.1/60  8 layers ready  3 % starved".
std::string status_text(const LinkStatus& status, int last_layer);

/// Returns what the printer waits for and which keys answer it; empty while it does not wait.
std::string wait_text(const LinkStatus& status);

/// Returns the statistics of a print: lines/s, longest gap, resends, timeouts, starvation.
std::string summary_text(const LinkStatus& status);

}  // namespace lamella
