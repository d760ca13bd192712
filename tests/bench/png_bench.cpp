// The plate's layer to a PNG in memory: straight from runs, and through pixels and OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <benchmark/benchmark.h>

#include "engine/field/slice_context.h"
#include "printers/masks/png_writer.h"
#include "tests/bench/plate.h"

namespace {

using namespace lamella;

void png_spans_8k(benchmark::State& state) {
    const std::vector<GreyRun> grey = bench::plate_grey(4);
    std::size_t bytes = 0;
    for (auto _ : state) bytes = encode_png({bench::plate_width, bench::plate_height}, grey).size();
    state.counters["bytes"] = static_cast<double>(bytes);
    state.counters["grey_runs"] = static_cast<double>(grey.size());
}
BENCHMARK(png_spans_8k)->Unit(benchmark::kMillisecond);

void png_oiio_8k(benchmark::State& state) {
    std::vector<std::uint8_t> pixels;
    for (const GreyRun& run : bench::plate_grey(4))
        pixels.insert(pixels.end(), run.length, static_cast<std::uint8_t>(run.value));
    std::size_t bytes = 0;
    for (auto _ : state) {
        std::vector<unsigned char> file;
        OIIO::Filesystem::IOVecOutput memory(file);
        OIIO::ImageSpec spec(bench::plate_width, bench::plate_height, 1, OIIO::TypeDesc::UINT8);
        spec.attribute("compression", "rle");
        spec.attribute("png:compressionLevel", 1);
        spec.attribute("png:filter", 0x08);  // PNG_FILTER_NONE
        const auto output = OIIO::ImageOutput::create("png", &memory);
        if (!output || !output->open("memory.png", spec) ||
            !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !output->close()) {
            state.SkipWithError("OpenImageIO could not write the image");
        }
        bytes = file.size();
    }
    state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(png_oiio_8k)->Unit(benchmark::kMillisecond);

}  // namespace
