// Back-ends that cut: layers planned as paths and laid out on sheets, in files of any vector format.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"
#include "printers/vector/sheet.h"

namespace lamella {

/// How a kind of file says what is on sheets. Pure.
class SheetFormat {
  public:
    virtual ~SheetFormat() = default;
    /// With the dot.
    virtual std::string extension() const = 0;
    /// What stands before the sheets of a file, all of this size (mm); a sheet; and what ends the file.
    virtual std::string start(dvec2 size) const = 0;
    virtual std::string content(const Sheet& sheet) const = 0;
    virtual std::string end() const = 0;

    std::string file(const Sheet& sheet) const { return start(sheet.size) + content(sheet) + end(); }
};

/// Whether a profile asks for more than plain contours.
bool asks_for_cutting(const PrinterProfile& profile);

/// One sheet a layer: a folder with PATH/00000.svg and so on, all of the part's size and a margin, or one
/// file with a group a layer.
std::unique_ptr<Backend> make_layer_sheets(const PrinterProfile& profile,
                                           const std::shared_ptr<const SheetFormat>& format,
                                           const std::string& path, bool force);

/// Several layers a sheet, in their order, on sheets of CuttingProfile::sheet: PATH/sheet_001.svg and so on,
/// each written when it is full. Of a range of layers, sheets begin with its first one.
std::unique_ptr<Backend> make_nested_sheets(const PrinterProfile& profile,
                                            const std::shared_ptr<const SheetFormat>& format,
                                            const std::string& path, bool force);

}  // namespace lamella
