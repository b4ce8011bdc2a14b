#include <algorithm>
#include <string>
#include <vector>

#include "pliant/core/printable.h"
#include "pliant/materials/material.h"

namespace pliant {
namespace {

constexpr std::string_view matsudaira =
    "Matsudaira et al. 2015 (J. Textile Eng. 61(6), Table 1): weight, bending, damping from the hysteresis of bending";
constexpr std::string_view kawabata = "Kawabata 1980, typical ranges of KES: stretch, shear";
constexpr std::string_view momme =
    "definition of the momme: weight; Matsudaira and Kawabata 1988, typical ranges of "
    "KES: stretch, shear, bending; damping as of faille";
constexpr std::string_view marechal =
    "Marechal et al. 2021 (Soft Robotics 8(3)), raw tensile curves fitted to 50 %: E; data sheet: density; "
    "estimates: friction, damping; nearly incompressible, 0.49 is the most that is expressed";

std::string joined(std::string_view first, std::string_view second, std::string_view third = "") {
  std::string text = std::string(first) + "; " + std::string(second);
  if (!third.empty()) text += "; " + std::string(third);
  return text;
}

Material cotton() {
  return {.name = "cotton",
          .description = "broadcloth in plain weave, as of shirts: crisp",
          .source = joined(matsudaira, kawabata, "friction: typical of cloth on itself, 0.3 to 0.7"),
          .of =
              SheetMaterial{
                  .area_density = 0.1238, .stretch_warp = 12000, .stretch_weft = 4900, .shear = 56, .bending = 1.16e-5},
          .surface = {.friction = 0.5, .damping = 2.1}};
}

Material denim() {
  return {.name = "denim",
          .description = "cotton twill of 11 oz, as of worn jeans: heavy",
          .source =
              "Kumari and Khurana 2016 (J. Textiles, Table 5), mean of six: stretch, shear, bending, damping; "
              "Wang et al. 2011, sample 11oz-black-denim: weight; friction: the rough end of cloth",
          .of =
              SheetMaterial{
                  .area_density = 0.324, .stretch_warp = 6700, .stretch_weft = 6700, .shear = 110, .bending = 1.71e-5},
          .surface = {.friction = 0.6, .damping = 1.8}};
}

Material faille() {
  return {.name = "faille",
          .description = "fine polyester, like silk: limp, many narrow folds",
          .source = joined(matsudaira, kawabata, "friction: the smooth end of cloth"),
          .of =
              SheetMaterial{
                  .area_density = 0.1043, .stretch_warp = 11000, .stretch_weft = 6900, .shear = 20, .bending = 1.86e-6},
          .surface = {.friction = 0.3, .damping = 0.75}};
}

Material felt() {
  return {.name = "felt",
          .description = "pressed wool of 3 mm, as of hats and pads",
          .source =
              "ASTM D2475, class 26S1: weight; an estimate from the strength of SAE felts: E of 3 MPa, and "
              "bending as of a plate, an upper bound; Sutherland Felt's chart: friction; damping: an estimate",
          .of = SheetMaterial{.area_density = 0.81,
                              .stretch_warp = 9500,
                              .stretch_weft = 9500,
                              .shear = 4000,
                              .poisson = 0.2,
                              .bending = 0.008},
          .surface = {.friction = 0.37, .damping = 1.3}};
}

Material habotai() {
  return {.name = "habotai",
          .description = "thin silk of 8 momme, as of scarves and linings",
          .source = std::string(momme),
          .of =
              SheetMaterial{
                  .area_density = 0.0347, .stretch_warp = 11000, .stretch_weft = 8600, .shear = 14, .bending = 1.35e-6},
          .surface = {.friction = 0.3, .damping = 0.75}};
}

Material leather() {
  return {.name = "leather",
          .description = "chrome-tanned upper leather of 1.2 mm, as of shoes and bags",
          .source =
              "Ashby, appendix of property data, from memory: E of 50 MPa (10 to 200), weight; a plate of it: "
              "shear, bending; friction, damping: estimates",
          .of = SheetMaterial{.area_density = 1.1,
                              .stretch_warp = 60000,
                              .stretch_weft = 60000,
                              .shear = 21000,
                              .poisson = 0.4,
                              .bending = 0.0086},
          .surface = {.friction = 0.5, .damping = 1.3}};
}

Material paper() {
  return {.name = "paper",
          .description = "office paper of 80 g/m²; the warp is its machine direction",
          .source =
              "ISO 536: weight; tensile tests, E of 5.3 GPa along and 2.5 across the machine direction; "
              "Baum et al. 1981: shear; E t³/12: bending; friction, damping: estimates",
          .of = SheetMaterial{.area_density = 0.08,
                              .stretch_warp = 560000,
                              .stretch_weft = 260000,
                              .shear = 150000,
                              .bending = 3.75e-4},
          .surface = {.friction = 0.5, .damping = 0.3}};
}

Material polyester() {
  return {.name = "polyester",
          .description = "tropical suiting in plain weave: lighter and stiffer than wool",
          .source = joined(matsudaira, kawabata, "friction: typical of cloth on itself"),
          .of =
              SheetMaterial{
                  .area_density = 0.1165, .stretch_warp = 8000, .stretch_weft = 5300, .shear = 34, .bending = 7.55e-6},
          .surface = {.friction = 0.4, .damping = 0.75}};
}

Material rubber_sheet() {
  return {.name = "rubber_sheet",
          .description = "natural latex of 0.5 mm, as of exercise bands",
          .source =
              "MatWeb, unfilled natural rubber, E of 1.5 MPa: stretch, shear, weight, bending as of a plate; "
              "Lindley 1978: damping; friction: typical of dry rubber",
          .of = SheetMaterial{.area_density = 0.475,
                              .stretch_warp = 750,
                              .stretch_weft = 750,
                              .shear = 250,
                              .poisson = 0.499,
                              .bending = 2.08e-5},
          .surface = {.friction = 1, .damping = 0.16}};
}

Material silk() {
  return {.name = "silk",
          .description = "charmeuse satin of 16 momme, as of evening dresses: limp and smooth",
          .source = std::string(momme),
          .of =
              SheetMaterial{
                  .area_density = 0.0694, .stretch_warp = 11000, .stretch_weft = 5300, .shear = 17, .bending = 2e-6},
          .surface = {.friction = 0.25, .damping = 0.75}};
}

Material steel_sheet() {
  return {.name = "steel_sheet",
          .description = "cold-rolled sheet DC01 of 0.5 mm",
          .source =
              "EN 1991-1-1, EN 1993-1-1: weight, E of 210 GPa, a plate of it; table of The Engineer's "
              "Handbook: friction; loss factor of 1e-3: damping",
          .of = SheetMaterial{.area_density = 3.925,
                              .stretch_warp = 1.05e8,
                              .stretch_weft = 1.05e8,
                              .shear = 4.04e7,
                              .poisson = 0.3,
                              .bending = 2.4},
          .surface = {.friction = 0.57, .damping = 0.003}};
}

Material wool() {
  return {.name = "wool",
          .description = "tropical worsted in plain weave, a light suiting: round, soft folds",
          .source = joined(matsudaira, kawabata, "friction: typical of cloth on itself"),
          .of =
              SheetMaterial{
                  .area_density = 0.1629, .stretch_warp = 6100, .stretch_weft = 3700, .shear = 39, .bending = 6.57e-6},
          .surface = {.friction = 0.4, .damping = 1}};
}

std::vector<Material> solids() {
  return {{.name = "foam",
           .description = "soft open-cell polyurethane, as of cushions",
           .source = "Gibson and Ashby 1997, Mills 2007, ranges of seat foams: density, E below 5 % strain, damping; "
                     "Widdle et al. 2008: Poisson's ratio; friction: an estimate",
           .of = SolidMaterial{.density = 30, .young_modulus = 1e5, .poisson = 0.3},
           .surface = {.friction = 0.8, .damping = 0.63}},
          {.name = "muscle",
           .description = "relaxed skeletal muscle",
           .source = "Isogai et al. 2022: E of 62 kPa in light compression (10 to 100); Mendez and Keys 1960: density; "
                     "nearly incompressible, 0.49 is the most that is expressed; friction, damping: estimates",
           .of = SolidMaterial{.density = 1060, .young_modulus = 6.2e4, .poisson = 0.49},
           .surface = {.friction = 0.5, .damping = 1.3}},
          {.name = "muscle_tensed",
           .description = "the same, contracted hard",
           .source = "shear moduli of 50 to 150 kPa in elastography of strong contraction; the rest as of muscle",
           .of = SolidMaterial{.density = 1060, .young_modulus = 2.5e5, .poisson = 0.49},
           .surface = {.friction = 0.5, .damping = 1.3}},
          {.name = "rubber",
           .description = "natural rubber, unfilled",
           .source = "MatWeb: density, E = 3 G of 1.5 MPa; Lindley 1978: damping; friction: typical of dry rubber; "
                     "nearly incompressible, 0.49 is the most that is expressed",
           .of = SolidMaterial{.density = 950, .young_modulus = 1.5e6, .poisson = 0.49},
           .surface = {.friction = 1, .damping = 0.16}},
          {.name = "silicone",
           .description = "very soft platinum silicone, Ecoflex 00-30, as of soft robots and skin",
           .source = std::string(marechal),
           .of = SolidMaterial{.density = 1070, .young_modulus = 5e4, .poisson = 0.49},
           .surface = {.friction = 0.8, .damping = 0.31}},
          {.name = "silicone_firm",
           .description = "firm platinum silicone, Dragon Skin 30, as of molds and actuators",
           .source = std::string(marechal),
           .of = SolidMaterial{.density = 1080, .young_modulus = 5.9e5, .poisson = 0.49},
           .surface = {.friction = 0.8, .damping = 0.31}},
          {.name = "silicone_medium",
           .description = "soft platinum silicone, Dragon Skin 10 Medium",
           .source = std::string(marechal),
           .of = SolidMaterial{.density = 1070, .young_modulus = 1.4e5, .poisson = 0.49},
           .surface = {.friction = 0.8, .damping = 0.31}},
          {.name = "steel",
           .description = "mild steel in bulk",
           .source = "EN 1993-1-1: density, E, Poisson's ratio; loss factor of 1e-3: damping; table of The "
                     "Engineer's Handbook: friction",
           .of = SolidMaterial{.density = 7850, .young_modulus = 2.1e11, .poisson = 0.3},
           .surface = {.friction = 0.57, .damping = 0.003}}};
}

std::vector<Material> all_materials() {
  std::vector<Material> all = {cotton(), denim(),     faille(),       felt(), habotai(),     leather(),
                               paper(),  polyester(), rubber_sheet(), silk(), steel_sheet(), wool()};
  std::ranges::move(solids(), std::back_inserter(all));
  return all;
}

}  // namespace

std::span<const Material> builtin_materials() {
  static const std::vector<Material> all = all_materials();
  return all;
}

const Material* find_builtin_material(std::string_view name) {
  const auto found = std::ranges::find(builtin_materials(), name, &Material::name);
  return found == builtin_materials().end() ? nullptr : &*found;
}

const Material& builtin_material(std::string_view name) {
  if (const Material* found = find_builtin_material(name)) return *found;
  std::string known;
  for (const Material& material : builtin_materials()) known += (known.empty() ? "" : ", ") + material.name;
  fail_input("unknown material '" + printable(name) + "'; known: " + known);
}

}  // namespace pliant
