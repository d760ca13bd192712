// PrintLink: the queue of a print and the loop of its thread.
#include "printers/serial/print_link.h"

#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "engine/base/error.h"
#include "printers/serial/grbl_sender.h"
#include "printers/serial/klipper_sender.h"
#include "printers/serial/marlin_sender.h"

namespace lamella {
namespace {

constexpr std::size_t lines_before_sender = 128;
constexpr double journal_interval = 2;    // s
constexpr double cancel_interval = 0.02;  // s between two checks of the cancel token

}  // namespace

PrintLink::PrintLink(LinkSettings settings)
    : settings_(std::move(settings)), wake_(eventfd(0, EFD_NONBLOCK)) {
    settings_.sender.byte_time = is_klipper() ? 0 : 10.0 / settings_.baud;
    SenderListener listener;
    if (!settings_.log.empty()) {
        log_ = std::make_unique<LineLog>(settings_.log);
        listener.on_line = [this](char direction, std::string_view line, std::size_t in_flight) {
            log_->add(now(), direction, in_flight, line);
        };
    }
    listener.on_action = [this](const std::string& action) { heed(action); };
    listener.on_message = settings_.on_message;
    if (is_grbl()) {
        sender_ = std::make_unique<GrblSender>(settings_.sender, std::move(listener));
    } else if (is_klipper()) {
        sender_ = std::make_unique<KlipperSender>(settings_.sender, std::move(listener));
    } else {
        sender_ = std::make_unique<MarlinSender>(settings_.sender, std::move(listener));
    }
}

PrintLink::~PrintLink() {
    if (thread_.joinable()) {
        stop();
        thread_.join();
    }
    if (wake_ >= 0) close(wake_);
}

double PrintLink::now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void PrintLink::wake() {
    const std::uint64_t one = 1;
    if (write(wake_, &one, sizeof one) < 0) return;  // the counter is full, so the thread wakes anyway
}

void PrintLink::request(std::atomic<bool>& flag) {
    flag = true;
    wake();
}

void PrintLink::connect() {
    lasting_name_ = lasting_name(settings_.port);
    port_ = open_port(settings_.port);
    if (settings_.reset_board && !port_.reset_board())
        throw InputError("--reset: " + settings_.port + " has no DTR line that could reset a board");
    if (!settings_.journal.empty()) journal_ = std::make_unique<PrintJournal>(settings_.journal);
    thread_ = std::thread([this] { work(); });
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return connected_ || done_; });
    check();
}

void PrintLink::check() {
    if (failure_) std::rethrow_exception(failure_);
    if (done_ && !closing_) throw FaultError("the print has ended already");
}

void PrintLink::submit(PrintChunk chunk) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] {
        return done_ || queue_.empty() ||
               (queue_.size() < settings_.layers_ahead && queued_bytes_ < settings_.bytes_ahead);
    });
    check();
    queued_bytes_ += chunk.lines.size();
    queued_lines_ += chunk.count;
    double seconds = 0;
    for (const LineFacts& line : chunk.facts) seconds += static_cast<double>(line.seconds);
    progress_.known_seconds += seconds;
    if (chunk.layer >= 0) {
        progress_.layers_known += chunk.layer != known_layer_ ? 1 : 0;
        progress_.layers_seconds += seconds;
        known_layer_ = chunk.layer;
    }
    queue_.push_back(std::move(chunk));
    lock.unlock();
    wake();
}

void PrintLink::finish() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    wake();
    if (thread_.joinable()) thread_.join();
    const std::lock_guard lock(mutex_);
    check();
    if (journal_) journal_->remove();
}

void PrintLink::expect(const JobOutlook& outlook) {
    const std::lock_guard lock(mutex_);
    progress_.layers = outlook.layers;
    progress_.layers_before = outlook.layers_before;
    progress_.seconds_before = outlook.seconds_before;
    progress_.seconds_ahead = outlook.seconds_ahead;
    source_lines_ = outlook.source_lines;
}

LinkStatus PrintLink::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

std::exception_ptr PrintLink::end_reason() {
    if (thread_.joinable()) {
        stop();
        thread_.join();
    }
    return failure_;
}

