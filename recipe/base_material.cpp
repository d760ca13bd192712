// Parses tables of materials (TOML), and looks materials up by name.
#include "recipe/base_material.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/whole_file.h"
#include "procedural/elasticity/foam_law.h"
#include "recipe/settings.h"
#include "recipe/shipped_texts.h"
#include "recipe/toml_depth.h"

namespace lamella {

namespace {

/// Reads one material's keys.
class MaterialReader {
  public:
    MaterialReader(const toml::table& table, std::string where) : table_(table), where_(std::move(where)) {}

    BaseMaterial read(std::string name) {
        refuse_unknown();
        BaseMaterial material;
        material.name = std::move(name);
        if (!table_.contains("young"))
            throw InputError(where_ + ": young is missing; accepted: Young's modulus in MPa");
        material.elastic.young = number("young", 1e-6, 1e6);
        material.has_poisson = table_.contains("poisson");
        material.elastic.poisson = material.has_poisson ? number("poisson", 0, 0.49) : law_poisson;
        if (table_.contains("density")) material.density = number("density", 1e-3, 100);
        material.product = text("product");
        material.source = text("source");
        return material;
    }

  private:
    void refuse_unknown() const {
        const std::vector<std::string> known{"young", "poisson", "density", "product", "source"};
        for (const auto& [key, value] : table_) {
            if (std::ranges::find(known, key.str()) != known.end()) continue;
            throw InputError(fmt::format("{}:{}: `{}` is not a key of a material; accepted: {}", where_,
                                         value.source().begin.line, std::string(key.str()).substr(0, 64),
                                         fmt::join(known, ", ")));
        }
    }
    double number(const char* key, double least, double most) const {
        const auto found = table_[key].value<double>();
        if (!found || !(*found >= least && *found <= most)) {
            throw InputError(fmt::format("{}:{}: {} is out of range; accepted: a number from {} to {}",
                                         where_, table_[key].node()->source().begin.line, key, least, most));
        }
        return *found;
    }
    std::string text(const char* key) const { return table_[key].value_or(std::string()); }

    const toml::table& table_;
    std::string where_;
};

}  // namespace

std::vector<BaseMaterial> read_materials(std::string_view text, const std::string& name) {
    std::vector<BaseMaterial> materials;
    require_shallow_toml(text, name);
    try {
        const toml::table all = toml::parse(text, name);
        for (const auto& [key, value] : all) {
            if (!value.is_table())
                throw InputError(fmt::format(
                    "{}:{}: a material must be a table; accepted: [pla] with young and other keys below it",
                    name, value.source().begin.line));
            materials.push_back(MaterialReader(*value.as_table(), name).read(std::string(key.str())));
        }
    } catch (const toml::parse_error& error) {
        throw InputError(
            fmt::format("{}:{}: {}", name, error.source().begin.line, std::string(error.description())));
    }
    if (materials.empty())
        throw InputError(name +
                         ": contains no material; accepted: one table for each material, such as [pla]");
    return materials;
}

std::vector<BaseMaterial> shipped_material_list() {
    return read_materials(shipped_materials(), "materials.toml");
}

BaseMaterial base_material(const MaterialRecipe& recipe) {
    BaseMaterial material{{}, {recipe.young, law_poisson}, false, 0, {}, {}};
    if (!recipe.name.empty()) {
        const auto list =
            recipe.table.empty()
                ? shipped_material_list()
                : read_materials(whole_file(recipe.table, "a table of materials"), recipe.table);
        const auto found = std::ranges::find(list, recipe.name, &BaseMaterial::name);
        if (found == list.end()) {
            std::vector<std::string> names;
            names.reserve(list.size());
            for (const BaseMaterial& each : list) names.push_back(each.name);
            const std::string near = nearest(recipe.name, names);
            throw InputError(fmt::format(
                "material.name: \"{}\" is unknown{}; accepted: {}", recipe.name.substr(0, 64),
                near.empty() ? "" : fmt::format(", did you mean `{}`?", near), fmt::join(names, ", ")));
        }
        material = *found;
    }
    if (recipe.young > 0) material.elastic.young = recipe.young;
    if (recipe.poisson >= 0) {
        material.elastic.poisson = recipe.poisson;
        material.has_poisson = true;
    }
    if (recipe.density > 0) material.density = recipe.density;
    return material;
}

}  // namespace lamella
