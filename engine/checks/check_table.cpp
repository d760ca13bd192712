// The table of checks. A new one is a file of its own and its rows here.
#include "engine/checks/check_table.h"

#include <array>

#include "engine/checks/layer_checks.h"
#include "engine/checks/neck_check.h"
#include "engine/checks/overhang_check.h"
#include "engine/checks/peel_check.h"
#include "engine/checks/piece_check.h"
#include "engine/checks/thickness_check.h"
#include "engine/checks/void_check.h"

namespace lamella {
namespace {

/// By Check.
constexpr std::array<CheckInfo, check_count> infos{{
    {.name = "connectivity", .unit = "mm3"},
    {.name = "sheets", .unit = "mm2"},
    {.name = "islands", .unit = "mm2"},
    {.name = "overhangs", .unit = "mm2", .limit = &PrintLimits::overhang, .limit_unit = "mm"},
    {.name = "bridges", .unit = "mm", .limit = &PrintLimits::bridge, .limit_unit = "mm"},
    {.name = "thickness",
     .unit = "mm3",
     .limit = &PrintLimits::thickness,
     .limit_unit = "mm",
     .thickness_limit = "least thickness"},
    {.name = "necks",
     .unit = "mm3",
     .limit = &PrintLimits::neck,
     .limit_unit = "mm",
     .thickness_limit = "least neck"},
    {.name = "gaps",
     .unit = "mm3",
     .limit = &PrintLimits::gap,
     .limit_unit = "mm",
     .thickness_limit = "least gap"},
    {.name = "cavities", .unit = "mm3", .limit = &PrintLimits::cavity, .limit_unit = "mm3"},
    {.name = "cups", .unit = "mm3", .limit = &PrintLimits::cup, .limit_unit = "mm3"},
    {.name = "peel", .unit = "times", .limit = &PrintLimits::peel, .limit_unit = "times", .adds_up = false},
    {.name = "build_volume", .unit = "mm", .adds_up = false},
    {.name = "empty_layers", .unit = "mm"},
}};

template <typename T>
std::unique_ptr<LayerCheck> make(const CheckContext& context) {
    return std::make_unique<T>(context);
}

std::unique_ptr<LayerCheck> make_wall_check(const CheckContext& context) {
    return std::make_unique<ThicknessCheck>(context, FeatureKind::wall);
}

std::unique_ptr<LayerCheck> make_gap_check(const CheckContext& context) {
    return std::make_unique<ThicknessCheck>(context, FeatureKind::gap);
}

constexpr std::array sheets{Check::sheets}, empty_layers{Check::empty_layers},
    build_volume{Check::build_volume}, walls{Check::thickness}, gaps{Check::gaps}, necks{Check::necks},
    pieces{Check::connectivity}, peel{Check::peel};
constexpr std::array voids{Check::cavities, Check::cups};
constexpr std::array overhangs{Check::islands, Check::overhangs, Check::bridges};

constexpr std::array passes{
    CheckPass{.finds = sheets, .make = make<SheetCheck>, .reads_part_labels = true},
    CheckPass{.finds = empty_layers, .make = make<EmptyCheck>},
    CheckPass{.finds = build_volume, .make = make<ReachCheck>},
    CheckPass{.finds = voids, .make = make<VoidCheck>},
    CheckPass{.finds = walls, .make = make_wall_check},
    CheckPass{.finds = gaps, .make = make_gap_check},
    CheckPass{.finds = necks, .make = make<NeckCheck>},
    CheckPass{
        .finds = peel, .make = make<PeelCheck>, .reads_part_labels = true, .reads_printed_labels = true},
    CheckPass{.finds = overhangs,
              .make = make<OverhangCheck>,
              .reads_part_labels = true,
              .reads_printed_labels = true},
    CheckPass{.finds = pieces, .make = make<PieceCheck>, .reads_part_labels = true},
};

}  // namespace

const CheckInfo& check_info(Check check) { return infos[static_cast<std::size_t>(check)]; }

std::span<const CheckPass> check_passes() { return passes; }

}  // namespace lamella
