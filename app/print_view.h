// PrintView: how a print over a serial line stands, on standard error, and the keys that pause it.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "printers/serial/print_link.h"

namespace lamella {

/// Redraws a line on a terminal, writes one now and then elsewhere, on a thread of its own. While it lives
/// and standard input is a terminal, p pauses, r resumes and s stops the print.
class PrintView {
  public:
    /// `last_layer` is the number of layers, 0 when it is not known.
    PrintView(std::shared_ptr<PrintLink> link, int last_layer, bool quiet);
    ~PrintView();
    PrintView(const PrintView&) = delete;
    PrintView& operator=(const PrintView&) = delete;

  private:
    void work();
    void show(const LinkStatus& status);
    void read_keys();

    std::shared_ptr<PrintLink> link_;
    int last_layer_;
    bool quiet_;
    bool terminal_;
    bool keys_;
    bool line_open_ = false;
    bool told_ = false;
    double last_line_ = -100;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool ending_ = false;
    std::thread thread_;
};

/// "layer 12/80  4711 lines  Z 2.4  nozzle 209.8/210  bed 60.1/60  8 layers ready  3 % starved".
std::string status_text(const LinkStatus& status, int last_layer);

/// What a print came to: lines/s, longest gap, resends, timeouts, starvation.
std::string summary_text(const LinkStatus& status);

}  // namespace lamella
