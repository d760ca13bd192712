// WindowDifference::differences, compiled for every SIMD target. All operations are on integers, so every
// target gives the same numbers.
#include <array>

#include "procedural/appearance/window_difference.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "procedural/appearance/window_difference_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

#ifndef LAMELLA_DIFFERENCE_TABLES
#define LAMELLA_DIFFERENCE_TABLES
namespace lamella {

/// The broken line as tables of bytes, by the high half of the difference.
struct DifferenceTables {
    const WindowDifference& line;
    std::array<std::uint8_t, 16> low, high, slopes;

    explicit DifferenceTables(const WindowDifference& of) : line(of) {
        for (std::size_t i = 0; i < 16; ++i) {
            low[i] = static_cast<std::uint8_t>(line.bases_[i] & 255U);
            high[i] = static_cast<std::uint8_t>(line.bases_[i] >> 8U);
            slopes[i] = static_cast<std::uint8_t>(line.slopes_[i]);
        }
    }
};

}  // namespace lamella
#endif

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // has no vectors of bytes

void Differences(const DifferenceTables& tables, const std::uint8_t* window, const std::uint8_t* rows,
                 std::size_t bytes, const std::size_t* begins, std::size_t count, std::uint32_t* out) {
    for (std::size_t i = 0; i < count; ++i) {
        out[i] = 0;
        for (std::size_t k = 0; k < bytes; ++k) {
            const int a = window[k], b = rows[begins[i] + k];
            out[i] += tables.line.of(static_cast<unsigned>(a > b ? a - b : b - a));
        }
    }
}

#else

/// Adds up differences of one vector of bytes at a time.
template <class Bytes>
class DifferenceSum {
  public:
    HWY_INLINE explicit DifferenceSum(const DifferenceTables& tables)
        : low_(hn::LoadDup128(Bytes(), tables.low.data())),
          high_(hn::LoadDup128(Bytes(), tables.high.data())),
          slopes_(hn::LoadDup128(Bytes(), tables.slopes.data())) {}

    HWY_INLINE void add(const std::uint8_t* a, const std::uint8_t* b) {
        const Bytes d;
        const Shorts d16;
        const auto nibble = hn::Set(d, std::uint8_t{15});
        const auto va = hn::LoadU(d, a), vb = hn::LoadU(d, b);
        const auto difference = hn::Or(hn::SaturatedSub(va, vb), hn::SaturatedSub(vb, va));
        const auto rest = hn::And(difference, nibble);
        const auto which =
            hn::And(hn::BitCast(d, hn::ShiftRight<4>(hn::BitCast(UnsignedShorts(), difference))), nibble);
        sum_low_ = hn::Add(sum_low_, hn::SumsOf8(hn::TableLookupBytes(low_, which)));
        sum_high_ = hn::Add(sum_high_, hn::SumsOf8(hn::TableLookupBytes(high_, which)));
        const auto slope = hn::TableLookupBytes(slopes_, which);
        const auto even = [&](auto v) HWY_ATTR {
            return hn::And(hn::BitCast(d16, v), hn::Set(d16, std::int16_t{255}));
        };
        const auto odd = [&](auto v) HWY_ATTR {
            return hn::BitCast(d16, hn::ShiftRight<8>(hn::BitCast(UnsignedShorts(), v)));
        };
        products_ =
            hn::ReorderWidenMulAccumulate(Ints(), even(slope), even(rest), products_, other_products_);
        products_ = hn::ReorderWidenMulAccumulate(Ints(), odd(slope), odd(rest), products_, other_products_);
    }
    HWY_INLINE std::uint32_t total() const {
        const Ints d;
        const auto bases = hn::Add(hn::BitCast(d, sum_low_), hn::BitCast(d, hn::ShiftLeft<8>(sum_high_)));
        const auto all = hn::Add(bases, hn::Add(products_, other_products_));
        return static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(d, all)));
    }

  private:
    using UnsignedShorts = hn::RepartitionToWide<Bytes>;
    using Shorts = hn::RebindToSigned<UnsignedShorts>;
    using Ints = hn::RepartitionToWide<Shorts>;
    using Longs = hn::RepartitionToWide<hn::RebindToUnsigned<Ints> >;

    hn::Vec<Bytes> low_, high_, slopes_;
    hn::Vec<Longs> sum_low_ = hn::Zero(Longs()), sum_high_ = hn::Zero(Longs());
    hn::Vec<Ints> products_ = hn::Zero(Ints()), other_products_ = hn::Zero(Ints());
};

void Differences(const DifferenceTables& tables, const std::uint8_t* window, const std::uint8_t* rows,
                 std::size_t bytes, const std::size_t* begins, std::size_t count, std::uint32_t* out) {
    // Windows have rows of 16 or 32 bytes and more; an odd number of 16 leaves a remainder of one short
    // vector.
    using Long = hn::CappedTag<std::uint8_t, 32>;
    using Short = hn::CappedTag<std::uint8_t, 16>;
    const std::size_t lanes = hn::Lanes(Long());
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* const other = rows + begins[i];
        std::size_t at = 0;
        DifferenceSum<Long> sum(tables);
        for (; at + lanes <= bytes; at += lanes) sum.add(window + at, other + at);
        out[i] = sum.total();
        if (at == bytes) continue;
        DifferenceSum<Short> remainder(tables);
        for (; at < bytes; at += hn::Lanes(Short())) remainder.add(window + at, other + at);
        out[i] += remainder.total();
    }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(Differences);

void WindowDifference::differences(const std::uint8_t* window, const std::uint8_t* rows,
                                   std::span<const std::size_t> begins, std::uint32_t* out) const {
    const DifferenceTables tables(*this);
    HWY_DYNAMIC_DISPATCH(Differences)
    (tables, window, rows, window_bytes(), begins.data(), begins.size(), out);
}

}  // namespace lamella
#endif
