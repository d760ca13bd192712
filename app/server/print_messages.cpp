// The messages of a print, and when its status is one.
#include "app/server/print_messages.h"

#include "printers/serial/print_link.h"

namespace lamella {

void PrintMessages::add(const std::string& text) {
    if (text.empty()) return;
    nlohmann::ordered_json message;
    {
        const std::lock_guard lock(mutex_);
        message = {{"print", print_}, {"number", next_++}, {"text", text}};
        kept_.push_back(message);
        if (kept_.size() > most_kept) kept_.pop_front();
    }
    on_message_(message);
}

nlohmann::ordered_json PrintMessages::json() const {
    const std::lock_guard lock(mutex_);
    auto list = nlohmann::ordered_json::array();
    for (const auto& message : kept_) list.push_back(message);
    return list;
}

void PrintRemarks::tell_once(const std::string& text, std::string& told) {
    if (text == told) return;
    told = text;
    messages_.add(text);
}

void PrintRemarks::look(const LinkStatus& status) {
    const auto named = [](const char* what, const std::string& why) {
        return why.empty() ? std::string() : what + why;
    };
    tell_once(status.awaiting, awaiting_);
    tell_once(status.connected ? named("the printer is ", status.firmware) : "", firmware_);
    tell_once(status.waits ? "the printer waits for you: " + status.waits->text : "", wait_);
    tell_once(named("the journal cannot be written, the print cannot be resumed from here: ",
                    status.journal_trouble),
              journal_);
    tell_once(status.lost ? "the port is gone; it is tried again" : "", lost_);
    if (status.notices != notices_) messages_.add(status.notice);
    notices_ = status.notices;
}

}  // namespace lamella
