// Turn by turn, the first rank says how many layers it renders itself: fewer when those of the others wait
// for it.
#include "app/spread_layers.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <vector>

#include "app/rank_failure.h"
#include "app/wait_for.h"
#include "engine/error.h"
#include "printers/carried_layers.h"

namespace lamella {
namespace {

constexpr int layers_in_a_block = 8;
constexpr std::size_t blocks_ahead = 2;  ///< that wait to be taken

/// MPI has tags up to 32767; layers that are on the way at once are far nearer to each other.
int tag_of(int layer) { return first_layer_tag + layer % 32000; }

/// Successive layers: some of rank 0, which has to write all of them besides, then a block of each other
/// rank.
struct Turn {
    int first = 0;
    int own = layers_in_a_block;  ///< layers of rank 0

    int end(int ranks) const { return block_of(ranks).first; }
    LayerRange block_of(int rank) const {
        const int begin = first + own + layers_in_a_block * (rank - 1);
        return {begin, begin + layers_in_a_block};
    }
    int owner_of(int layer) const {
        const int behind_own = layer - first - own;
        return behind_own < 0 ? 0 : 1 + behind_own / layers_in_a_block;
    }
};

std::string packed(Turn turn) {
    Parcel parcel;
    parcel(turn.first, turn.own);
    return parcel.bytes();
}

Turn unpacked_turn(std::string bytes) {
    Parcel parcel(std::move(bytes));
    Turn turn;
    parcel(turn.first, turn.own);
    parcel.finish();
    return turn;
}

/// How long rank 0 has taken for its work so far. Decides who renders, never what. Thread-safe.
class WorkTimes {
  public:
    struct Work {
        double seconds = 0;
        int layers = 0;
        double per_layer() const { return seconds / layers; }
    };
    Work rendering, writing;

    template <typename Do>
    auto take(Work& work, const Do& one_layer) {
        const Counting counting{*this, work};
        return one_layer();
    }
    /// So many layers of its own that rank 0, which writes all layers besides, is done with them when each
    /// other rank is with a block, if all are as quick as it is. Nothing before it has done any.
    std::optional<double> fair_share(int ranks) {
        const std::lock_guard lock(access_);
        if (rendering.layers == 0 || writing.layers == 0) return std::nullopt;
        const double render = rendering.per_layer(), write = writing.per_layer();
        return layers_in_a_block * (render - (ranks - 1) * write) / (render + write);
    }

  private:
    using Clock = std::chrono::steady_clock;
    struct Counting {
        WorkTimes& times;
        Work& work;
        Clock::time_point begin = Clock::now();
        ~Counting() {
            const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
            const std::lock_guard lock(times.access_);
            work.seconds += seconds;
            ++work.layers;
        }
    };
    std::mutex access_;
};

/// On rank 0: plans turns and tells the others, some turns ahead, so that nobody waits for a plan.
/// Thread-safe.
class Turns {
  public:
    Turns(Ranks& ranks, LayerRange layers, WorkTimes& times)
        : ranks_(ranks), layers_(layers), times_(times) {}

    int owner_of(int layer) {
        const std::lock_guard lock(planning_);
        plan(layer);
        const auto behind = std::ranges::upper_bound(turns_, layer, {}, &Turn::first);
        return std::prev(behind)->owner_of(layer);
    }

  private:
    static constexpr std::ptrdiff_t turns_ahead = 2;

    void plan(int layer) {
        while (turns_.empty() || (next() < layers_.last && turns_left(layer) < turns_ahead)) {
            Turn turn{turns_.empty() ? layers_.first : next()};
            turn.own = share();
            for (int rank = 1; rank < ranks_.size(); ++rank) ranks_.send(rank, turn_tag, packed(turn));
            turns_.push_back(turn);
        }
    }
    int next() const { return turns_.back().end(ranks_.size()); }
    /// Turns that begin behind a layer.
    std::ptrdiff_t turns_left(int layer) const {
        return turns_.end() - std::ranges::upper_bound(turns_, layer, {}, &Turn::first);
    }
    int share() {
        const double fair = times_.fair_share(ranks_.size()).value_or(layers_in_a_block);
        // Parts of layers are made up for by later turns.
        const double wanted = std::max(fair, 0.0) + owed_;
        const int own = std::max(static_cast<int>(wanted), ranks_.size() == 1 ? 1 : 0);
        owed_ = wanted - own;
        return own;
    }

