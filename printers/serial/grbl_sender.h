// GrblSender: streams G-code to GRBL by counting characters; stops at the first error.
#pragma once

#include "printers/serial/line_sender.h"

namespace lamella {

/// Keeps the receive buffer of GRBL 1.1 filled without ever overflowing it. GRBL continues after a line that
/// it refuses, so the sender counts answers, names the refused line, and holds the machine. Lines that write
/// settings ($..., G10, G28.1, G30.1) are sent alone, because GRBL disables interrupts while it writes them.
class GrblSender : public LineSender {
  public:
    GrblSender(SenderSettings settings, SenderListener listener)
        : LineSender(settings, std::move(listener), "$I") {}

    void connect(double now) override;
    std::size_t unanswered() const override { return bytes_; }
    bool connected() const override { return state_ == State::running; }
    bool finished() const override;
    /// Holds the motion, waits for standstill, then resets, so that the position is kept.
    void halt(double now) override;
    bool halts_at_once() const override { return true; }
    void hold_motion(bool held) override;
    /// Cycle start: ends M0 and a hold by a button of the machine.
    void end_waiting() override { transmit_raw("~", false); }
    std::optional<UserWait> user_wait() const override;
    LineWait line_wait() const override;

  protected:
    void handle(const Reply& reply, double now) override;
    void check_time(double now) override;
    double next_wake() const override;
    void take_up_dialogue(double now) override;
    void feed(double now) override;

  private:
    enum class State : unsigned char { idle, greeting, asking, running, holding };
    struct Sent {
        std::string command;
        std::size_t size;
        bool job;
        bool alone;
    };
    void answer(const Reply& reply);
    void reset(const char* how);
    void refuse(const std::string& why);
    bool send_next(std::deque<std::string>& lines, bool of_job, double now);

    State state_ = State::idle;
    double state_until_ = 0;
    int tries_ = 0;
    std::deque<Sent> sent_;
    std::size_t bytes_ = 0;
    double next_status_ = 0;
    double idle_since_ = -1;      // when GRBL first reported Idle with lines unanswered; < 0: it has not
    std::string machine_status_;  // last reported state
    bool motion_held_ = false;    // on request of the host
    bool dwelt_ = false;
};

}  // namespace lamella
