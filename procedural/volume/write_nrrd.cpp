// A text header and raw samples.
#include "procedural/volume/write_nrrd.h"

#include <fmt/format.h>

#include <bit>
#include <string>

#include "engine/base/complete_file.h"
#include "engine/base/error.h"

namespace lamella {

void write_nrrd(const std::filesystem::path& file, const std::array<std::size_t, 3>& size,
                std::span<const float> samples, const Box& box) {
    if (samples.size() != size[0] * size[1] * size[2])
        throw FaultError(file.string() + ": a volume has not as many samples as its sides say");
    dvec3 spacing;
    for (int k = 0; k < 3; ++k)
        spacing[k] = box.size()[k] / static_cast<double>(size[static_cast<std::size_t>(k)]);
    const dvec3 first = box.lo + 0.5 * spacing;
    const std::string header = fmt::format(
        "NRRD0004\ntype: float\ndimension: 3\nspace dimension: 3\nsizes: {} {} {}\n"
        "space directions: ({},0,0) (0,{},0) (0,0,{})\nspace origin: ({},{},{})\nkinds: domain domain "
        "domain\n"
        "endian: little\nencoding: raw\n\n",
        size[0], size[1], size[2], spacing.x, spacing.y, spacing.z, first.x, first.y, first.z);
    static_assert(std::endian::native == std::endian::little, "samples are written as they lie in memory");
    write_complete_file(file, [&](std::ostream& out) {
        out << header;
        out.write(reinterpret_cast<const char*>(samples.data()),
                  static_cast<std::streamsize>(samples.size() * sizeof(float)));
    });
}

}  // namespace lamella
