// PrintLink: a print over a port: a thread that owns the port and the sender, and a queue of layers.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "engine/layers/layer_stream.h"
#include "printers/serial/line_log.h"
#include "printers/serial/line_sender.h"
#include "printers/serial/print_chunk.h"
#include "printers/serial/print_journal.h"
#include "printers/serial/print_progress.h"
#include "printers/serial/serial_port.h"

namespace lamella {

struct LinkSettings {
    std::string port;
    int baud = 250000;
    bool reset_board = false;  ///< reset the board by DTR before anything is sent
    Dialect dialect = Dialect::marlin;
    SenderSettings sender;
    std::string log;                ///< file that logs every line; empty: none
    std::string journal;            ///< path of the journal; empty: none
    double park_x = 0, park_y = 0;  ///< parking position of the nozzle, off the part, mm
    double highest = 250;           ///< greatest height of the nozzle, mm
    MotionLimits motion{};          ///< by which the time of a job is estimated
    std::size_t layers_ahead = 8;   ///< most layers in the queue
    std::size_t bytes_ahead = 64u << 20;
    double park_after = 0.5;    ///< time without a layer after which the nozzle is parked, s
    double reconnect_for = 60;  ///< time during which a lost port is tried again, s
    const CancelToken* cancel = nullptr;
    /// Called by the link's thread with what the printer tells people; must not block.
    std::function<void(const std::string& text)> on_message{};
};

/// Lines that belong together, usually a layer. Sending starts only when all of them are there.
struct PrintChunk {
    std::string lines;                ///< clean lines, each with a line end
    std::int64_t count = 0;           ///< number of lines
    int layer = -1;                   ///< layer index; -1: before the first layer
    nlohmann::ordered_json resume{};  ///< what the journal records once the lines are answered
    std::vector<LineFacts> facts{};   ///< of each line; empty: nothing is known of them
};

/// What is known of a job before its first line is sent.
struct JobOutlook {
    int layers = 0;                                           ///< layers of the job, or parts of a ready file
    int layers_before = 0;                                    ///< of those: done in earlier runs
    std::optional<double> seconds_before{}, seconds_ahead{};  ///< see PrintProgress
    bool source_lines = false;                                ///< LineFacts::source are lines of a ready file
};

/// Status of a print.
struct LinkStatus {
    std::string firmware;
    bool emergency_parser = false;
    bool connected = false;
    bool paused = false;
    bool parked = false;
    bool stopping = false;            ///< the print is being ended
    std::optional<UserWait> waits{};  ///< request to a person that the printer is waiting for
    std::string journal_trouble;      ///< why the journal cannot be written; empty if it can
    std::string log_trouble;          ///< why the log is not complete; empty if it is
    std::string awaiting;             ///< what is waited for before the printer is known
    std::string notice;               ///< what became of the last request, if it was not followed
    bool resumable = false;           ///< the journal holds a state from which this print can be resumed
    int notices = 0;                  ///< number of notices so far
    Dialect dialect{};
    std::size_t bytes_ahead = 0;  ///< most bytes unanswered; 0: one line at a time
    bool knows_height = false;    ///< the machine knows the height of its nozzle
    bool takes_height = true;     ///< the machine can be told that height
    bool lost = false;            ///< the port is lost at the moment
    int losses = 0;               ///< times the port was lost
    double lost_seconds = 0;      ///< time without a port
    LineWait line_wait{};         ///< what the oldest unanswered line waits for
    int layer = -1;               ///< layer whose lines are being answered
    std::int64_t lines_queued = 0, lines_answered = 0;
    std::size_t layers_ready = 0;
    double z = 0;
    Temperatures temperatures;
    SenderStatistics statistics;
    PrintProgress progress;
    int underruns = 0;  ///< times the printer ran out of lines because no layer was ready
    double underrun_seconds = 0;
    double seconds = 0;  ///< time since the printer was connected
};

/// A print over a serial port, or over Klipper's socket. A thread of its own owns the port. `status` and the
/// requests `pause`, `resume`, `choose`, `stop` and `halt` may be called from any thread.
///
///     LinkSettings settings;
///     settings.port = "/dev/ttyACM0";
///     PrintLink link(settings);
///     link.connect();  // waits until the printer is known
///     link.submit({.lines = "G28\nG1 Z5 F600\n", .count = 2, .layer = 0});
///     link.finish();  // waits until all lines are answered
class PrintLink {
  public:
    explicit PrintLink(LinkSettings settings);
    /// Stops the print unless it has finished.
    ~PrintLink();
    PrintLink(const PrintLink&) = delete;
    PrintLink& operator=(const PrintLink&) = delete;

