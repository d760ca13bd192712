// The lattice of a layer: where row runs and column runs cross the edges of a square grid, made to agree at
// its nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// Square cells in a layer's plane. Node (i, j) lies at origin + (i, j) * pitch, 0 <= i <= columns, 0 <= j <=
/// rows.
struct Grid {
    dvec2 origin{0};  ///< mm
    dvec2 pitch{1};   ///< mm
    int columns = 0;  ///< cells
    int rows = 0;     ///< cells
};

/// A crossing of the solid's border with a lattice edge; 1/256 of the pitch from node (0, 0). Crossings never
/// lie on nodes.
struct Crossing {
    std::int32_t x;
    std::int32_t y;
};

/// The crossings of a slice with the edges of a grid. A node is solid iff its row run says so; column runs
/// that disagree are mended at the node, so round every cell the number of crossings is even. Outside the
/// grid all is void.
class Lattice {
  public:
    Lattice(const SliceField& slice, const Grid& grid, Scratch& scratch);

    const Grid& grid() const { return grid_; }
    std::span<const Crossing> crossings() const { return crossings_; }
    /// Crossings below this number lie on rows (row by row, by x), the others on columns (cell row by cell
    /// row, by column, by y).
    std::uint32_t row_crossings() const { return row_starts_.back(); }
    /// First crossing of lattice row j.
    std::uint32_t row_start(int j) const { return row_starts_[static_cast<std::size_t>(j)]; }
    /// Number of the last row crossing before node (i, j) on its row, or -1.
    std::int64_t before_node(int i, int j) const;
    bool solid(int i, int j) const;

    /// The border of one cell: its crossings counter-clockwise from its lower left node.
    struct Cell {
        int i;
        int j;
        bool solid;                             ///< status of the lower left node
        std::span<const std::uint32_t> border;  ///< crossing numbers
        std::span<const std::uint8_t> side;     ///< of each: 0 bottom, 1 right, 2 top, 3 left
        bool connect;  ///< solid arcs belong together (else each is cut off by a chord of its own)

        /// Whether the border turns from solid to void at its k-th crossing.
        bool leaves_solid(std::size_t k) const { return (k % 2 == 0) == solid; }
        /// Where the chord that leaves the k-th crossing (one that leaves the solid) ends; the solid is on
        /// its left.
        std::size_t chord_end(std::size_t k) const {
            return connect ? (k + 1) % border.size() : (k + border.size() - 1) % border.size();
        }
    };

    /// Calls visit(cell) for every cell of row j that has crossings, by ascending i.
    template <typename Visit>
    void visit_cells(int j, Visit visit) const {
        Walker walker(*this, j);
        while (walker.next()) visit(walker.cell());
    }

  private:
    class Walker {
      public:
        Walker(const Lattice& lattice, int j);
        bool next();
        const Cell& cell() const { return cell_; }

      private:
        void add_side(std::uint32_t from, std::uint32_t to, std::uint8_t side);
        bool joins() const;

        const Lattice& lattice_;
        std::uint32_t bottom_, bottom_end_, top_, top_end_, column_, column_end_, row_start_;
        std::vector<std::uint32_t> border_;
        std::vector<std::uint8_t> side_;
        Cell cell_{};
    };

    void add_rows(const SliceField& slice, Scratch& scratch);
    void add_columns(const SliceField& slice, Scratch& scratch);
    bool mend_columns(std::vector<std::vector<std::int32_t>>& columns) const;
    void bucket_columns(const std::vector<std::vector<std::int32_t>>& columns);

    Grid grid_;
    std::vector<Crossing> crossings_;
    std::vector<std::uint32_t> row_starts_;     ///< first crossing of each lattice row, rows + 2 of them
    std::vector<std::uint32_t> column_starts_;  ///< first column crossing of each cell row, rows + 1 of them
};

}  // namespace lamella
