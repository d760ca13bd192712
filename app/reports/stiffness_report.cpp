// Formats a summary with bounds and tensor, or everything as JSON.
#include "app/reports/stiffness_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "recipe/base_material.h"
#include "recipe/build/foam_modulus.h"

namespace lamella {

IsotropicMaterial homogenized_material(const Recipe& recipe) {
    if (!recipe.foam)
        throw InputError(
            "[foam] is missing: there is nothing to homogenise; accepted: a recipe with one, or --cell and "
            "--beam");
    check_uniform(*recipe.foam);
    if (!recipe.material) return {};
    IsotropicMaterial material = base_material(*recipe.material).elastic;
    if (!(material.young > 0)) material.young = 1;
    return material;
}

std::string stiffness_text(const FoamRecipe& foam, const IsotropicMaterial& material,
                           const FoamStiffness& found) {
    const ElasticTensor c = found.stiffness();
    const double density = found.mean(density_of), solid = material.young;
    const IsotropicMaterial closest = closest_isotropic(c), bound = hashin_shtrikman(material, density);
    const auto line = [&](const char* name, double value, double spread, const char* more) {
        const std::string about = found.samples.size() > 1 ? fmt::format(" +- {:.2g}", spread) : "";
        return fmt::format("{:<18}{:.5g}{}{}\n", name, value, about, more);
    };
    const bool one = found.samples.size() == 1;
    std::string text = fmt::format(
        "{} foam: {} of {:.4g} mm, {} elements along a side, of a material with E = {:.6g} "
        "and nu = {:.4g}\n\n",
        foam.kind, one ? "a sample" : fmt::format("{} samples", found.samples.size()), found.period,
        found.elements, solid, material.poisson);
    text += line("density", density, found.spread(density_of), " of the solid");
    text += line("E", closest.young, found.spread(young_of),
                 fmt::format(", {:.4g} % of the material's", 100 * closest.young / solid).c_str());
    text += line("nu", closest.poisson, found.spread(poisson_of), "");
    text += line("G", closest.shear(), found.spread(shear_of), "");
    text += line("K", closest.bulk(), found.spread(bulk_of), "");
    text += fmt::format("{:<18}{:.2f} % from isotropic", "anisotropy", 100 * anisotropy(c));
    const Interval e = directional_moduli(compliance_of(c));
    text += fmt::format(", E from {:.5g} to {:.5g} by direction\n", e.lo, e.hi);
    text += fmt::format("{:<18}E at most {:.5g} (Voigt), isotropic {:.5g} (Hashin and Shtrikman)\n\n",
                        "bounds", density * solid, bound.young);
    text += "stiffness          xx          yy          zz          xy          yz          zx\n";
    const std::array<const char*, 6> names{"xx", "yy", "zz", "xy", "yz", "zx"};
    for (std::size_t i = 0; i < 6; ++i) {
        text += fmt::format("{:>9}", names[i]);
        for (const double v : c[i]) text += fmt::format("{:>12.5g}", v);
        text += "\n";
    }
    return text;
}

nlohmann::ordered_json stiffness_json(const FoamRecipe& foam, const IsotropicMaterial& material,
                                      const FoamStiffness& found) {
    const ElasticTensor c = found.stiffness();
    const IsotropicMaterial closest = closest_isotropic(c);
    auto samples = nlohmann::ordered_json::array();
    for (const Homogenized& sample : found.samples) {
        samples.push_back({{"density", sample.density},
                           {"iterations", sample.iterations},
                           {"E", young_of(sample)},
                           {"nu", poisson_of(sample)},
                           {"stiffness", sample.stiffness}});
    }
    const Interval e = directional_moduli(compliance_of(c));
    return {{"foam", foam.kind},
            {"period_mm", found.period},
            {"elements", found.elements},
            {"material", {{"E", material.young}, {"nu", material.poisson}}},
            {"density", found.mean(density_of)},
            {"E", closest.young},
            {"nu", closest.poisson},
            {"G", closest.shear()},
            {"K", closest.bulk()},
            {"anisotropy", anisotropy(c)},
            {"E_least", e.lo},
            {"E_greatest", e.hi},
            {"E_hashin_shtrikman", hashin_shtrikman(material, found.mean(density_of)).young},
            {"stiffness", c},
            {"samples", std::move(samples)}};
}

nlohmann::ordered_json directional_json(const ElasticTensor& stiffness) {
    constexpr int polar = 25, around = 48;
    const ElasticTensor compliance = compliance_of(stiffness);
    auto young = nlohmann::ordered_json::array();
    for (int ring = 0; ring < polar; ++ring) {
        const double down = std::numbers::pi * ring / (polar - 1);
        for (int turn = 0; turn < around; ++turn) {
            const double angle = 2 * std::numbers::pi * turn / around;
            young.push_back(directional_modulus(
                compliance,
                {std::sin(down) * std::cos(angle), std::sin(down) * std::sin(angle), std::cos(down)}));
        }
    }
    return {{"polar", polar}, {"around", around}, {"young", std::move(young)}};
}

nlohmann::ordered_json law_json(const FoamRecipe& foam) {
    const auto law = known_law(foam);
    if (!law) return nullptr;
    auto points = nlohmann::ordered_json::array();
    for (const FoamLawPoint& point : law->points) {
        points.push_back({{"ratio", point.ratio},
                          {"density", point.density},
                          {"young", point.young},
                          {"poisson", point.poisson},
                          {"spread", point.spread}});
    }
    return points;
}

}  // namespace lamella