    /// Opens the port and waits until the printer is known. Throws InputError, FaultError, Interrupted.
    void connect();
    /// Queues lines; blocks while the queue is full. Throws FaultError if the print has failed, Interrupted
    /// if it was cancelled.
    void submit(PrintChunk chunk);
    /// Sets the job's stamp, which the journal records with the progress.
    void set_stamp(nlohmann::ordered_json stamp) { stamp_ = std::move(stamp); }
    /// Tells what is known of the job, before its first lines are submitted.
    void expect(const JobOutlook& outlook);
    /// Waits until all lines are answered. Throws like submit.
    void finish();

    void pause() { request(pausing_); }
    /// Ends a pause, or tells a printer that waits for a person to continue.
    void resume() { request(resuming_); }
    /// Presses a button of the printer's prompt, by index.
    void choose(std::size_t button);
    /// Ends the print cleanly, after the moves that the printer has already received.
    void stop() { request(stopping_); }
    /// Halts the machine immediately, in the middle of its moves: by M112 if it has an emergency parser, by
    /// `!` and a reset on GRBL, by Klipper's emergency stop, otherwise by resetting the board over DTR.
    void halt() { request(halting_); }
    LinkStatus status() const;
    /// Stops the print if it is still running, waits for its end and returns why it ended. Null if the print
    /// did not fail or never started.
    std::exception_ptr end_reason();
    /// The same in words, with the state in which the machine was left. Empty for null.
    std::string end_words();

  private:
    bool is_klipper() const { return settings_.dialect == Dialect::klipper; }
    bool is_grbl() const { return settings_.dialect == Dialect::grbl; }
    enum class Phase : unsigned char { printing, aborting, switching_off, halting, done };
    void work();
    void round();
    void take_requests(double now);
    void begin_pause(bool by_printer);
    void end_pause();
    void heed(const std::string& action);
    void take_lines(double now);
    void watch_queue(double now);
    void watch_answers(double now);
    void write_journal(double now);
    void watch_lines(std::int64_t answered);
    void measure(double now);
    void read_bytes(double now);
    void write_bytes(double now);
    void wait(double now);
    void lose_port(double now);
    void reopen(double now);
    void remark(double now, const std::string& text);
    void notify(const std::string& text);
    void leave();
    void come_back();
    void abort(double now);
    void halt_at_once(double now);
    void go_on_aborting(double now);
    void switch_off();
    void end_aborted();
    MachinePort open_port(const std::string& path) const;
    void end(std::exception_ptr failure);
    void note_status(double now, bool at_once);
    void check();
    void request(std::atomic<bool>& flag);
    void wake();
    std::string where() const;
    std::string awaiting() const;
    double now() const;

    LinkSettings settings_;
    std::unique_ptr<LineSender> sender_;
    MachinePort port_;
    std::string lasting_name_;
    std::unique_ptr<LineLog> log_;
    std::unique_ptr<PrintJournal> journal_;
    nlohmann::ordered_json stamp_;
    int wake_ = -1;
    std::thread thread_;

    // Used by the thread only.
    Phase phase_ = Phase::printing;
    double phase_until_ = 0;
    PrintChunk current_;
    std::size_t current_at_ = 0;
    struct Answering {
        std::int64_t last = 0;  ///< number of the last line of the chunk
        int layer = -1;
        nlohmann::ordered_json resume;
    };
    std::deque<Answering> answering_;
    nlohmann::ordered_json resume_;
    std::deque<LineFacts> facts_;  // of the lines that are taken from the queue and not answered
    std::int64_t facts_answered_ = 0;
    std::int32_t source_line_ = 0;  // number of the line answered last in the job's text
    std::int64_t pushed_ = 0;
    int layer_ = -1;  // layer of the next line to be answered
    bool paused_ = false, parked_ = false, started_ = false;
    bool away_ = false;       // the nozzle has left the part
    bool returning_ = false;  // it was sent back, and may still be on its way
    MachineState left_;       // state in which it left
    double dry_since_ = -1;
    int underruns_ = 0;
    double underrun_seconds_ = 0;
    double lost_at_ = -1;       // when the port was lost; < 0: it is there
    double silent_since_ = -1;  // when the port was lost for the first time since the printer was last heard
    double next_try_ = 0;
    int losses_ = 0;
    double lost_seconds_ = 0;
    double measured_at_ = -1;
    double end_waiting_at_ = 0;
    double journaled_at_ = -10, journaled_z_ = -1;
    double noted_at_ = -10;
    double connected_at_ = -1;
    std::string abort_words_;
    std::string refusal_;  // why the job is ended, where nobody has asked for it

    // Shared between threads.
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<PrintChunk> queue_;
    std::size_t queued_bytes_ = 0;
    std::int64_t queued_lines_ = 0;
    PrintProgress progress_;
    int known_layer_ = -1;  // last layer that was submitted
    bool source_lines_ = false;
    bool closing_ = false;
    bool connected_ = false;
    bool done_ = false;
    std::exception_ptr failure_;
    LinkStatus status_;
    std::atomic<bool> pausing_{false}, resuming_{false}, stopping_{false}, halting_{false};
    std::atomic<int> choice_{-1};
};

}  // namespace lamella
