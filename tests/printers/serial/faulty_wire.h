// A wire with a length, a speed, and faults, one way; and a run of a sender against a simulated printer over
// two of them.
#pragma once

#include <algorithm>
#include <deque>
#include <random>
#include <string>
#include <string_view>
#include <utility>

namespace lamella::test {

/// Shares of lines that are spoilt, each in its own way.
struct WireFaults {
    double flipped_bit = 0, dropped_byte = 0, dropped_newline = 0, dropped_line = 0, doubled_line = 0,
           noise = 0;
};

class FaultyWire {
  public:
    FaultyWire(WireFaults faults, double latency, double byte_time, unsigned seed)
        : faults_(faults), latency_(latency), byte_time_(byte_time), random_(seed) {}

    /// Puts bytes on the wire; each whole line meets its fate.
    void put(std::string_view bytes, double now) {
        for (const char c : bytes) {
            line_ += c;
            if (c == '\n') send(now);
        }
    }
    /// What has arrived by now.
    std::string take(double now) {
        std::string bytes;
        while (!under_way_.empty() && under_way_.front().first <= now) {
            bytes += under_way_.front().second;
            under_way_.pop_front();
        }
        return bytes;
    }
    /// The next line that is just so does not arrive.
    void lose_next(std::string line) { doomed_ = std::move(line) + "\n"; }
    int faults() const { return count_; }

  private:
    bool happens(double share) {
        const bool now = std::uniform_real_distribution<>(0, 1)(random_) < share;
        count_ += now ? 1 : 0;
        return now;
    }
    std::size_t somewhere() { return random_() % (line_.size() - 1); }
    void send(double now) {
        if (line_ == doomed_) line_.clear(), doomed_.clear();
        if (line_.size() > 1) {
            // One fault a line: the XOR of a line misses many a pair of them.
            if (happens(faults_.flipped_bit)) {
                char& c = line_[somewhere()];
                c = static_cast<char>(static_cast<unsigned char>(c) ^ (1U << random_() % 8));
            } else if (happens(faults_.noise)) {
                spoil();
            } else if (happens(faults_.dropped_byte)) {
                line_.erase(somewhere(), 1);
            } else if (happens(faults_.doubled_line)) {
                line_ += line_;
            } else if (happens(faults_.dropped_newline)) {
                line_.pop_back();
            } else if (happens(faults_.dropped_line)) {
                line_.clear();
            }
        }
        for (const char c : line_) {
            free_at_ = std::max(free_at_, now) + byte_time_;
            under_way_.emplace_back(free_at_ + latency_, c);
        }
        line_.clear();
    }
    /// A burst that overwrites some bytes. One that leaves the XOR as it is passes every checksum, and a line
    /// end in it can leave a command without its number: no sender can see either.
    void spoil() {
        const std::string before = line_;
        const auto sum = [](const std::string& text) {
            unsigned all = 0;
            for (const char c : text) all ^= static_cast<unsigned char>(c);
            return all;
        };
        while (sum(line_) == sum(before)) {
            line_ = before;
            const std::size_t first = somewhere();
            const std::size_t last = std::min(line_.size() - 1, first + 1 + random_() % 10);
            for (std::size_t i = first; i < last; ++i) {
                const auto byte = static_cast<unsigned char>(random_() % 256);
                if (byte != '\n' && byte != '\r' && byte != '*') line_[i] = static_cast<char>(byte);
            }
        }
    }

    WireFaults faults_;
    double latency_;
    double byte_time_;
    std::mt19937 random_;
    std::string line_;
    std::string doomed_;
    std::deque<std::pair<double, char>> under_way_;
    double free_at_ = 0;
    int count_ = 0;
};

}  // namespace lamella::test
