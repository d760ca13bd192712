// PatchMatch: for each window of a target image, the most similar window of an exemplar.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "procedural/appearance/grey_image.h"
#include "procedural/appearance/window_difference.h"

namespace lamella {

struct MatchSettings {
    int neighbourhood = 14;          ///< width N of the square windows, px
    double exponent = 1.2;           ///< q of the difference |d|^q, 1 to 2
    std::optional<double> spread{};  ///< weight lambda of the uniformity term; 0.1 N^2 when not given
    std::uint64_t seed = 1;
};

/// The lower left pixel of an exemplar's window; negative for windows of the target that have no match.
struct ExemplarPlace {
    std::int16_t x = -1, y = -1;
    bool operator==(const ExemplarPlace&) const = default;
};

/// What sweeps need to go on: plain data.
struct MatchState {
    std::uint64_t sweeps = 0;  ///< made so far
    std::vector<ExemplarPlace>
        matches;              ///< of all windows, see PatchMatch::matches(); empty before the first
    std::vector<double> use;  ///< by window of the exemplar: sum of Omega, its mean over sweeps
};

/// Matches of all windows of N x N pixels that lie inside the target, at every offset. Windows of passive
/// pixels only have none. The search is PatchMatch (Barnes, Shechtman, Finkelstein, Goldman 2009, section 3)
/// in Jacobi form: a sweep reads what the sweep before left, so it gives the same matches on any number of
/// threads. Candidates are the matches of the windows 8, 4, 2 and 1 pixels to the left, right, below and
/// above, shifted back (jump flooding), then random places about the best of them, in ranges halved from the
/// exemplar's size. The lowest cost wins; of equal costs, that at the lower pixel of the exemplar, row by
/// row.
///
/// The cost of a match m is sum over the window of |T - S|^q, plus lambda omega(m) / omega_best: Omega(s) is
/// how many matches cover the pixel s of the exemplar, omega its mean over the window, and omega_best its
/// mean over the exemplar (uniformity after Kaspar, Neubert, Lischinski, Pauly, Kopf 2015). As all windows
/// move at once, they would leave crowded places together and crowd others: Omega is counted anew in each
/// sweep, and the cost uses its running mean, to which the newest adds a sixteenth, or less for a spread
/// above 0.32 N^2. Images are rounded to bytes for all this, and |d|^q to the line of WindowDifference.
class PatchMatch {
  public:
    /// `width` and `height` are the target's size, px. `passive` marks the pixels that cannot change, by a
    /// number other than 0; empty if all can. `level` distinguishes the random numbers of several grids.
    /// Matches are random at first. Throws InputError for settings out of range, an exemplar or a target
    /// smaller than a window, an exemplar of more than 1024 pixels across or high, and for a target that is
    /// all passive.
    PatchMatch(const GreyImage& exemplar, int width, int height, const MatchSettings& settings, int level = 0,
               std::span<const std::uint8_t> passive = {});

    /// Improves the matches with a target of `width` x `height` values in [0, 1] by a number of sweeps.
    /// Throws FaultError for a target of another size.
    void sweep(std::span<const double> target, int sweeps);

    MatchState state() const { return {sweeps_, matches_, use_}; }
    /// Goes on where another object was; without matches, begins anew. Throws InputError for a state that
    /// does not fit.
    void set_state(MatchState state);

    const MatchSettings& settings() const { return settings_; }
    int neighbourhood() const { return size_; }
    double spread() const { return spread_; }
    int width() const { return width_; }    ///< of the target, px
    int height() const { return height_; }  ///< of the target, px
    /// Matches row by row, of as many windows as lie inside the target. window = y * windows_across() + x.
    std::span<const ExemplarPlace> matches() const { return matches_; }
    int windows_across() const { return width_ - size_ + 1; }
    int windows_high() const { return height_ - size_ + 1; }
    std::uint64_t sweeps() const { return sweeps_; }        ///< made so far
    std::size_t active_windows() const { return active_; }  ///< those that have a match

    /// The exemplar in bytes, the lowest row first.
    std::span<const std::uint8_t> exemplar() const { return exemplar_; }
    int exemplar_width() const { return exemplar_width_; }
    int exemplar_height() const { return exemplar_height_; }
    const WindowDifference& difference() const { return difference_; }
    /// Returns Omega of each pixel of the exemplar: how many matches cover it.
    std::vector<std::int64_t> occurrence() const;

  private:
    struct Window;
    // Windows of the exemplar.
    int last_x() const { return exemplar_width_ - size_; }
    int last_y() const { return exemplar_height_ - size_; }
    std::size_t columns() const { return static_cast<std::size_t>(last_x()) + 1; }
    std::size_t rows() const { return static_cast<std::size_t>(last_y()) + 1; }
    std::size_t site(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(windows_across()) +
               static_cast<std::size_t>(x);
    }
    void mark_active(std::span<const std::uint8_t> passive);
    void begin_randomly();
    void average_use();
    ExemplarPlace improved(int x, int y, Window& window) const;
    void consider_neighbour(int x, int y, int dx, int dy, Window& window) const;
    void consider_random(std::size_t at, Window& window) const;
    void compare(Window& window) const;

    MatchSettings settings_;
    int width_, height_, exemplar_width_, exemplar_height_, level_;
    WindowDifference difference_;
    int size_;
    double spread_;
    std::uint64_t sweeps_ = 0;  // made so far: random numbers go on
    std::size_t active_ = 0;
    double use_weight_ = 0;  // of the sum of Omega over a window, steps of the difference
    std::vector<std::uint8_t> exemplar_, exemplar_rows_, target_;
    std::vector<ExemplarPlace> matches_, next_;
    std::vector<double> use_;  // sum of Omega over each window of the exemplar, its mean over sweeps
};

}  // namespace lamella
