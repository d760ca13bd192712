// Retries, and the order of upload, check and start.
#include "hosts/send_upload.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "engine/base/text.h"
#include "hosts/wait.h"

namespace lamella {

namespace {

class Sending {
  public:
    Sending(NetworkHost& host, UploadSource* source, const SendSettings& settings)
        : host_(host), source_(source), settings_(settings) {}

    HostFacts greet() {
        HostFacts facts = ask([&] { return host_.facts(); });
        const HostStatus status = ask([&] { return host_.status(); });
        if (settings_.start && is_active(status.state))
            note(fmt::format("the host is {} {}", state_word(status.state), status.file));
        return facts;
    }

    SendReport run() {
        check_room(ask([&] { return host_.facts(); }));
        if (settings_.start) refuse_while_busy(ask([&] { return host_.status(); }));
        const std::optional<HostFile> had = ask([&] { return host_.find(settings_.name); });
        if (had && is_there(*had) && !settings_.again) {
            report_.size = *had->size;
            note(fmt::format("{} is there already", settings_.name));
        } else if (!report_.prints) {
            upload();
        }
        if (settings_.start && !report_.prints) start();
        return report_;
    }

  private:
    void note(const std::string& text) const {
        if (settings_.on_note) settings_.on_note(text);
    }

    void tell_sent(std::uint64_t bytes) const {
        if (!settings_.on_sent) return;
        const std::optional<UploadFacts>& facts = source_->facts();
        settings_.on_sent(bytes, facts ? std::optional(facts->size) : std::nullopt);
    }

    /// Waits before the next try of what has failed for the `tries`-th time, or throws the failure.
    void wait_after(const HostError& error, int tries, bool may_repeat) const {
        if (!may_repeat || tries >= settings_.retry.attempts) throw error;
        const double seconds = settings_.retry.first_wait * std::pow(2.0, tries - 1);
        note(fmt::format("{}; once more in {:.3g} s", error.what(), seconds));
        wait_for(seconds, settings_.cancel);
    }

    /// Asks a question, which may be repeated whatever became of it.
    template <typename Question>
    auto ask(const Question& question) const -> decltype(question()) {
        for (int tries = 1;; ++tries) {
            try {
                return question();
            } catch (const HostError& error) {
                wait_after(error, tries, error.failure() != HostFailure::refused);
            }
        }
    }

    /// Returns whether the host's file has these bytes, as far as the host tells.
    static bool agrees(const HostFile& file, const UploadFacts& facts) {
        const bool known = file.hash.size() == facts.md5.size() || file.hash.size() == facts.sha1.size() ||
                           file.hash.size() == facts.sha256.size();
        const bool same_hash = file.hash == facts.md5 || file.hash == facts.sha1 || file.hash == facts.sha256;
        return file.size.value_or(facts.size) == facts.size && (!known || same_hash);
    }

    /// Returns whether the host's file needs no upload. Where nothing is known of the upload yet, its name
    /// says so, which holds the job's hash. A host that tells no size may have a part of it.
    bool is_there(const HostFile& file) const {
        return file.size && (!source_->facts() || agrees(file, *source_->facts()));
    }

    /// Throws InputError for a file that the host does not take.
    void check_room(const HostFacts& facts) const {
        const std::string& name = settings_.name;
        const std::string ending = lower_case(name.substr(std::min(name.rfind('.'), name.size())));
        if (!facts.formats.empty() &&
            (" " + facts.formats + " ").find(" " + ending + " ") == std::string::npos) {
            throw InputError(fmt::format("{}: {} does not take such files; accepted: {}", name,
                                         facts.software, facts.formats));
        }
        const std::optional<UploadFacts>& upload = source_->facts();
        if (upload && facts.free_bytes && *facts.free_bytes < upload->size) {
            throw InputError(
                fmt::format("{}: has {} bytes, and the host has room for {}; accepted: a smaller file, "
                            "or delete files there",
                            name, grouped(upload->size), grouped(*facts.free_bytes)));
        }
    }

