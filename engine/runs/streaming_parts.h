// StreamingParts: connected parts of a solid whose layers stream by, with numbers that callers may keep.
#pragma once

#include <unordered_map>
#include <vector>

#include "engine/runs/run_components.h"

namespace lamella {

/// Joins labelled layers into parts like RunComponents without growth, but knows only the size of each part.
/// Memory: the runs of one layer, and a record for each part until it is forgotten.
class StreamingParts {
  public:
    /// Adds the next layer, labelled without growth, and returns it relabelled with part numbers.
    const LabelledLayer& add(LabelledLayer layer);
    /// Returns the current number of a part.
    std::uint32_t find(std::uint32_t number);
    /// Returns the length of all of a part's runs, in run units.
    std::int64_t length(std::uint32_t number) { return records_.at(find(number)).length; }

    /// Returns the number of records held.
    std::size_t size() const { return records_.size(); }
    /// Forgets all numbers except those of the last layer and the `used` ones.
    void forget_all_but(std::vector<std::uint32_t> used);

  private:
    struct Record {
        std::uint32_t parent;
        std::int64_t length;  // valid for a representative
    };
    void join(std::uint32_t a, std::uint32_t b);

    std::unordered_map<std::uint32_t, Record> records_;
    std::uint32_t next_ = 0;
    LabelledLayer last_;
};

}  // namespace lamella
