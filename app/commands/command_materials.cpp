// `lamella materials`: lists the base materials that a recipe can name.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "engine/base/whole_file.h"
#include "recipe/base_material.h"
#include "recipe/shipped_texts.h"

namespace lamella {

namespace {

struct MaterialsOptions {
    std::string table;
    bool toml = false;
};

std::string listing(const std::vector<BaseMaterial>& materials) {
    std::size_t longest = 0;
    for (const BaseMaterial& material : materials) longest = std::max(longest, material.name.size());
    std::string text = fmt::format("{:<{}}  E, MPa     nu   g/cm3  product; source\n", "name", longest);
    for (const BaseMaterial& material : materials) {
        text += fmt::format("{:<{}}{:>8.5g}  {:>5}  {:>6}  {}; {}\n", material.name, longest,
                            material.elastic.young,
                            material.has_poisson ? fmt::format("{:.3g}", material.elastic.poisson) : "-",
                            material.density > 0 ? fmt::format("{:.3g}", material.density) : "-",
                            material.product, material.source);
    }
    return text;
}

void run(const MaterialsOptions& options) {
    const std::string text = options.table.empty() ? std::string(shipped_materials())
                                                   : whole_file(options.table, "a table of materials");
    const auto materials = read_materials(text, options.table.empty() ? "materials.toml" : options.table);
    TextOutput out("");
    out.write(options.toml ? text : listing(materials));
    out.close();
}

}  // namespace

void add_materials_command(CLI::App& root) {
    auto options = std::make_shared<MaterialsOptions>();
    CLI::App& command = *root.add_subcommand("materials", "List the base materials of foams");
    command.add_option("--table", options->table, "List the materials of this file instead")
        ->type_name("FILE");
    command.add_flag("--toml", options->toml, "Write the materials as a file to edit");
    finish_command(command,
                   "  lamella materials\n"
                   "  lamella materials --toml > mine.toml\n"
                   "A - marks unknown values. If nu is unknown, 1/3 is assumed, which hardly matters.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
