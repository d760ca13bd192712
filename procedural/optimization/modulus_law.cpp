// Penalised and homogenised laws.
#include "procedural/optimization/modulus_law.h"

#include <algorithm>
#include <vector>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "procedural/grading/table_curve.h"

namespace lamella {

namespace {

class PenaltyLaw final : public ModulusLaw {
  public:
    explicit PenaltyLaw(const PenaltySettings& settings)
        : settings_(settings), steepness_(power(settings.linear_to, settings.exponent - 1)) {}

    double modulus(double density) const override {
        const double share =
            density < settings_.linear_to ? steepness_ * density : power(density, settings_.exponent);
        return settings_.least + share * (1 - settings_.least);
    }
    double slope(double density) const override {
        const double share = density < settings_.linear_to
                                 ? steepness_
                                 : settings_.exponent * power(density, settings_.exponent - 1);
        return share * (1 - settings_.least);
    }

  private:
    PenaltySettings settings_;
    double steepness_;
};

constexpr int pieces_between_points = 8;

class FoamModulusLaw final : public ModulusLaw {
  public:
    FoamModulusLaw(const FoamLaw& law, double least) : least_(least) {
        // Not over the ratio: FoamLaw::at is linear in the density, whose slope jumps from point to point.
        Table logs;
        for (const FoamLawPoint& point : law.points()) {
            if (!(point.density > 0 && (logs.empty() || logarithm(point.density) > logs.back().first)))
                throw InputError("a foam's law: density and modulus have to grow with the ratio");
            logs.emplace_back(logarithm(point.density), logarithm(point.young));
        }
        const TableCurve curve(logs, true);
        for (std::size_t i = 0; i + 1 < logs.size(); ++i) {
            const double width = logs[i + 1].first - logs[i].first;
            add(law.points()[i].density, law.points()[i].young);
            for (int k = 1; k < pieces_between_points; ++k) {
                const double at = logs[i].first + width * k / pieces_between_points;
                add(exponential(at), exponential(curve.at(at)));
            }
        }
        add(law.points().back().density, law.points().back().young);
        if (pieces_.back().density < 1) add(1, 1);
    }

    double modulus(double density) const override {
        if (!(density > 0)) return least_;
        const Piece& piece = piece_of(density);
        return std::max(least_, piece.modulus * power(density / piece.density, piece.exponent));
    }
    double slope(double density) const override {
        if (!(density > 0)) return 0;
        const Piece& piece = piece_of(density);
        const double modulus = piece.modulus * power(density / piece.density, piece.exponent);
        return modulus > least_ ? piece.exponent * modulus / density : 0;
    }

  private:
    /// From a density up to that of the next piece: modulus (d / density)^exponent.
    struct Piece {
        double density, modulus, exponent;
    };

    void add(double density, double modulus) {
        if (!pieces_.empty()) {
            Piece& last = pieces_.back();
            if (!(density > last.density && modulus > last.modulus))
                throw InputError("a foam's law: density and modulus have to grow with the ratio");
            last.exponent = logarithm(modulus / last.modulus) / logarithm(density / last.density);
        }
        pieces_.push_back({density, modulus, pieces_.empty() ? 1 : pieces_.back().exponent});
    }
    const Piece& piece_of(double density) const {
        const auto above = std::upper_bound(pieces_.begin(), pieces_.end(), density,
                                            [](double d, const Piece& p) { return d < p.density; });
        return above == pieces_.begin() ? pieces_.front() : *(above - 1);
    }

    double least_;
    std::vector<Piece> pieces_;
};

}  // namespace

std::shared_ptr<const ModulusLaw> make_foam_modulus_law(const FoamLaw& law, double least) {
    return std::make_shared<FoamModulusLaw>(law, least);
}

std::shared_ptr<const ModulusLaw> make_penalty_law(const PenaltySettings& settings) {
    if (!(settings.exponent >= 1)) throw InputError("a penalty exponent is at least 1");
    if (!(settings.least >= 0 && settings.least < 1 && settings.linear_to >= 0 && settings.linear_to < 1))
        throw InputError("the least modulus and the linear range of a penalty law lie in [0, 1)");
    return std::make_shared<PenaltyLaw>(settings);
}

}  // namespace lamella
