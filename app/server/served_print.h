// ServedPrint: a job that is printed while its later layers are computed.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "app/http/event_hub.h"
#include "app/jobs/served_job.h"
#include "app/server/print_messages.h"
#include "app/server/print_request.h"
#include "engine/base/cancel_token.h"

namespace lamella {

/// A print, from its start until its object goes. Requests may come from any thread. Tells all listeners its
/// state as event `print`, twice a second at most, and its messages as `print_message`.
class ServedPrint {
  public:
    ServedPrint(int number, std::shared_ptr<const ServedJob> job, PrintRequest request, int threads,
                EventHub& events);
    /// Stops the print unless it has ended, and waits until its heaters are off.
    ~ServedPrint();
    ServedPrint(const ServedPrint&) = delete;
    ServedPrint& operator=(const ServedPrint&) = delete;

    bool has_ended() const;
    void pause() { link_->pause(); }
    /// Ends a pause, or tells a printer that waits for a person to go on.
    void resume() { link_->resume(); }
    /// Presses a button of the printer's prompt, by index.
    void choose(std::size_t button) { link_->choose(button); }
    /// Ends the print after the moves that the printer has got: nozzle parked, heaters and motors off.
    void stop();
    /// Halts the machine in the middle of its moves (see PrintLink::halt).
    void halt();

    /// State, layers, lines, temperatures and times.
    nlohmann::ordered_json describe() const;
    nlohmann::ordered_json messages() const { return messages_.json(); }
    /// Waits for the end.
    void wait() const;

  private:
    enum class End : unsigned char { none, done, stopped, failed };
    struct Ending {
        End end;
        std::string message;
    };
    /// Lines and bytes a second, from one look to the next.
    struct Rates {
        double at = 0, lines_a_second = 0, bytes_a_second = 0;
        std::int64_t lines = 0, bytes = 0;
        void measure(const LinkStatus& status);
    };

    void print();
    void produce();
    void note_end(const std::exception_ptr& failure);
    static Ending ending_of(const std::exception_ptr& failure);
    void watch();
    const char* state_name(const LinkStatus& status, End end) const;

    int number_;
    std::shared_ptr<const ServedJob> job_;
    PrintRequest request_;
    int threads_;
    EventHub& events_;
    PrintMessages messages_;
    std::shared_ptr<PrintLink> link_;
    CancelToken cancel_;  // of the layers
    std::atomic<bool> stopping_{false};
    mutable std::mutex mutex_;  // guards what follows
    mutable std::condition_variable ended_;
    Ending printed_{End::none, ""};  // as the printing thread left it
    End end_ = End::none;            // as pages see it: all messages are there
    std::string message_;
    Rates rates_;
    std::thread printing_, watching_;
};

}  // namespace lamella
