// SvgSheetFormat: sheets as SVG, with strokes in a laser's colours and one Inkscape layer per sheet.
#pragma once

#include "printers/vector/cut_sheets.h"

namespace lamella {

/// Paths of one layer with the same purpose are one element, with an id such as "layer0042-cut-inner".
class SvgSheetFormat : public SheetFormat {
  public:
    explicit SvgSheetFormat(Laser laser) : laser_(laser) {}
    std::string extension() const override { return ".svg"; }
    std::string start(dvec2 size) const override;
    std::string content(const Sheet& sheet) const override;
    std::string end() const override;

  private:
    Laser laser_;
};

}  // namespace lamella
