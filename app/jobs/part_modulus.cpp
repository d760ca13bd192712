// Samples the modulus of the foam.
#include "app/jobs/part_modulus.h"

#include <nlohmann/json.hpp>

#include "app/jobs/part_samples.h"
#include "app/reports/modulus_paint.h"

namespace lamella {

std::string modulus_volume(const ServedJob& job, int longest, const PassControl& control) {
    const auto code_at = modulus_codes(job.built, "modulus");
    const ModulusReport& report = *job.built.modulus;
    const auto sample = [&](dvec3 place, std::span<std::uint8_t> bytes) { bytes[0] = code_at(place); };
    return part_samples(
        job, longest, {1, [&](const VoxelBrick&) -> PlaceBytes { return sample; }},
        {{"scale",
          {{"lo_mpa", report.predicted.lo}, {"hi_mpa", report.predicted.hi}, {"is_asked", report.is_asked}}}},
        control);
}

}  // namespace lamella
