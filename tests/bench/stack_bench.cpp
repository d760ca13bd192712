// A plate full of foam, streamed to an archive of 8K masks: layers a second, and memory.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <filesystem>

#include "engine/layers/layer_stream.h"
#include "printers/registry.h"
#include "tests/bench/plate.h"

namespace {

using namespace lamella;

constexpr int layers = 384;

Job plate_job() {
    Job job;
    job.name = "plate";
    job.part = make_voronoi_foam(bench::plate_foam());
    job.bounds = {{0, 0, 0}, {192, 108, 19.2}};
    job.layers = {layers, 0.05};
    job.identity = "stack_8k";
    return job;
}

double largest_resident_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

/// Masks with grey edges (4 lines a pixel row), or black and white. Memory means something only when this
/// benchmark runs alone.
void stack_8k(benchmark::State& state) {
    PrinterProfile printer;
    printer.backend = "sl1";
    printer.image.width = bench::plate_width;
    printer.image.height = bench::plate_height;
    printer.image.pixel_x = printer.image.pixel_y = bench::plate_pixel;
    printer.image.antialiasing = state.range(0) != 0 ? Antialiasing::rows : Antialiasing::off;
    const auto path = std::filesystem::temp_directory_path() / "lamella_stack_8k.sl1";
    for (auto _ : state) {
        const auto archive = make_backend(printer, path.string(), true);
        StreamOptions options;
        options.range = {0, layers};
        stream_layers(plate_job(), *archive, options);
    }
    state.counters["layers_per_s"] =
        benchmark::Counter(layers, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["archive_mb"] = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
    state.counters["resident_mb"] = largest_resident_mb();
    std::filesystem::remove(path);
}
BENCHMARK(stack_8k)
    ->Arg(0)
    ->Arg(1)
    ->ArgName("grey")
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
