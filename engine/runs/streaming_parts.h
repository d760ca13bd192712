// Parts of a solid whose layers stream by, under numbers that others may keep.
#pragma once

#include <unordered_map>
#include <vector>

#include "engine/runs/run_components.h"

namespace lamella {

/// Joins labelled layers to parts as RunComponents does without growth, and knows of each part no more than
/// how large it is. Memory: the runs of one layer, and a record for each part until it is forgotten.
class StreamingParts {
  public:
    /// Adds the next layer, labelled without growth; its components become numbers of parts.
    const LabelledLayer& add(LabelledLayer layer);
    /// The number under which a part goes now.
    std::uint32_t find(std::uint32_t number);
    /// The length of all of a part's runs, in run units.
    std::int64_t length(std::uint32_t number) { return records_.at(find(number)).length; }

    /// Records at the moment.
    std::size_t size() const { return records_.size(); }
    /// Forgets all numbers but those of the last layer and `used` ones.
    void forget_all_but(std::vector<std::uint32_t> used);

  private:
    struct Record {
        std::uint32_t parent;
        std::int64_t length;  // of a part that goes by its own number
    };
    void join(std::uint32_t a, std::uint32_t b);

    std::unordered_map<std::uint32_t, Record> records_;
    std::uint32_t next_ = 0;
    LabelledLayer last_;
};

}  // namespace lamella
