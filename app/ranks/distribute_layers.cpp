// Rank 0 announces turn by turn which rank renders which layers; the others send theirs.
#include "app/ranks/distribute_layers.h"

#include <algorithm>
#include <optional>

#include "app/ranks/layer_schedule.h"
#include "app/ranks/rank_failure.h"
#include "app/ranks/wait_for.h"
#include "engine/base/error.h"
#include "printers/common/carried_layers.h"

namespace lamella {
namespace {

constexpr std::size_t blocks_ahead = 2;  ///< blocks sent but not yet received

/// MPI guarantees tags up to 32767 only; layers in transit at the same time are much closer to each other.
int tag_of(int layer) { return first_layer_tag + layer % 32000; }

/// The announcement of rank 0 to all others.
struct Beginning {
    int first = 0;         ///< first missing layer
    std::string identity;  ///< the job's

    void serialize(Archive& parcel) { parcel(first, identity); }
};

/// A back-end that announces the first layer to all ranks and writes layers of any rank.
class Announcing : public Backend {
  public:
    Announcing(Ranks& ranks, std::unique_ptr<Backend> outputs, const CancelToken* cancel)
        : ranks_(ranks), outputs_(std::move(outputs)), cancel_(cancel) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        fetching_ = make_fetching(std::move(outputs_), [this](int layer) { return fetch(layer); });
        const int first = fetching_->open(job, range, resume);
        for (int rank = 1; rank < ranks_.size(); ++rank)
            ranks_.send(rank, begin_tag, packed(Beginning{first, job.identity}));
        turns_.emplace(ranks_.size(), LayerRange{first, range.last}, times_, [this](Turn turn) {
            for (int rank = 1; rank < ranks_.size(); ++rank) ranks_.send(rank, turn_tag, packed(turn));
        });
        return first;
    }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        if (turns_->owner_of(layer.index()) > 0) return fetching_->render(layer);
        return times_.rendering.measure([&] { return fetching_->render(layer); });
    }
    void write(const Layer& layer, LayerProduct& product) override {
        times_.writing.measure([&] { fetching_->write(layer, product); });
    }
    void finish() override { fetching_->finish(); }
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
    mutable std::optional<LayerSchedule> turns_;
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
        const auto beginning = unpacked<Beginning>(*told);
        if (beginning.identity != job.identity)
            throw InputError(
                "its job differs from that of rank 0; accepted: the same recipe and files for all ranks");
        const auto send = [&](int layer, std::string bytes) {
            wait_for([&] { return ranks.outstanding() < blocks_ahead * layers_in_a_block; }, options.cancel);
            ranks.send(0, tag_of(layer), std::move(bytes));
        };
        const auto sending = make_sending(std::move(renderer), options.range, send);
        for (int next = beginning.first; next < options.range.last;) {
            const auto turn =
                unpacked<Turn>(*wait_for([&] { return ranks.receive(0, turn_tag); }, options.cancel));
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
