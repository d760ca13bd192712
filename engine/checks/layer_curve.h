// LayerCurve: a figure of each layer, in bounded memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lamella {

/// A figure over the layers of a job, from the lowest on. Keeps at most `max_values`: neighbouring layers
/// share one, the greatest of theirs, once there are more layers.
class LayerCurve {
  public:
    static constexpr std::size_t max_values = 1024;

    /// Adds the figure of the next layer.
    void add(double value) {
        if (layers_in_last_ == layers_each_) {
            if (values_.size() == max_values) halve();
            values_.push_back(value);
            layers_in_last_ = 1;
            return;
        }
        values_.back() = std::max(values_.back(), value);
        ++layers_in_last_;
    }
    /// Number of layers that share a value; the last value may stand for fewer.
    int layers_each() const { return layers_each_; }
    const std::vector<double>& values() const { return values_; }

  private:
    void halve() {
        for (std::size_t i = 0; 2 * i < values_.size(); ++i)
            values_[i] = std::max(values_[2 * i], values_[2 * i + 1]);
        values_.resize(values_.size() / 2);
        layers_each_ *= 2;
    }

    int layers_each_ = 1;
    int layers_in_last_ = 1;  // of the last value, or of none
    std::vector<double> values_;
};

}  // namespace lamella