    void refuse_while_busy(const HostStatus& status) {
        if (!is_active(status.state)) return;
        if (is_ours(status.file)) {
            note(fmt::format("{} is {} already", settings_.name, state_word(status.state)));
            report_.prints = true;
            return;
        }
        throw InputError(
            fmt::format("the host is {} {}; accepted: a host that is free, or an upload without a start",
                        state_word(status.state), status.file.empty() ? "something else" : status.file));
    }

    void upload() {
        for (int tries = 1;; ++tries) {
            ++report_.attempts;
            try {
                const UploadFacts sent =
                    host_.upload(settings_.name, *source_, [&](std::uint64_t bytes) { tell_sent(bytes); });
                const std::optional<HostFile> file = ask([&] { return host_.find(settings_.name); });
                // A host that tells no size has checked the upload by its hash, or by reading it.
                if (file && agrees(*file, sent)) {
                    report_.size = sent.size;
                    report_.uploaded = true;
                    return;
                }
                throw HostError(HostFailure::damaged,
                                fmt::format("the host does not have {} whole", settings_.name));
            } catch (const HostError& error) {
                wait_after(error, tries, error.failure() != HostFailure::refused);
            }
        }
    }

    bool is_ours(const std::string& file) const {
        return file == settings_.name || file.ends_with("/" + settings_.name);
    }

    /// Returns whether the host prints the file, as soon as its status says so; false if it does not within
    /// `seconds`. A print that has `begun` may have ended.
    bool is_seen_printing(double seconds, bool begun) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        for (;;) {
            try {
                const HostStatus status = host_.status();
                const bool ended = begun && status.state == PrintState::finished;
                if (is_ours(status.file) && (is_active(status.state) || ended)) return true;
                last_words_ = status.message;
            } catch (const HostError& error) {
                last_words_ = error.what();  // restarting, perhaps: asked again until the time is over
            }
            if (std::chrono::steady_clock::now() >= until) return false;
            wait_for(std::min(0.5, settings_.retry.first_wait), settings_.cancel);
        }
    }

    /// Asks for the print, once: again only where the host has said that it did not begin.
    void start() {
        const double confirm = settings_.retry.confirm;
        for (int tries = 1;; ++tries) {
            try {
                host_.start(settings_.name);
                break;
            } catch (const HostError& error) {
                if (error.failure() == HostFailure::unanswered) {
                    note(fmt::format("{}; asking whether it prints", error.what()));
                    if (is_seen_printing(confirm, false)) return begun();
                    throw FaultError(
                        fmt::format("{}. The file is there whole, but whether the host will print it is not "
                                    "known. It was not asked twice: look at the machine",
                                    error.what()));
                }
                wait_after(error, tries, error.failure() != HostFailure::refused);
                if (is_seen_printing(0, false)) return begun();
            }
        }
        if (!is_seen_printing(confirm, true)) {
            throw FaultError(
                fmt::format("the host has accepted to print {}, but does not{}{}; look at the machine",
                            settings_.name, last_words_.empty() ? "" : ": ", last_words_));
        }
        begun();
    }

    void begun() { report_.started = report_.prints = true; }

    NetworkHost& host_;
    UploadSource* source_;  // null for a greeting
    const SendSettings& settings_;
    SendReport report_;
    std::string last_words_;  // of the host's status
};

}  // namespace

HostFacts greet_host(NetworkHost& host, const SendSettings& settings) {
    return Sending(host, nullptr, settings).greet();
}

SendReport send_upload(NetworkHost& host, UploadSource& source, const SendSettings& settings) {
    return Sending(host, &source, settings).run();
}

std::string upload_name(const std::string& stem, const std::string& hash, const std::string& ending) {
    constexpr std::size_t longest_stem = 40, hash_digits = 8;
    std::string name;
    for (const char c : stem.substr(0, longest_stem)) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           c == '-' || c == '_' || (c == '.' && !name.empty());
        name += plain ? c : '_';
    }
    return (name.empty() ? "part" : name) + "-" + hash.substr(0, hash_digits) + ending;
}

}  // namespace lamella
