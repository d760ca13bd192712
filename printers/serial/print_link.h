// PrintLink: the thread that owns a port and a sender, and the queue of whole layers before it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <fstream>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "engine/layers/layer_stream.h"
#include "printers/serial/line_sender.h"
#include "printers/serial/print_journal.h"
#include "printers/serial/serial_port.h"

namespace lamella {

struct LinkSettings {
    std::string port;
    int baud = 250000;
    bool reset_board = false;  ///< by DTR, before anything is sent
    bool grbl = false;
    SenderSettings sender;
    std::string log;                ///< file for every line; empty: none
    std::string journal;            ///< file; empty: none
    double park_x = 0, park_y = 0;  ///< where the nozzle waits, off the part, mm
    double highest = 250;           ///< of the nozzle, mm
    std::size_t layers_ahead = 8;   ///< in the queue at most
    std::size_t bytes_ahead = 64u << 20;
    double park_after = 0.5;    ///< s without a layer
    double reconnect_for = 60;  ///< s that a lost port is tried again
    const CancelToken* cancel = nullptr;
};

/// Lines that are sent together, once they are all there.
struct PrintChunk {
    std::string lines;                ///< clean, each with its end
    std::int64_t count = 0;           ///< of lines
    int layer = -1;                   ///< -1: before the first
    nlohmann::ordered_json resume{};  ///< what the journal says once it is answered
};

/// How a print stands.
struct LinkStatus {
    std::string firmware;
    bool emergency_parser = false;
    bool connected = false;
    bool paused = false;
    bool parked = false;
    bool stopping = false;            ///< the print is being ended
    std::optional<UserWait> waits{};  ///< what the printer waits for a person to do
    std::string journal_trouble;      ///< why the journal cannot be written; empty when it can
    bool lost = false;                ///< the port is gone for now
    int layer = -1;                   ///< that lines are answered of
    std::int64_t lines_queued = 0, lines_answered = 0;
    std::size_t layers_ready = 0;
    double z = 0;
    Temperatures temperatures;
    SenderStatistics statistics;
    int underruns = 0;  ///< times the printer had nothing left because no layer was ready
    double underrun_seconds = 0;
    double seconds = 0;  ///< since the printer was connected
};

class PrintLink {
  public:
    explicit PrintLink(LinkSettings settings);
    /// Stops the print unless it was finished.
    ~PrintLink();
    PrintLink(const PrintLink&) = delete;
    PrintLink& operator=(const PrintLink&) = delete;

    /// Opens the port and gets to know the printer. Throws InputError, FaultError, Interrupted.
    void connect();
    /// Queues lines; waits while enough are queued. Throws FaultError when the print has failed, Interrupted
    /// when it was cancelled.
    void submit(PrintChunk chunk);
    /// What the journal holds besides: the job's stamp.
    void set_stamp(nlohmann::ordered_json stamp) { stamp_ = std::move(stamp); }
    /// Waits until all is answered. Throws like submit.
    void finish();

    void pause() { request(pausing_); }
    /// Ends a pause, or tells a printer that waits for a person to go on.
    void resume() { request(resuming_); }
    /// Presses a button of what the printer asks, by its index.
    void choose(std::size_t button);
    /// Ends the print cleanly, when what the printer has already got is done.
    void stop() { request(stopping_); }
    /// Halts the machine at once, in the midst of its moves: by M112 where it has an emergency parser, by `!`
    /// and a reset on GRBL, else by resetting the board over DTR.
    void halt() { request(halting_); }
    LinkStatus status() const;
    /// Waits until the print has ended, cleanly where it was cancelled, and tells what became of the machine;
    /// empty when it was never reached.
    std::string end_words();

  private:
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
    void move_bytes(double now);
    void wait(double now);
    void reopen(double now);
    void leave();
    void come_back();
    void abort(double now);
    void halt_at_once(double now);
    void go_on_aborting(double now);
    void end(std::exception_ptr failure);
    void note_status(double now, bool at_once);
    void check();
    void request(std::atomic<bool>& flag);
    void wake();
    std::string where() const;
    double now() const;

    LinkSettings settings_;
    std::unique_ptr<LineSender> sender_;
    SerialPort port_;
    std::string lasting_name_;
    std::ofstream log_;
    std::unique_ptr<PrintJournal> journal_;
    nlohmann::ordered_json stamp_;
    int wake_ = -1;
    std::thread thread_;

    // Of the thread alone.
    Phase phase_ = Phase::printing;
    double phase_until_ = 0;
    PrintChunk current_;
    std::size_t current_at_ = 0;
    struct Answering {
        std::int64_t last = 0;  ///< lines up to its end
        int layer = -1;
        nlohmann::ordered_json resume;
    };
    std::deque<Answering> answering_;
    nlohmann::ordered_json resume_;
    std::int64_t pushed_ = 0;
    int layer_ = -1;  // of the line that is to be answered next
    bool paused_ = false, parked_ = false, started_ = false;
    bool away_ = false;  // the nozzle was taken off the part
    MachineState left_;  // where it was
    double dry_since_ = -1;
    int underruns_ = 0;
    double underrun_seconds_ = 0;
    double lost_since_ = -1, next_try_ = 0;
    double journaled_at_ = -10, journaled_z_ = -1;
    double noted_at_ = -10;
    double connected_at_ = -1;
    std::string abort_words_;

    // Shared.
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<PrintChunk> queue_;
    std::size_t queued_bytes_ = 0;
    std::int64_t queued_lines_ = 0;
    bool closing_ = false;
    bool connected_ = false;
    bool done_ = false;
    std::exception_ptr failure_;
    LinkStatus status_;
    std::atomic<bool> pausing_{false}, resuming_{false}, stopping_{false}, halting_{false};
    std::atomic<int> choice_{-1};
};

}  // namespace lamella
