// Samples the elements of a design in cubes, with a margin of one around them.
#include "app/jobs/design_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/jobs/voxel_grid.h"
#include "procedural/volume/density_bricks.h"

namespace lamella {

namespace {

/// The densities of a design's elements, 0 outside the body.
class Elements {
  public:
    Elements(const SearchedDesign& design, bool is_foam) : design_(design), values_(design.densities()) {
        double sum = 0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < values_.size(); ++i) {
            if ((*design.use)[i] == ElementUse::outside) {
                values_[i] = 0;
                continue;
            }
            sum += values_[i];
            ++count;
        }
        if (!is_foam || !(sum > 0)) return;
        const double middle = sum / static_cast<double>(count);
        for (double& value : values_) value *= 0.5 / middle;
    }

    double at(dvec3 place) const {
        const dvec3 share = (place - design_.box.lo) / design_.box.size() * dvec3(design_.size);
        const glm::ivec3 element(glm::floor(share));
        if (glm::any(glm::lessThan(element, glm::ivec3(0))) ||
            glm::any(glm::greaterThanEqual(element, design_.size)))
            return 0;
        const auto x = static_cast<std::size_t>(design_.size.x), y = static_cast<std::size_t>(design_.size.y);
        return values_[static_cast<std::size_t>(element.x) +
                       x * (static_cast<std::size_t>(element.y) + y * static_cast<std::size_t>(element.z))];
    }

  private:
    const SearchedDesign& design_;
    std::vector<double> values_;
};

}  // namespace

std::string design_volume(const SearchedDesign& design, bool is_foam) {
    constexpr int longest = 126, margin = 1;
    const int elements = std::max({design.size.x, design.size.y, design.size.z});
    VoxelGrid grid = voxel_grid(design.box, std::min(elements, longest));
    grid.lo -= margin * grid.voxel;
    grid.size += 2 * margin;
    const Elements found(design, is_foam);
    std::string bytes = headed(grid_head(grid, 2));
    const std::size_t first = bytes.size();
    bytes.resize(first + 2 * grid.voxels());
    constexpr double off = 0.25;  // of a voxel: eight samples, so that finer elements count as well
    for (int z = 0; z < grid.size.z; ++z) {
        for (int y = 0; y < grid.size.y; ++y) {
            for (int x = 0; x < grid.size.x; ++x) {
                double sum = 0;
                for (const double dz : {-off, off})
                    for (const double dy : {-off, off})
                        for (const double dx : {-off, off})
                            sum += found.at(grid.middle({x, y, z}) + grid.voxel * dvec3(dx, dy, dz));
                bytes[first + 2 * grid.place({x, y, z})] =
                    static_cast<char>(std::lround(255 * std::clamp(sum / 8, 0.0, 1.0)));
            }
        }
    }
    return bytes;
}

std::string design_volume(const OptimizedPart& part, bool is_foam) {
    const DensityBricks& densities = *part.densities;
    const VoxelIndex& size = densities.size();
    const SearchedDesign design{
        {static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])},
        densities.box(),
        &part.use,
        [&] {
            const std::vector<float> dense = densities.dense();
            return std::vector<double>(dense.begin(), dense.end());
        }};
    return design_volume(design, is_foam);
}

}  // namespace lamella
