// PeelCheck: sections that are too small for the layers that are peeled off the film above them.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "engine/checks/check_table.h"

namespace lamella {

/// Follows what each layer hangs by while it is peeled off the vat's film.
///
/// The film pulls at a layer in proportion to its area. The pull runs down through part and supports to the
/// plate, so every section on its way carries it. The size of a fault is the area that is pulled at once over
/// the smallest section that carries it: the factor by which that section is stressed more than the film.
///
/// Two kinds of sections are followed from layer to layer:
/// - of a piece, all that is connected so far: the least sum of its contacts with the layer below. Where
///   pieces join, their sections add up.
/// - of a branch, a connected component of a layer: its least contact since it forked off, or since branches
///   joined. A stem is not followed past a fork; the piece is.
///
/// A component that nothing holds pulls at nothing and holds nothing (see Check::islands). Contacts are taken
/// a row longer than they are seen, so that no section is called smaller than it is. Memory: the labels of
/// one layer, and one patch for each section that is followed.
class PeelCheck : public LayerCheck {
  public:
    explicit PeelCheck(const CheckContext& context)
        : grid_(context.grid), limit_(context.limits.peel), faults_(context.max_faults) {}

    void add(LayerSample& layer, PreparedRows prepared) override;
    void finish() override;
    const FaultList& faults(Check /*check*/) const override { return faults_; }
    void complete(CheckReport& report) const override { report.peel = curve_; }

  private:
    /// A contact of two layers that is the smallest section on its way down so far.
    struct Section {
        std::int64_t length = 0;  ///< sum of its runs' lengths, run units; 0: it floats
        LayerPatch patch{};       ///< its runs, in the upper layer
        double worst = 0;         ///< the greatest factor so far
        int last_layer = 0;       ///< the last layer of which the factor exceeded the limit
    };
    using SectionPtr = std::shared_ptr<Section>;
    /// A connected component of the last layer.
    struct Branch {
        std::uint32_t piece = 0;  ///< index into pieces_
        SectionPtr section{};
    };
    /// The runs that a component has right above one of the last layer.
    struct Contact {
        std::uint32_t above, below;
        std::int64_t length;
        std::int64_t longest;  ///< of its runs

        void include(const Contact& other) {
            length += other.length;
            longest = std::max(longest, other.longest);
        }
    };
    /// Sums of what carries a branch or a piece.
    struct Carrier {
        std::int64_t contact = 0;  ///< with the last layer
        std::int64_t below = 0;    ///< the smallest sections below
        SectionPtr largest{};      ///< of those

        void add(std::int64_t area, const SectionPtr& section);
    };

    void stand_on_bed(const LabelledLayer& layer);
    void hang_on_last(const LabelledLayer& layer, int index);
    std::vector<Contact> contacts_with_last(const LabelledLayer& layer) const;
    std::vector<Carrier> branch_carriers(std::span<const Contact> contacts, std::size_t branches) const;
    std::vector<std::uint32_t> join_pieces(std::span<const Contact> contacts,
                                           std::vector<Branch>& branches) const;
    void share_sections();
    static SectionPtr least_section(const Carrier& carrier, int index);
    void draw_new_sections(const LabelledLayer& layer, int index);
    void judge(const LabelledLayer& layer, int index);
    double load(const SectionPtr& section, std::int64_t pulled, int index);
    void report_ended();

    CheckGrid grid_;
    double limit_;
    LabelledLayer last_;
    std::vector<Branch> branches_;    // by component of last_
    std::vector<SectionPtr> pieces_;  // those with a branch in the last layer
    std::vector<SectionPtr> faulty_;  // sections that carried too much
    PeelCurve curve_;
    FaultList faults_;
};

}  // namespace lamella
