// The stream: order, bounded look-ahead, cancellation, faults.
#include "engine/layers/layer_stream.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <mutex>
#include <thread>

#include "engine/base/error.h"
#include "engine/solids/primitives.h"

namespace layer_stream_test {

using namespace lamella;

namespace {

Job sphere_job(int layers) {
    Job job;
    job.part = make_sphere({0, 0, 5}, 5);
    job.bounds = job.part->bounds();
    job.layers = {layers, 10.0 / layers};
    return job;
}

class Recorder : public Backend {
  public:
    int open(const Job& /*job*/, LayerRange range, bool /*resume*/) override { return range.first + skip; }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        const int now = ++flying;
        int seen = most;
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
        if (layer.index() == fail_at) throw FaultError("the disk is full");
        auto product = std::make_unique<LayerProduct>();
        RunRows rows;
        layer.runs({Axis::x, -6, 0.1, -6, 0.1, 0, 120, 1, 0, 120}, rows);
        product->area = static_cast<double>(rows.total_length()) / run_unit * 0.01;
        return product;
    }
    void write(const Layer& layer, LayerProduct& product) override {
        --flying;
        order.push_back(layer.index());
        areas.push_back(product.area);
        if (cancel_at == layer.index()) token->cancel();
    }
    void finish() override { ended = true; }

    int skip = 0, fail_at = -1, cancel_at = -1;
    CancelToken* token = nullptr;
    mutable std::atomic<int> flying{0}, most{0};
    std::vector<int> order;
    std::vector<double> areas;
    bool ended = false;
};

}  // namespace

TEST_CASE("layers arrive in order, and their volume is the solid's") {
    const Job job = sphere_job(200);
    std::vector<double> first;
    for (const int threads : {1, 2, 4}) {
        Recorder recorder;
        StreamOptions options;
        options.range = {0, 200};
        options.threads = threads;
        options.look_ahead = 6;
        const StreamReport report = stream_layers(job, recorder, options);
        REQUIRE(recorder.ended);
        REQUIRE(report.layers_written == 200);
        REQUIRE(std::is_sorted(recorder.order.begin(), recorder.order.end()));
        REQUIRE(recorder.most <= 6);
        REQUIRE(report.volume == Approx(4.0 / 3 * 3.14159265 * 125).epsilon(0.002));
        if (first.empty()) first = recorder.areas;
        REQUIRE(recorder.areas == first);
    }
}

TEST_CASE("the volume of supports is counted apart") {
    class Areas : public Backend {
      public:
        int open(const Job& /*job*/, LayerRange range, bool /*resume*/) override { return range.first; }
        std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
            auto product = std::make_unique<LayerProduct>();
            product->area = 2;
            product->support_area = layer.index();
            return product;
        }
        void write(const Layer& /*layer*/, LayerProduct& /*product*/) override {}
        void finish() override {}
    };
    const Job job = sphere_job(40);  // of 0.25 mm
    Areas areas;
    StreamOptions options;
    options.range = {0, 40};
    double last = 0;
    options.on_progress = [&](const Progress& progress) { last = progress.support_volume; };
    const StreamReport report = stream_layers(job, areas, options);
    CHECK(report.volume == Approx(20));
    CHECK(report.support_volume == Approx(0.25 * 39 * 40 / 2));
    CHECK(last == report.support_volume);
}

TEST_CASE("a range gives just its layers, a resumed one what is missing") {
    const Job job = sphere_job(50);
    Recorder recorder;
    recorder.skip = 3;
    StreamOptions options;
    options.range = {10, 20};
    int calls = 0;
    options.on_progress = [&](const Progress& progress) {
        ++calls;
        REQUIRE(progress.total == 7);
        REQUIRE(progress.done == calls);
        REQUIRE(progress.layer == 12 + calls);
    };
    const StreamReport report = stream_layers(job, recorder, options);
    REQUIRE(recorder.order == std::vector<int>{13, 14, 15, 16, 17, 18, 19});
    REQUIRE(report.layers_kept == 3);
    options.range = {40, 51};
    REQUIRE_THROWS_AS(stream_layers(job, recorder, options), InputError);
}

TEST_CASE("cancelling stops soon, keeps the order and does not end the output") {
    const Job job = sphere_job(500);
    CancelToken token;
    Recorder recorder;
    recorder.cancel_at = 20;
    recorder.token = &token;
    StreamOptions options;
    options.range = {0, 500};
    options.look_ahead = 4;
    options.cancel = &token;
    REQUIRE_THROWS_AS(stream_layers(job, recorder, options), Interrupted);
    REQUIRE_FALSE(recorder.ended);
    REQUIRE(recorder.order.size() >= 21);
    REQUIRE(recorder.order.size() <= 21 + 4);
}

TEST_CASE("work on a layer that nobody waits for any more is left, and what is before it written") {
    /// Each layer from the 20th takes for ever, unless it looks whether it should stop.
    struct Endless : Recorder {
        std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
            if (layer.index() < 20) return Recorder::render(layer);
            if (layer.index() == 21) token->cancel();
            for (;;) stop_if_cancelled(layer.cancel());
        }
    };
    const Job job = sphere_job(500);
    CancelToken token;
    Endless endless;
    endless.token = &token;
    StreamOptions options;
    options.range = {0, 500};
    options.threads = 2;
    options.cancel = &token;
    REQUIRE_THROWS_WITH(stream_layers(job, endless, options), "stopped after 20 of 500 layers");
    CHECK(endless.order.size() == 20);
    CHECK_FALSE(endless.ended);
}

TEST_CASE("a back-end that stops by itself is heard") {
    struct Stopping : Recorder {
        std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
            if (layer.index() == 7) throw Interrupted("the door is open");
            return Recorder::render(layer);
        }
    };
    Stopping stopping;
    CancelToken token;
    StreamOptions options;
    options.range = {0, 60};
    options.cancel = &token;
    REQUIRE_THROWS_WITH(stream_layers(sphere_job(60), stopping, options), "the door is open");
    CHECK_FALSE(stopping.ended);
}

TEST_CASE("a fault in one layer reaches the caller, and the output is not ended") {
    const Job job = sphere_job(60);
    Recorder recorder;
    recorder.fail_at = 30;
    StreamOptions options;
    options.range = {0, 60};
    REQUIRE_THROWS_AS(stream_layers(job, recorder, options), FaultError);
    REQUIRE_FALSE(recorder.ended);
    REQUIRE(recorder.order.size() <= 30);
}

TEST_CASE("a part has the layers whose lowest cutting plane lies below its top") {
    REQUIRE(count_layers(10, 0.1) == 100);
    REQUIRE(count_layers(0.30000000000000004, 0.1) == 3);
    REQUIRE(count_layers(10.01, 0.1) == 100);
    REQUIRE(count_layers(10.06, 0.1) == 101);
    REQUIRE(count_layers(20, 0.306) == 65);
    REQUIRE(count_layers(20, 0.306, 0.125) == 66);  // the lowest of four planes
    REQUIRE(count_layers(0.01, 0.1) == 1);
    REQUIRE_THROWS_AS(count_layers(0, 0.1), InputError);
    REQUIRE_THROWS_AS(count_layers(10, 0), InputError);
    REQUIRE_THROWS_AS(count_layers(10, NAN), InputError);
    REQUIRE_THROWS_AS(count_layers(1e9, 1e-9), InputError);
}

}  // namespace layer_stream_test
