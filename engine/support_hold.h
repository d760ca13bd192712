// What supports hold of the layers above them.
#pragma once

#include <deque>

#include "engine/fault_list.h"

namespace lamella {

/// Follows supports upward: a place is held where it lies within `spacing` of a support, at its height or
/// above, as the overhang survey places them. Memory: the layers within that distance, of which only places
/// where supports end are kept.
class SupportHold {
  public:
    /// Lengths in mm; `gap` is the height that may lie between a support and what it holds.
    SupportHold(const CheckGrid& grid, double spacing, double gap);

    /// What the supports so far hold of the next layer.
    SpanRows held() const;
    /// The supports of the next layer.
    void add(const SpanRows& supports);

  private:
    CheckGrid grid_;
    double spacing_, gap_;
    std::size_t layers_;         // below the last one, from which something may be held
    SpanRows last_;              // of the last layer
    std::deque<SpanRows> tops_;  // of layers below it, what the next one has not; newest last
};

}  // namespace lamella
