// Numbering of the nodes.
#include "procedural/elasticity/elastic_grid.h"

namespace lamella {

ElasticGrid::ElasticGrid(const ElementMask& elements) : size_(elements.size) {
    numbers_.assign(elements.present.size(), -1);
    for (int z = 0; z < size_.z; ++z) {
        for (int y = 0; y < size_.y; ++y) {
            for (int x = 0; x < size_.x; ++x) {
                std::uint8_t about = 0;
                for (unsigned e = 0; e < hex_nodes; ++e) {
                    const int i = wrapped(x - static_cast<int>(e & 1), size_.x),
                              j = wrapped(y - static_cast<int>(e >> 1 & 1), size_.y),
                              k = wrapped(z - static_cast<int>(e >> 2 & 1), size_.z);
                    if (elements.at(i, j, k)) about = static_cast<std::uint8_t>(about | 1U << e);
                }
                if (about == 0) continue;
                numbers_[index(x, y, z)] = static_cast<std::int32_t>(places_.size());
                places_.emplace_back(x, y, z);
                elements_.push_back(about);
            }
        }
    }
}

std::array<std::int32_t, hex_neighbours> ElasticGrid::neighbours(std::size_t node) const {
    const glm::ivec3 at = place(node);
    const std::array<int, 3> x{wrapped(at.x - 1, size_.x), at.x, wrapped(at.x + 1, size_.x)};
    std::array<std::int32_t, hex_neighbours> found;
    std::size_t k = 0;
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            const std::size_t row = index(0, wrapped(at.y + dy, size_.y), wrapped(at.z + dz, size_.z));
            for (const int i : x) found[k++] = numbers_[row + static_cast<std::size_t>(i)];
        }
    }
    return found;
}

}  // namespace lamella
