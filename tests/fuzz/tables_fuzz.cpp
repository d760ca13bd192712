// Fuzz target: any text, read as a table, as foams' laws or as materials, ends in curves whose ranges enclose
// their numbers or in an InputError. The first byte says which.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "engine/base/error.h"
#include "procedural/elasticity/foam_law.h"
#include "procedural/grading/table_grading.h"
#include "recipe/base_material.h"

using namespace lamella;

namespace {

void check_table(const std::string& text) {
    for (const bool smooth : {false, true}) {
        const TableCurve curve(read_table(text, "fuzz.csv"), smooth);
        const Interval all = curve.range({-infinity, infinity});
        for (const double position : {-1e9, -1.0, 0.0, 0.5, 3.0, 1e300}) {
            if (!all.contains(curve.at(position))) std::abort();
            if (!curve.range({position, position + 1}).contains(curve.at(position))) std::abort();
        }
    }
}

void check_laws(const std::string& text) {
    for (const FoamLawTable& table : read_foam_laws(text, "fuzz.csv")) {
        try {
            const FoamLaw law(table, 0.35);
            const Interval ratios = law.ratios();
            for (const double share : {0.1, 0.5, 0.9}) {
                const Interval moduli = law.moduli();
                const double ratio = law.ratio_of(moduli.lo + share * moduli.width());
                if (!(ratio > ratios.lo * (1 - 1e-9) && ratio < ratios.hi * (1 + 1e-9))) std::abort();
                if (std::isnan(law.at(ratio).young)) std::abort();
            }
        } catch (const InputError&) {
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        if (data[0] % 3 == 0) check_table(text);
        if (data[0] % 3 == 1) check_laws(text);
        if (data[0] % 3 == 2) read_materials(text, "fuzz.toml");
    } catch (const InputError&) {
    }
    return 0;
}
