// SoundPattern: a synthesised pattern made printable, with bridges that follow its look.
#pragma once

#include <vector>

#include "procedural/pattern/printable_pattern.h"
#include "procedural/texture/pattern_levels.h"

namespace lamella {

/// Chooses bridges that make a pattern sounder.
class BridgeChoice {
  public:
    virtual ~BridgeChoice() = default;
    /// Returns the middle lines of bridges for a pattern in one piece, given by its distances (mm, positive
    /// in the solid); none when it is sound. Asked again once they are built.
    virtual std::vector<SiteLine> choose(std::span<const float> distances) = 0;
    /// Returns how weak the pattern is that choose() was asked about last: of all, the least weak is kept, of
    /// those alike the last.
    virtual double weakness() const { return 0; }
};

struct SoundPattern {
    PrintablePattern printed;
    std::size_t pieces = 0;                   ///< before any were joined
    std::size_t joins = 0;                    ///< bridges between pieces
    std::size_t bridges = 0;                  ///< that were chosen
    double wanted_share = 0;                  ///< the picture's
    std::size_t cut_struts = 0, detours = 0;  ///< left, as in BridgePlan; 0 where nobody looked
    std::size_t hanging = 0;                  ///< left, with solid below; 0 where nobody looked
};

/// Makes a pattern printable, in rounds: bridges that join pieces, and those that are chosen, become fixed,
/// and the pattern about them is synthesised anew, so that it runs into them. `choice` may be null. Bridges
/// that are chosen after sixteen rounds are not built. Of the rounds, that of the least weak pattern counts.
/// Throws as printable_pattern(), Interrupted when cancelled.
SoundPattern sound_pattern(const PatternLevel& level, const Exemplar& exemplar, SynthesisResult found,
                           const SynthesisSettings& synthesis, PrintSettings print, BridgeChoice* choice);

}  // namespace lamella
