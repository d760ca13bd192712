// Overhang paths: a hanging stretch is left alone if it is short or a straight bridge; otherwise it gets
// support points.
#include "engine/surveys/overhang_paths.h"

#include <algorithm>

namespace lamella {
namespace {

class PathWalker {
  public:
    PathWalker(const PathQuestion& question, const OutlinePath& path, SupportPlacer& placer,
               PathFindings& found)
        : q_(question), path_(path), placer_(placer), found_(found) {}

    void walk() {
        hangs_.resize(path_.count);
        for (std::size_t k = 0; k < path_.count; ++k) hangs_[k] = hangs(k) ? 1 : 0;
        const auto hanging = std::count(hangs_.begin(), hangs_.end(), 1);
        if (hanging == 0) return;
        found_.hanging_length += static_cast<double>(hanging) * path_.step;
        std::size_t anchor = 0;
        while (anchor < path_.count && !held(anchor)) ++anchor;
        if (anchor == path_.count) return walk_free();
        for (std::size_t k = 1; k < path_.count; ++k) {
            if (held(anchor + k)) continue;
            std::size_t end = k + 1;
            while (end < path_.count && !held(anchor + end)) ++end;
            walk_stretch(anchor + k - 1, anchor + end);
            k = end;
        }
    }

  private:
    const OutlineSample& sample(std::size_t k) const {
        return q_.layer.samples[path_.first + k % path_.count];
    }
    dvec3 bead(std::size_t k) const { return {q_.layer.bead(sample(k), q_.by.width), q_.z}; }

    bool enforced(std::size_t k) const {
        return q_.enforced != nullptr && q_.enforced->value({sample(k).at, q_.z}) < 0;
    }
    /// Returns true if the layer below does not carry a sample.
    bool hangs(std::size_t k) const {
        const double out = q_.stand_out[path_.first + k];
        return out > q_.limits.overhang || (out > enforced_share * q_.limits.overhang && enforced(k));
    }
    bool held(std::size_t k) const { return hangs_[k % path_.count] == 0 || placer_.held(bead(k)); }

    /// Handles a path that nothing carries anywhere: its first sample gets the first point.
    void walk_free() {
        const bool thin = path_.piece == no_piece;
        if (!thin && path_.step * static_cast<double>(path_.count) < q_.limits.free_stretch) return;
        place(0);
        walk_on(0, path_.count);
    }

    /// Handles the hanging stretch between two held samples.
    void walk_stretch(std::size_t from, std::size_t to) {
        const double length = path_.step * static_cast<double>(to - from);
        if (length <= q_.limits.free_stretch) return;
        if (bridges(from, to)) {
            ++found_.own_bridges;
            const dvec2 chord = sample(to - 1).at - sample(from + 1).at;
            found_.bridge_ways.push_back(chord / std::sqrt(chord.x * chord.x + chord.y * chord.y));
            return;
        }
        walk_on(from, to);
    }

    /// Returns true if a stretch is a straight bridge between two samples that the layer below carries.
    bool bridges(std::size_t from, std::size_t to) const {
        if (hangs_[from % path_.count] != 0 || hangs_[to % path_.count] != 0) return false;
        const dvec2 a = sample(from + 1).at, chord = sample(to - 1).at - a;
        const double length2 = chord.x * chord.x + chord.y * chord.y;
        if (length2 == 0 || std::sqrt(length2) + 2 * path_.step > q_.limits.bridge) return false;
        const double most = q_.limits.width / 2;
        for (std::size_t k = from + 1; k < to; ++k) {
            const dvec2 p = sample(k).at - a;
            const double off = chord.x * p.y - chord.y * p.x;
            if (off * off > most * most * length2 || enforced(k)) return false;
        }
        return true;
    }

    void walk_on(std::size_t from, std::size_t to) {
        double walked = 0;
        for (std::size_t k = from + 1; k < to; ++k) {
            if (placer_.held(bead(k))) {
                walked = 0;
                continue;
            }
            walked += path_.step;
            if (walked < q_.limits.free_stretch) continue;
            place(k);
            walked = 0;
        }
    }

    void place(std::size_t k) {
        const bool island = path_.piece == no_piece || q_.island[path_.piece] != 0;
        placer_.place(bead(k), island ? SupportReason::island : SupportReason::overhang);
    }

    const PathQuestion& q_;
    const OutlinePath& path_;
    SupportPlacer& placer_;
    PathFindings& found_;
    std::vector<std::uint8_t> hangs_;
};

}  // namespace

PathFindings hold_paths(const PathQuestion& question, SupportPlacer& placer) {
    PathFindings found;
    for (const OutlinePath& path : question.layer.paths) PathWalker(question, path, placer, found).walk();
    return found;
}

}  // namespace lamella
