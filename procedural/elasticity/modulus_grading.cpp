// Gradings that combine two gradings by a monotone law.
#include "procedural/elasticity/modulus_grading.h"

namespace lamella {
namespace {

/// Widens a range by the rounding error of logarithms and powers.
Interval widened(Interval range) {
    constexpr double slack = 1e-12;
    return {range.lo * (1 - slack), range.hi * (1 + slack)};
}

/// A grading that is a function of two positive gradings.
template <typename Number>
class PairGrading : public Grading {
  public:
    PairGrading(GradingPtr a, GradingPtr b, FoamModulusPtr foam)
        : a_(std::move(a)), b_(std::move(b)), number_{std::move(foam)} {}

    double at(dvec3 p) const override { return number_(a_->at(p), b_->at(p)); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        numbers_of(*a_, *b_, points, out, number_);
    }
    Interval range(const Box& box) const override {
        const Interval a = a_->range(box), b = b_->range(box);
        Interval range = widened(number_.range(a, b));
        if (a.hi == infinity || b.hi == infinity) range.hi = infinity;  // the value may be NaN there
        return range;
    }
    std::optional<double> constant() const override {
        const auto a = a_->constant(), b = b_->constant();
        return a && b ? std::optional(number_(*a, *b)) : std::nullopt;
    }

  private:
    GradingPtr a_, b_;
    Number number_;
};

struct CellForModulus {
    FoamModulusPtr foam;
    double operator()(double modulus, double member) const { return member / foam->ratio_of(modulus); }
    Interval range(Interval modulus, Interval member) const {
        return {(*this)(modulus.hi, member.lo), (*this)(modulus.lo, member.hi)};
    }
};

struct MemberForModulus {
    FoamModulusPtr foam;
    double operator()(double modulus, double cell) const { return cell * foam->ratio_of(modulus); }
    Interval range(Interval modulus, Interval cell) const {
        return {(*this)(modulus.lo, cell.lo), (*this)(modulus.hi, cell.hi)};
    }
};

struct ModulusOf {
    FoamModulusPtr foam;
    double operator()(double cell, double member) const { return foam->modulus_of(member / cell); }
    Interval range(Interval cell, Interval member) const {
        return {(*this)(cell.hi, member.lo), (*this)(cell.lo, member.hi)};
    }
};

}  // namespace

GradingPtr make_cell_for_modulus(GradingPtr modulus, GradingPtr member, FoamModulusPtr foam) {
    return std::make_shared<PairGrading<CellForModulus>>(std::move(modulus), std::move(member),
                                                         std::move(foam));
}

GradingPtr make_member_for_modulus(GradingPtr modulus, GradingPtr cell, FoamModulusPtr foam) {
    return std::make_shared<PairGrading<MemberForModulus>>(std::move(modulus), std::move(cell),
                                                           std::move(foam));
}

GradingPtr make_modulus_of(GradingPtr cell, GradingPtr member, FoamModulusPtr foam) {
    return std::make_shared<PairGrading<ModulusOf>>(std::move(cell), std::move(member), std::move(foam));
}

}  // namespace lamella
