// Union-find whose records can be removed.
#include "engine/runs/streaming_parts.h"

namespace lamella {

std::uint32_t StreamingParts::find(std::uint32_t number) {
    Record* record = &records_.at(number);
    while (record->parent != number) {
        Record& above = records_.at(record->parent);
        record->parent = above.parent;
        number = above.parent;
        record = &records_.at(number);
    }
    return number;
}

void StreamingParts::join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    const std::uint32_t low = std::min(a, b), high = std::max(a, b);
    Record& joined = records_.at(high);
    records_.at(low).length += joined.length;
    joined.parent = low;
}

const LabelledLayer& StreamingParts::add(LabelledLayer layer) {
    constexpr std::uint32_t none = UINT32_MAX;
    std::vector<std::uint32_t> numbers(layer.components.size(), none);
    for (int r = layer.first_row; r < layer.first_row + layer.rows(); ++r) {
        for (int near = r - 1; near <= r + 1; ++near) {
            for_touching(layer.row(r), last_.row(near),
                         [&](const LabelledRun& run, const LabelledRun& older) {
                             std::uint32_t& number = numbers[run.component];
                             if (number == none) {
                                 number = older.component;
                             } else if (number != older.component) {
                                 join(number, older.component);
                             }
                         });
        }
    }
    for (std::size_t c = 0; c < numbers.size(); ++c) {
        if (numbers[c] == none) {
            numbers[c] = next_++;
            records_[numbers[c]] = {numbers[c], 0};
        }
        numbers[c] = find(numbers[c]);
        records_.at(numbers[c]).length += layer.components[c].length;
    }
    // A component may have taken its number before another component of this layer joined its part to an
    // older one.
    for (std::uint32_t& number : numbers) number = find(number);
    for (LabelledRun& run : layer.runs) run.component = numbers[run.component];
    last_ = std::move(layer);
    return last_;
}

void StreamingParts::forget_all_but(std::vector<std::uint32_t> used) {
    for (const LabelledRun& run : last_.runs) used.push_back(run.component);
    std::unordered_map<std::uint32_t, Record> kept;
    for (const std::uint32_t number : used) {
        const std::uint32_t root = find(number);
        kept[root] = records_.at(root);
        if (number != root) kept[number] = {root, 0};
    }
    records_.swap(kept);
}

}  // namespace lamella
