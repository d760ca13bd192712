// Extrapolates from the layers that are known.
#include "printers/serial/print_progress.h"

#include <algorithm>

namespace lamella {
namespace {

constexpr double pace_prior =
    120;  // s of model time after which the measured pace weighs as much as the model

}  // namespace

std::optional<double> PrintProgress::total() const {
    if (seconds_ahead) return std::max(*seconds_ahead, done_seconds);
    const int unknown = std::max(0, layers - layers_before - layers_known);
    if (layers_known == 0 && unknown > 0) return std::nullopt;
    const double mean = layers_known > 0 ? layers_seconds / layers_known : 0;
    return std::max(known_seconds + unknown * mean, done_seconds);
}

std::optional<double> PrintProgress::left() const {
    const auto all = total();
    if (!all) return std::nullopt;
    const double pace = (printing + pace_prior) / (done_seconds + pace_prior);
    return (*all - done_seconds) * pace;
}

std::optional<double> PrintProgress::share() const {
    const auto all = total();
    if (!all) return std::nullopt;
    const double mean = layers_known > 0 ? layers_seconds / layers_known : 0;
    const double before = seconds_before.value_or(layers_before * mean);
    if (before + *all <= 0) return std::nullopt;
    return (before + done_seconds) / (before + *all);
}

}  // namespace lamella
