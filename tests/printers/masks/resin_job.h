// A small job for the tests of resin printers' files, and what its masks are by another way.
#pragma once

#include <map>

#include "printers/masks/png_stack.h"
#include "printers/registry.h"
#include "recipe/machine_profiles.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/masks/decode_image.h"

namespace lamella::test {

/// A cone of discs with a smaller disc beside it in every second layer, so that all layers differ.
inline Job two_cones(int layers = 12) {
    Job job = make_job(
        {{-6, -6, 0}, {6, 6, layers * 0.5}},
        [](double z) {
            std::vector<Figure> figures{disc({-1.3, -0.2}, 4.2 / (1 + z * 0.3))};
            if (static_cast<int>(z / 0.5) % 2 == 0) figures.push_back(disc({4.6, 3.1}, 0.8));
            return figures;
        },
        0.5);
    job.name = "two cones";
    return job;
}

/// Settings of a back-end with a display that is small, but not an Ember's, which has one size.
inline PrinterProfile small_machine(const std::string& backend) {
    PrinterProfile profile = MachineProfiles().find(backend == "ember" ? "ember" : "prusa-sl1s")->printer;
    profile.backend = backend;
    if (backend == "ember") return profile;
    profile.image.width = 300;
    profile.image.height = 280;
    profile.resin.fade_layers = 3;
    return profile;
}

/// The layers of a job as another back-end, the stack of PNG files, makes them and OpenImageIO decodes them.
inline std::vector<DecodedImage> stack_of(const Job& job, const PrinterProfile& profile) {
    const TemporaryFolder folder;
    PrinterProfile plain = profile;
    plain.image.format = ImageFormat::png;
    run_layers(job, *make_png_stack(plain, folder / "stack", false), {0, job.layers.count()});
    std::vector<DecodedImage> images;
    for (int k = 0; k < job.layers.count(); ++k) {
        const std::string number = std::to_string(100000 + k).substr(1);
        images.push_back(decode_image(folder / ("stack/" + number + ".png")));
    }
    return images;
}

}  // namespace lamella::test
