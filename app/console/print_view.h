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
/// standard input is a terminal with the process in its foreground, p pauses, r resumes, s stops and x halts
/// the print, and 1 to 9 press a button of a prompt from the printer. Says nothing more once the terminal is
/// gone (see TerminalGuard).
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
    void watch_signals();
    void tell_trouble(const LinkStatus& status);
    void tell_once(const std::string& text, std::string& told);
    void write_line(const std::string& text);
    void read_keys();

    std::shared_ptr<PrintLink> link_;
    int last_layer_;
    bool quiet_;
    bool terminal_;
    bool keys_;          ///< keys are read
    bool gone_ = false;  ///< the terminal is gone
    bool line_open_ = false;
    bool greeted_ = false;
    std::string told_wait_, told_journal_, told_log_, told_awaiting_;
    int told_notices_ = 0;
    double last_line_ = -100;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace lamella