std::string PrintLink::end_words() {
    try {
        if (const std::exception_ptr reason = end_reason()) std::rethrow_exception(reason);
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

void PrintLink::work() {
    // Layers are computed on all cores at the same time, so this thread gets priority if the system allows
    // it.
    const sched_param priority{1};
    pthread_setschedparam(pthread_self(), SCHED_RR, &priority);
    try {
        sender_->connect(now());
        while (phase_ != Phase::done) round();
    } catch (...) {
        end(std::current_exception());
    }
}

void PrintLink::round() {
    double time = now();
    // A process that was stopped finds answers of all that time. They are read before any timeout is judged.
    read_bytes(time);
    if (phase_ == Phase::done) return;
    take_requests(time);
    if (phase_ == Phase::printing) {
        take_lines(time);
        watch_queue(time);
    } else {
        go_on_aborting(time);
    }
    if (phase_ == Phase::done) return;
    sender_->tick(time);
    write_bytes(time);
    time = now();
    measure(time);
    watch_answers(time);
    note_status(time, false);
    if (phase_ != Phase::done) wait(time);
}

void PrintLink::choose(std::size_t button) {
    choice_ = static_cast<int>(button);
    wake();
}

void PrintLink::take_requests(double now) {
    const bool cancelled = settings_.cancel != nullptr && settings_.cancel->cancelled();
    if (halting_.exchange(false) ||
        (phase_ == Phase::printing && cancelled && sender_->connected() && sender_->cancel_halts()))
        return halt_at_once(now);
    if (phase_ != Phase::printing) return;
    if (cancelled || stopping_) return abort(now);
    // While the port is away, requests wait for it.
    if (!sender_->connected() || lost_at_ >= 0) return;
    if (pausing_.exchange(false)) begin_pause(false);
    if (const int button = choice_.exchange(-1); button >= 0)
        sender_->choose(static_cast<std::size_t>(button));
    if (!resuming_.exchange(false)) return;
    if (sender_->user_wait()) {
        sender_->end_waiting();
    } else {
        end_pause();
    }
}

/// Handles an action that the printer asks of the host.
void PrintLink::heed(const std::string& action) {
    if (action == "pause") begin_pause(false);
    if (action == "paused") begin_pause(true);
    if (action == "resume" || action == "resumed") end_pause();
    if (action == "cancel") {
        stopping_ = true;
        sender_->hold(true);
    }
    if (action == "disconnect")
        end(std::make_exception_ptr(FaultError("the printer has asked to be disconnected" + where())));
}

/// A printer that paused by itself has also parked its nozzle.
void PrintLink::begin_pause(bool by_printer) {
    if (paused_ || phase_ != Phase::printing || !sender_->connected()) return;
    if (!by_printer && !sender_->can_pause() && current_at_ >= current_.lines.size())
        return notify("too late to pause: the printer has all lines of the job; it can only be stopped");
    paused_ = true;
    sender_->hold(true);
    if (by_printer) return;
    sender_->hold_motion(true);
    leave();
}

void PrintLink::end_pause() {
    if (!paused_ || phase_ != Phase::printing) return;
    paused_ = false;
    if (!parked_) come_back();
    sender_->hold_motion(false);
    sender_->hold(false);
}

void PrintLink::leave() {
    if (is_grbl() || std::exchange(away_, true)) return;
    // On its way back the nozzle has not reached the state that it is to return to.
    const bool on_the_way = std::exchange(returning_, false) && sender_->host_lines() > 0;
    const MachineState& here = sender_->machine();
    if (!on_the_way) left_ = here;
    if (on_the_way) sender_->drop_host_lines();
    for (std::string& line : here.leave_from(left_, settings_.park_x, settings_.park_y, settings_.highest))
        sender_->interject(std::move(line));
}

void PrintLink::come_back() {
    if (!std::exchange(away_, false)) return;
    returning_ = true;
    for (std::string& line : left_.come_back(settings_.highest)) sender_->interject(std::move(line));
}

/// Moves lines from the queue to the sender. A layer is taken only when it is complete.
void PrintLink::take_lines(double now) {
    if (!sender_->connected()) return;
    while (sender_->pending() < lines_before_sender) {
        if (current_at_ >= current_.lines.size()) {
            std::unique_lock lock(mutex_);
            if (queue_.empty()) {
                if (closing_) sender_->finish();
                return;
            }
            current_ = std::move(queue_.front());
            queue_.pop_front();
            queued_bytes_ -= current_.lines.size();
            lock.unlock();
            changed_.notify_all();
            current_at_ = 0;
            pushed_ += current_.count;
            current_.facts.resize(static_cast<std::size_t>(current_.count));
            facts_.insert(facts_.end(), current_.facts.begin(), current_.facts.end());
            current_.facts = {};
            answering_.push_back({pushed_, current_.layer, current_.resume});
            if (dry_since_ >= 0) underrun_seconds_ += now - dry_since_;
            dry_since_ = -1;
            started_ = true;
            if (std::exchange(parked_, false) && !paused_) come_back();
            continue;
        }
        const std::size_t end = current_.lines.find('\n', current_at_);
        sender_->push(current_.lines.substr(current_at_, end - current_at_));
        current_at_ = end + 1;
        if (current_at_ >= current_.lines.size()) sender_->end_part();
    }
}

/// Parks the nozzle off the part if no layer is ready.
void PrintLink::watch_queue(double now) {
    if (!started_ || paused_ || parked_ || lost_at_ >= 0 || !sender_->idle() ||
        current_at_ < current_.lines.size())
        return;
    {
        const std::lock_guard lock(mutex_);
        if (closing_ || !queue_.empty()) return;
    }
    if (now < sender_->dry_at()) return;
    if (dry_since_ < 0) {
        dry_since_ = now;
        ++underruns_;
    }
    if (now - dry_since_ < settings_.park_after || is_grbl()) return;
    leave();
    parked_ = true;
}

void PrintLink::watch_answers(double now) {
    const std::int64_t answered = sender_->answered();
    watch_lines(answered);
    bool layer_done = false;
    while (!answering_.empty() && answering_.front().last <= answered) {
        if (!answering_.front().resume.is_null()) resume_ = std::move(answering_.front().resume);
        answering_.pop_front();
        layer_done = true;
    }
    // What comes behind the last layer belongs to none.
    if (!answering_.empty() && answering_.front().layer >= 0) layer_ = answering_.front().layer;
    const double z = sender_->machine().z();
    if (layer_done || z != journaled_z_ || now - journaled_at_ >= journal_interval) write_journal(now);
    if (sender_->connected() && !connected_) {
        {
            const std::lock_guard lock(mutex_);
            connected_ = true;
            status_.knows_height = sender_->knows_height();
            status_.takes_height = sender_->takes_height();
        }
        note_status(now, true);
        changed_.notify_all();
    }
    if (sender_->stopped() && phase_ == Phase::printing) {
        // First send what the sender still has to say, such as GRBL's hold.
        write_bytes(now);
        write_journal(now);
        return end(std::make_exception_ptr(FaultError(sender_->stopped()->why + where())));
    }
    if (phase_ == Phase::printing && sender_->refused()) {
        refusal_ = *sender_->refused() + where();
        return abort(now);
    }
    if (phase_ == Phase::printing && sender_->finished()) end(nullptr);
}

/// Sleeps until a byte can be read or written, or the sender or a request is due.
void PrintLink::wait(double now) {
    double until = std::min(sender_->wake_at(), now + 0.5);
    if (settings_.cancel != nullptr) until = std::min(until, now + cancel_interval);
    if (dry_since_ >= 0 && !parked_) until = std::min(until, dry_since_ + settings_.park_after);
    if (!port_.is_open()) until = std::min(until, next_try_);
    const double left = std::max(0.0, until - this->now());
    timespec time{static_cast<time_t>(left), static_cast<long>((left - std::floor(left)) * 1e9)};
    const auto events = static_cast<short>(sender_->output().empty() ? POLLIN : POLLIN | POLLOUT);
    std::array<pollfd, 2> watched{{{wake_, POLLIN, 0}, {port_.descriptor(), events, 0}}};
    if (ppoll(watched.data(), port_.is_open() ? 2 : 1, &time, nullptr) < 0) return;
    std::uint64_t count = 0;
    if ((watched[0].revents & POLLIN) != 0 && read(wake_, &count, sizeof count) < 0) return;
}

}  // namespace lamella