    Ranks& ranks_;
    LayerRange layers_;
    std::mutex planning_;
    std::vector<Turn> turns_;  // all of them: eight bytes for a block and more
    WorkTimes& times_;
    double owed_ = 0;  // of a layer
};

/// What rank 0 tells all.
struct Beginning {
    int first = 0;         ///< layer that is still missing
    std::string identity;  ///< the job's
};

std::string packed(Beginning beginning) {
    Parcel parcel;
    parcel(beginning.first, beginning.identity);
    return parcel.bytes();
}

Beginning unpacked(std::string bytes) {
    Parcel parcel(std::move(bytes));
    Beginning beginning;
    parcel(beginning.first, beginning.identity);
    parcel.finish();
    return beginning;
}

/// Outputs that tell all ranks where to begin once they know it.
class Announcing : public Backend {
  public:
    Announcing(Ranks& ranks, std::unique_ptr<Backend> outputs, const CancelToken* cancel)
        : ranks_(ranks), outputs_(std::move(outputs)), cancel_(cancel) {}

    int begin(const Job& job, LayerRange range, bool resume) override {
        fetching_ = make_fetching(std::move(outputs_), [this](int layer) { return fetch(layer); });
        const int first = fetching_->begin(job, range, resume);
        for (int rank = 1; rank < ranks_.size(); ++rank)
            ranks_.send(rank, begin_tag, packed({first, job.identity}));
        turns_.emplace(ranks_, LayerRange{first, range.last}, times_);
        return first;
    }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        if (turns_->owner_of(layer.index()) > 0) return fetching_->render(layer);
        return times_.take(times_.rendering, [&] { return fetching_->render(layer); });
    }
    void write(const Layer& layer, LayerProduct& product) override {
        times_.take(times_.writing, [&] { fetching_->write(layer, product); });
    }
    void end() override { fetching_->end(); }
    std::vector<std::string> notes() const override { return fetching_->notes(); }

  private:
    std::optional<std::string> fetch(int layer) {
        const int owner = turns_->owner_of(layer);
        if (owner == 0) return std::nullopt;
        return *wait_for(
            [&] {
                throw_failure(ranks_);
                return ranks_.receive(owner, tag_of(layer));
            },
            cancel_);
    }

    Ranks& ranks_;
    std::unique_ptr<Backend> outputs_, fetching_;
    const CancelToken* cancel_;
    mutable WorkTimes times_;
    mutable std::optional<Turns> turns_;
};

}  // namespace

StreamReport spread_layers(Ranks& ranks, const Job& job, std::unique_ptr<Backend>& outputs,
                           const StreamOptions& options) {
    outputs = std::make_unique<Announcing>(ranks, std::move(outputs), options.cancel);
    return stream_layers(job, *outputs, options);
}

void render_blocks(Ranks& ranks, const Job& job, std::unique_ptr<Backend> renderer,
                   const StreamOptions& options) {
    tell_failures(ranks, [&] {
        const auto told = wait_for([&] { return ranks.receive(0, begin_tag); }, options.cancel);
        const Beginning beginning = unpacked(*told);
        if (beginning.identity != job.identity)
            throw InputError(
                "its job is another than that of rank 0; accepted: the same recipe and files for all");
        const auto send = [&](int layer, std::string bytes) {
            wait_for([&] { return ranks.outstanding() < blocks_ahead * layers_in_a_block; }, options.cancel);
            ranks.send(0, tag_of(layer), std::move(bytes));
        };
        const auto sending = make_sending(std::move(renderer), options.range, send);
        for (int next = beginning.first; next < options.range.last;) {
            const Turn turn =
                unpacked_turn(*wait_for([&] { return ranks.receive(0, turn_tag); }, options.cancel));
            next = turn.end(ranks.size());
            StreamOptions mine = options;
            mine.range = turn.block_of(ranks.rank());
            mine.range.last = std::min(mine.range.last, options.range.last);
            mine.resume = false;
            if (mine.range.first < mine.range.last) stream_layers(job, *sending, mine);
        }
    });
}

}  // namespace lamella
