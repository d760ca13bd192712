// Ranks over MPI: a module that is loaded when mpirun has started the program.
#include <mpi.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <limits>
#include <mutex>
#include <thread>

#include "app/ranks/ranks.h"
#include "engine/base/error.h"

namespace lamella {
namespace {

class MpiRanks : public Ranks {
  public:
    MpiRanks() {
        int level = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
        if (level < MPI_THREAD_SERIALIZED)
            throw FaultError(
                "this MPI library does not support calls from several threads; accepted: one with "
                "MPI_THREAD_SERIALIZED");
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
        mover_ = std::thread([this] { keep_moving(); });
    }
    ~MpiRanks() override {
        while (outstanding() > 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
        {
            const std::lock_guard lock(calling_);
            done_ = true;
        }
        sent_.notify_one();
        mover_.join();
        MPI_Finalize();
    }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;

    int rank() const override { return rank_; }
    int size() const override { return size_; }

    void send(int to, int tag, std::string bytes) override {
        if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            throw FaultError("a message has more than 2 GiB, the limit of an MPI message");
        const std::lock_guard lock(calling_);
        Message& message = on_the_way_.emplace_back();
        message.bytes = std::move(bytes);
        MPI_Isend(message.bytes.data(), static_cast<int>(message.bytes.size()), MPI_BYTE, to, tag,
                  MPI_COMM_WORLD, &message.request);
        sent_.notify_one();
    }

    std::optional<std::string> receive(int from, int tag) override {
        const std::lock_guard lock(calling_);
        int is_there = 0, size = 0;
        MPI_Message message{};
        MPI_Status status{};
        MPI_Improbe(from, tag, MPI_COMM_WORLD, &is_there, &message, &status);
        if (!is_there) return std::nullopt;
        MPI_Get_count(&status, MPI_BYTE, &size);
        std::string bytes(static_cast<std::size_t>(size), '\0');
        MPI_Mrecv(bytes.data(), size, MPI_BYTE, &message, &status);
        return bytes;
    }

    std::size_t outstanding() override {
        const std::lock_guard lock(calling_);
        drop_what_has_arrived();
        return on_the_way_.size();
    }

    [[noreturn]] void abort(int code) override {
        MPI_Abort(MPI_COMM_WORLD, code);
        std::_Exit(code);
    }

  private:
    struct Message {
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };

    void drop_what_has_arrived() {
        std::erase_if(on_the_way_, [](Message& message) {
            int has_arrived = 0;
            MPI_Test(&message.request, &has_arrived, MPI_STATUS_IGNORE);
            return has_arrived != 0;
        });
    }

    /// Large messages progress only during calls to MPI. Costs nothing while none is in transit.
    void keep_moving() {
        std::unique_lock lock(calling_);
        for (;;) {
            sent_.wait(lock, [this] { return done_ || !on_the_way_.empty(); });
            if (done_) return;
            drop_what_has_arrived();
            lock.unlock();
            std::this_thread::sleep_for(std::chrono::microseconds(500));
            lock.lock();
        }
    }

    int rank_ = 0, size_ = 1;
    std::mutex calling_;
    std::deque<Message> on_the_way_;  // a deque: messages must not move in memory until they have arrived
    std::condition_variable sent_;    // signals a message in transit, or the end
    bool done_ = false;
    std::thread mover_;
};

}  // namespace
}  // namespace lamella

extern "C" lamella::Ranks* lamella_make_ranks() { return new lamella::MpiRanks; }
