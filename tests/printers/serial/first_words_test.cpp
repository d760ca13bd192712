// Before a printer is known: silence, garbage, an echo and other text are told apart, and each by its remedy.
#include "printers/serial/first_words.h"

#include <catch2/catch.hpp>
#include <memory>
#include <random>

#include "printers/serial/grbl_sender.h"
#include "printers/serial/marlin_sender.h"

namespace first_words_test {

using namespace lamella;

namespace {

/// Runs a sender against a port that answers each batch of bytes by `reply`, and returns when and why it gave
/// up.
struct End {
    double at = 0;
    std::string why;
};

template <class Reply>
End give_up(LineSender& sender, Reply reply) {
    sender.connect(0);
    for (double now = 0; now < 100; now += 0.01) {
        sender.tick(now);
        const std::string out(sender.output());
        sender.wrote(out.size());
        sender.receive(reply(out), now);
        if (sender.stopped()) return {now, sender.stopped()->why};
    }
    return {};
}

}  // namespace

TEST_CASE("a dead port, a wrong baud rate, an echo and a stranger each end in their own words") {
    const bool grbl = GENERATE(false, true);
    std::unique_ptr<LineSender> sender;
    if (grbl) {
        sender = std::make_unique<GrblSender>(SenderSettings{}, SenderListener{});
    } else {
        sender = std::make_unique<MarlinSender>(SenderSettings{}, SenderListener{});
    }
    SECTION("silence") {
        const End end = give_up(*sender, [](const std::string&) { return std::string(); });
        CHECK(end.why.find("silent") != std::string::npos);
        CHECK(end.why.find("250000") != std::string::npos);
        CHECK(end.at > 15);
        CHECK(sender->first_words().remark(250000).empty());
    }
    SECTION("garbage") {
        std::mt19937 random(3);
        const End end = give_up(*sender, [&](const std::string& out) {
            std::string bytes(out.size(), ' ');
            for (char& c : bytes) c = static_cast<char>(random() % 256);
            return bytes;
        });
        CHECK(end.why.find("no text") != std::string::npos);
        CHECK(end.why.find("--baud 115200") != std::string::npos);
        CHECK(end.at < 12);
    }
    SECTION("echo") {
        const End end = give_up(*sender, [](const std::string& out) { return out; });
        CHECK(end.why.find("returns what is sent") != std::string::npos);
        CHECK(end.at < 12);
    }
    SECTION("a console") {
        const End end = give_up(
            *sender, [](const std::string& out) { return std::string(out.empty() ? "" : "login: \n"); });
        CHECK(end.why.find("login:") != std::string::npos);
    }
}

TEST_CASE("the baud rate to try first is the common one that was not tried") {
    FirstWords words("N0 M110 N0*125");
    words.take("\x80\xF0\x03\xFE\x80\x1F");
    CHECK(words.kind() == FirstWordsKind::garbage);
    CHECK(words.remark(250000).find("--baud 115200") != std::string::npos);
    CHECK(words.remark(115200).find("--baud 250000") != std::string::npos);
}

TEST_CASE("a greeting with a single strange byte is text") {
    FirstWords words("N0 M110 N0*125");
    words.take("start\r\nMarlin: Virtual Marlin!\n\x80\nSD card ok\n");
    CHECK(words.kind() == FirstWordsKind::text);
    CHECK(words.remark(250000) == "it says \"SD card ok\"");
}

}  // namespace first_words_test
