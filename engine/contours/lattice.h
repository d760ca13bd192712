// Lattice: crossings of row runs and column runs with the edges of a square grid, made consistent at its
// nodes.
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

/// A crossing of the solid's border with a lattice edge, in 1/256 of the pitch from node (0, 0). Crossings
/// never lie on nodes.
struct Crossing {
    std::int32_t x;
    std::int32_t y;
};

/// The crossings of a slice with the edges of a grid. Row runs decide whether a node is solid; column runs
/// that disagree are changed near the node, so that every cell has an even number of crossings on its border.
/// Everything outside the grid is void.
class Lattice {
  public:
    Lattice(const SliceField& slice, const Grid& grid, Scratch& scratch);

    const Grid& grid() const { return grid_; }
    std::span<const Crossing> crossings() const { return crossings_; }
    /// Returns how many crossings lie on rows. These come first (row by row, by x); the others lie on columns
    /// (cell row by cell row, by column, by y).
    std::uint32_t row_crossings() const { return row_starts_.back(); }
    /// Returns the first crossing of lattice row j.
    std::uint32_t row_start(int j) const { return row_starts_[static_cast<std::size_t>(j)]; }
    /// Returns the last row crossing before node (i, j) on its row, or -1.
    std::int64_t before_node(int i, int j) const;
    bool solid(int i, int j) const;

    /// The border of one cell: its crossings counter-clockwise from its lower left node.
    struct Cell {
        int i;
        int j;
        bool solid;                             ///< whether the lower left node is solid
        std::span<const std::uint32_t> border;  ///< crossing numbers
        std::span<const std::uint8_t> side;     ///< of each crossing: 0 bottom, 1 right, 2 top, 3 left
        bool connect;                           ///< solid arcs are connected (else a chord cuts each off)

        /// Returns true if the border goes from solid to void at its k-th crossing (counter-clockwise).
        bool leaves_solid(std::size_t k) const { return (k % 2 == 0) == solid; }
        /// Returns the end of the chord that starts at the k-th crossing, one that leaves the solid; the
        /// solid is on the chord's left.
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
