// InscribedDisc: how large a disc fits into a piece.
#pragma once

#include <optional>

#include "printers/polygons/polygons.h"

namespace lamella {

/// The largest disc in a connected piece with its holes, which must outlive it.
class InscribedDisc {
  public:
    explicit InscribedDisc(const Polygons& piece);

    /// Returns whether a disc of this radius (mm, > 0) fits into the piece.
    bool fits(double radius) const;

  private:
    const Polygons& piece_;
    std::optional<double> greatest_;  ///< mm; nothing: the piece's axis is too long to be traced
};

}  // namespace lamella
