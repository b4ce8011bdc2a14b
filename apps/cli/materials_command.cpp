// pliant materials: what bodies can be made of, and where the numbers come from.
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "pliant/core/printable.h"
#include "pliant/materials/material.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant_cli {
namespace {

using Json = nlohmann::ordered_json;
using pliant::Material;
using pliant::OptionInfo;
using pliant::Real;
using pliant::SheetMaterial;
using pliant::SolidMaterial;

/// Calls f with each number of a material, as its type lists them.
template <class F>
void visit_numbers(const Material& material, F&& f) {
  std::visit([&](const auto& of) { of.visit(of, f); }, material.of);
  material.surface.visit(material.surface, f);
}

void print_table(bool of_sheets) {
  const auto cell = [](const auto& text) { fmt::print("  {:>13}", text); };
  fmt::print("{:<15}", of_sheets ? "sheets" : "solids");
  const Material& first = *std::ranges::find(pliant::builtin_materials(), of_sheets, &Material::is_sheet);
  visit_numbers(first, [&](const OptionInfo& info, Real) { cell(info.name); });
  fmt::print("\n{:<15}", "");
  visit_numbers(first, [&](const OptionInfo& info, Real) { cell(info.unit); });
  fmt::print("\n");
  for (const Material& material : pliant::builtin_materials()) {
    if (material.is_sheet() != of_sheets) continue;
    fmt::print("{:<15}", material.name);
    visit_numbers(material, [&](const OptionInfo&, Real number) { cell(fmt::format("{:.6g}", number)); });
    fmt::print("  {}\n", material.description);
  }
}

Json json_of(const Material& material) {
  Json json = {{"name", material.name},
               {"kind", material.is_sheet() ? "sheet" : "solid"},
               {"description", material.description},
               {"source", material.source}};
  visit_numbers(material, [&](const OptionInfo& info, Real number) { json[std::string(info.name)] = number; });
  return json;
}

void print_one(const Material& material) {
  fmt::print("{}: {}, a {}\n", material.name, material.description, material.is_sheet() ? "sheet" : "solid");
  visit_numbers(material, [](const OptionInfo& info, Real number) {
    fmt::print("  {:<14} {:>10.6g} {:<6} {}\n", info.name, number, info.unit, info.doc);
  });
  fmt::print("  source: {}\n", material.source);
}

struct MaterialsOptions {
  std::string name;
  bool as_json = false;
};

void list_materials(const MaterialsOptions& options) {
  if (!options.name.empty()) {
    if (const Material* found = pliant::find_builtin_material(options.name)) {
      return options.as_json ? fmt::print("{}\n", json_of(*found).dump(2)) : print_one(*found);
    }
    std::vector<std::string_view> names;
    for (const Material& material : pliant::builtin_materials()) names.push_back(material.name);
    pliant::fail_input(fmt::format("unknown material '{}'; {}", pliant::printable(options.name),
                                   pliant::suggestion_text(options.name, names)));
  }
  if (options.as_json) {
    Json all = Json::array();
    for (const Material& material : pliant::builtin_materials()) all.push_back(json_of(material));
    return fmt::print("{}\n", all.dump(2));
  }
  print_table(true);
  fmt::print("\n");
  print_table(false);
}

}  // namespace

void add_materials_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("materials", "List what bodies can be made of, with sources");
  const auto options = std::make_shared<MaterialsOptions>();
  command->add_option("name", options->name, "A material: its numbers, and where each comes from");
  command->add_flag("--json", options->as_json, "As JSON, for programs");
  command->footer(
      "A body of a scene is made of one with \"material\": \"cotton\"; docs/materials.md says how.\n"
      "Examples:\n"
      "  pliant materials silk\n"
      "  pliant run shirt.obj --set bodies[0].material=silk");
  command->callback([options] { list_materials(*options); });
}

}  // namespace pliant_cli
