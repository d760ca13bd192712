// Who renders what is known to all: nothing is said but where to begin, and the layers.
#include "app/spread_layers.h"

#include <algorithm>

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

int owner_of(int layer, int first, int ranks) { return (layer - first) / layers_in_a_block % ranks; }

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

/// Layers as they come from the other ranks.
class FromRanks {
  public:
    FromRanks(Ranks& ranks, int first, const CancelToken* cancel)
        : ranks_(ranks), first_(first), cancel_(cancel) {}

    std::optional<std::string> operator()(int layer) const {
        const int owner = owner_of(layer, first_, ranks_.size());
        if (owner == 0) return std::nullopt;
        return *wait_for(
            [&] {
                throw_failure(ranks_);
                return ranks_.receive(owner, tag_of(layer));
            },
            cancel_);
    }

  private:
    Ranks& ranks_;
    int first_;
    const CancelToken* cancel_;
};

/// Outputs that tell all ranks where to begin once they know it.
class Announcing : public Backend {
  public:
    Announcing(Ranks& ranks, std::unique_ptr<Backend> outputs, const CancelToken* cancel)
        : ranks_(ranks), outputs_(std::move(outputs)), cancel_(cancel) {}

    int begin(const Job& job, LayerRange range, bool resume) override {
        const auto fetch = [this](int layer) { return (*from_)(layer); };
        fetching_ = make_fetching(std::move(outputs_), fetch);
        const int first = fetching_->begin(job, range, resume);
        from_.emplace(ranks_, first, cancel_);
        for (int rank = 1; rank < ranks_.size(); ++rank)
            ranks_.send(rank, begin_tag, packed({first, job.identity}));
        return first;
    }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        return fetching_->render(layer);
    }
    void write(const Layer& layer, LayerProduct& product) override { fetching_->write(layer, product); }
    void end() override { fetching_->end(); }
    std::vector<std::string> notes() const override { return fetching_->notes(); }

  private:
    Ranks& ranks_;
    std::unique_ptr<Backend> outputs_, fetching_;
    std::optional<FromRanks> from_;
    const CancelToken* cancel_;
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
        const int stride = layers_in_a_block * ranks.size();
        for (int block = beginning.first + layers_in_a_block * ranks.rank(); block < options.range.last;
             block += stride) {
            StreamOptions mine = options;
            mine.range = {block, std::min(block + layers_in_a_block, options.range.last)};
            mine.resume = false;
            stream_layers(job, *sending, mine);
        }
    });
}

}  // namespace lamella
