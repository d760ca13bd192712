// Order of execution on a sheet.
#include "printers/vector/sheet.h"

#include <algorithm>

namespace lamella {

void order_by_purpose(std::vector<SheetPath>& paths) {
    std::ranges::stable_sort(paths,
                             [](const SheetPath& a, const SheetPath& b) { return a.purpose < b.purpose; });
}

}  // namespace lamella
