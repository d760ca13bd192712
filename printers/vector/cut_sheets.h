// Back-ends for cutters: plan layers as paths and lay them out on sheets, in any vector format.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"
#include "printers/vector/sheet.h"

namespace lamella {

/// A file format for sheets. Pure.
class SheetFormat {
  public:
    virtual ~SheetFormat() = default;
    /// Returns the file name extension, with the dot.
    virtual std::string extension() const = 0;
    /// Return the text before the sheets of a file, which all have `size` (mm); the text of a sheet; and the
    /// end of the file.
    virtual std::string start(dvec2 size) const = 0;
    virtual std::string content(const Sheet& sheet) const = 0;
    virtual std::string end() const = 0;

    std::string file(const Sheet& sheet) const { return start(sheet.size) + content(sheet) + end(); }
};

/// Returns true if a profile needs more than plain contours.
bool asks_for_cutting(const PrinterProfile& profile);

/// Makes a back-end with one sheet per layer. It writes a folder with PATH/00000.svg and so on, all with the
/// part's size plus a margin, or one file with a group per layer.
std::unique_ptr<Backend> make_layer_sheets(const PrinterProfile& profile,
                                           const std::shared_ptr<const SheetFormat>& format,
                                           const std::string& path, bool force);

/// Makes a back-end with several layers per sheet, in order, on sheets of CuttingProfile::sheet. It writes
/// PATH/sheet_001.svg and so on, each when it is full. For a range of layers the first sheet begins with the
/// range's first layer.
std::unique_ptr<Backend> make_nested_sheets(const PrinterProfile& profile,
                                            const std::shared_ptr<const SheetFormat>& format,
                                            const std::string& path, bool force);

}  // namespace lamella
