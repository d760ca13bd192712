// The steps of a batch, compiled for every SIMD target. No fused operations and no approximations: every lane
// computes exactly as the point evaluator does.
#include <cmath>
#include <limits>

#include "engine/formula/formula_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/formula/formula_batch_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
constexpr std::size_t max_lanes = batch_group;
#include "engine/base/lane_math-inl.h"

/// Number of lines and points that a step covers.
struct Grid {
    std::size_t lines, points;
};

/// Iterates over the lines of an operand, vector by vector.
class Walker {
  public:
    Walker(const BatchStep::Operand& operand, std::size_t lanes)
        : line_(operand.at), stride_(operand.line_stride), lanes_(lanes & operand.point_mask) {}
    void begin_line() { at_ = line_, line_ += stride_; }
    HWY_INLINE Lanes next() {
        const Lanes v = hn::LoadU(Doubles(), at_);
        at_ += lanes_;
        return v;
    }

  private:
    const double *line_, *at_ = nullptr;
    std::size_t stride_, lanes_;
};

template <class F>
HWY_INLINE void Unary(const BatchStep& step, const Grid& grid, const F& f) {
    const std::size_t lanes = hn::Lanes(Doubles());
    Walker a(step.a, lanes);
    for (std::size_t l = 0; l < grid.lines; ++l) {
        double* const out = step.out + l * step.out_stride;
        a.begin_line();
        for (std::size_t p = 0; p < grid.points; p += lanes) hn::StoreU(f(a.next()), Doubles(), out + p);
    }
}

template <class F>
HWY_INLINE void Binary(const BatchStep& step, const Grid& grid, const F& f) {
    const std::size_t lanes = hn::Lanes(Doubles());
    Walker a(step.a, lanes), b(step.b, lanes);
    for (std::size_t l = 0; l < grid.lines; ++l) {
        double* const out = step.out + l * step.out_stride;
        a.begin_line(), b.begin_line();
        for (std::size_t p = 0; p < grid.points; p += lanes) {
            const Lanes v = a.next(), w = b.next();
            hn::StoreU(f(v, w), Doubles(), out + p);
        }
    }
}

HWY_INLINE Lanes RoundAway(Lanes a) {
    const Lanes magnitude = Abs(a), whole = RoundDown(magnitude);
    const auto up = hn::Ge(Sub(magnitude, whole), Constant<Lanes>(0.5));
    const Lanes rounded = Add(whole, IfThenElse(up, Constant<Lanes>(1.0), Constant<Lanes>(0.0)));
    return hn::CopySign(rounded, a);
}

HWY_INLINE Lanes Modulo(Lanes a, Lanes b) {
    const Lanes size = Abs(b), rest = Sub(a, Mul(size, RoundDown(Div(a, size))));
    const Lanes zero = Constant<Lanes>(0.0);
    return IfThenElse(Lt(rest, zero), zero, IfThenElse(Lt(size, rest), size, rest));
}

/// A NaN in the first argument stays; with one in the second, the false comparison selects it.
HWY_INLINE Lanes Least(Lanes a, Lanes b) { return IfThenElse(Eq(a, a), IfThenElse(Lt(a, b), a, b), a); }
HWY_INLINE Lanes Most(Lanes a, Lanes b) { return IfThenElse(Eq(a, a), IfThenElse(Lt(b, a), a, b), a); }
HWY_INLINE Lanes Compare(Lanes a, Lanes b) {
    const Lanes zero = Constant<Lanes>(0.0), one = Constant<Lanes>(1.0);
    const Lanes same = IfThenElse(Eq(a, b), zero, Add(a, b));
    return IfThenElse(Lt(a, b), Neg(one), IfThenElse(Lt(b, a), one, same));
}

/// As power() with an exponent that is not whole.
void RootLines(const BatchStep& step, const Grid& grid, double exponent) {
    const Lanes zero = Constant<Lanes>(0.0), nan = Constant<Lanes>(quiet_nan);
    Unary(step, grid, [=](Lanes base) HWY_ATTR {
        const Lanes magnitude = Exponential(Mul(Constant<Lanes>(exponent), Logarithm(Abs(base))));
        return IfThenElse(Lt(base, zero), nan, magnitude);
    });
}

/// Whole exponents are computed lane by lane, because the multiplications depend on the exponent.
void PowerLines(const BatchStep& step, const Grid& grid) {
    const bool is_single = step.b.point_mask == 0 && step.b.line_stride == 0;
    if (is_single && std::floor(*step.b.at) != *step.b.at) return RootLines(step, grid, *step.b.at);
    for (std::size_t l = 0; l < grid.lines; ++l) {
        for (std::size_t p = 0; p < grid.points; ++p) {
            const auto number = [&](const BatchStep::Operand& o) {
                const std::size_t in_group = o.point_mask == 0 ? 0 : p;
                return o.at[l * o.line_stride + in_group];
            };
            step.out[l * step.out_stride + p] = power(number(step.a), number(step.b));
        }
    }
}

void Select(const BatchStep& step, const Grid& grid) {
    const std::size_t lanes = hn::Lanes(Doubles());
    const Lanes zero = Constant<Lanes>(0.0);
    Walker a(step.a, lanes), b(step.b, lanes), c(step.c, lanes);
    for (std::size_t l = 0; l < grid.lines; ++l) {
        double* const out = step.out + l * step.out_stride;
        a.begin_line(), b.begin_line(), c.begin_line();
        for (std::size_t p = 0; p < grid.points; p += lanes) {
            const Lanes yes = b.next(), no = c.next();
            hn::StoreU(IfThenElse(Eq(a.next(), zero), no, yes), Doubles(), out + p);
        }
    }
}

void RunStep(const BatchStep& step, const Grid& grid) {
    const Lanes zero = Constant<Lanes>(0.0), one = Constant<Lanes>(1.0);
    switch (step.op) {
        case FormulaOp::neg:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Neg(a); });
        case FormulaOp::abs:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Abs(a); });
        case FormulaOp::square:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Mul(a, a); });
        case FormulaOp::sqrt:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Sqrt(a); });
        case FormulaOp::recip:
            return Unary(step, grid, [=](Lanes a) HWY_ATTR { return Div(one, a); });
        case FormulaOp::floor:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return RoundDown(a); });
        case FormulaOp::ceil:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return RoundUp(a); });
        case FormulaOp::round:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return RoundAway(a); });
        case FormulaOp::logic_not:
            return Unary(step, grid, [=](Lanes a) HWY_ATTR { return IfThenElse(Eq(a, zero), one, zero); });
        case FormulaOp::sin:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Sine(a); });
        case FormulaOp::cos:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Cosine(a); });
        case FormulaOp::tan:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Tangent(a); });
        case FormulaOp::asin:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Arcsine(a); });
        case FormulaOp::acos:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Arccosine(a); });
        case FormulaOp::atan:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Arctangent(a); });
        case FormulaOp::exp:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Exponential(a); });
        case FormulaOp::ln:
            return Unary(step, grid, [](Lanes a) HWY_ATTR { return Logarithm(a); });
        case FormulaOp::add:
            return Binary(step, grid, [](Lanes a, Lanes b) HWY_ATTR { return Add(a, b); });
        case FormulaOp::sub:
            return Binary(step, grid, [](Lanes a, Lanes b) HWY_ATTR { return Sub(a, b); });
        case FormulaOp::mul:
            return Binary(step, grid, [](Lanes a, Lanes b) HWY_ATTR { return Mul(a, b); });
        case FormulaOp::div:
            return Binary(step, grid, [](Lanes a, Lanes b) HWY_ATTR { return Div(a, b); });
        case FormulaOp::mod:
            return Binary(step, grid, [](Lanes a, Lanes b) HWY_ATTR { return Modulo(a, b); });
        case FormulaOp::pow:
            return PowerLines(step, grid);
        case FormulaOp::atan2:
            return Binary(step, grid, [](Lanes a, Lanes b) HWY_ATTR { return Arctangent2(a, b); });
        case FormulaOp::min:
            return Binary(step, grid, [](Lanes a, Lanes b) HWY_ATTR { return Least(a, b); });
        case FormulaOp::max:
            return Binary(step, grid, [](Lanes a, Lanes b) HWY_ATTR { return Most(a, b); });
        case FormulaOp::compare:
            return Binary(step, grid, [](Lanes a, Lanes b) HWY_ATTR { return Compare(a, b); });
        case FormulaOp::less:
            return Binary(step, grid,
                          [=](Lanes a, Lanes b) HWY_ATTR { return IfThenElse(Lt(a, b), one, zero); });
        case FormulaOp::less_equal:
            return Binary(step, grid,
                          [=](Lanes a, Lanes b) HWY_ATTR { return IfThenElse(hn::Le(a, b), one, zero); });
        case FormulaOp::equal:
            return Binary(step, grid,
                          [=](Lanes a, Lanes b) HWY_ATTR { return IfThenElse(Eq(a, b), one, zero); });
        case FormulaOp::logic_and:
            return Binary(step, grid,
                          [=](Lanes a, Lanes b) HWY_ATTR { return IfThenElse(Eq(a, zero), a, b); });
        case FormulaOp::logic_or:
            return Binary(step, grid,
                          [=](Lanes a, Lanes b) HWY_ATTR { return IfThenElse(Eq(a, zero), b, a); });
        default:
            return Select(step, grid);
    }
}

void RunSteps(std::span<const BatchStep> steps, std::size_t lines, std::size_t points) {
    for (const BatchStep& step : steps) {
        const Grid grid{step.by_line ? lines : 1, step.by_point ? points : batch_group};
        // If no line is shared or has gaps, all lines are processed as one.
        if (step.contiguous && step.out_stride == grid.points) {
            RunStep(step, {1, grid.lines * grid.points});
        } else {
            RunStep(step, grid);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(RunSteps);

void run_batch_steps(std::span<const BatchStep> steps, std::size_t lines, std::size_t points) {
    HWY_DYNAMIC_DISPATCH(RunSteps)(steps, lines, points);
}

}  // namespace lamella
#endif
