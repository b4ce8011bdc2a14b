#pragma once
// What bodies are made of, by what is measured of it: so much a square meter, so stiff along its threads.
//
//     const Material& cotton = builtin_material("cotton");
//     const BodyId sheet = simulation.add_body(mesh, mass_of(cotton));
//     add_material(simulation, sheet, cotton);
//
// docs/materials.md has the table, and where every number comes from.
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "pliant/core/options.h"

namespace pliant {

/// Cloth and other sheets: what meshes of triangles are made of.
struct SheetMaterial {
  /// Mass per area [kg/m²], > 0.
  Real area_density = 0.15;
  /// Young's modulus times thickness along the warp [N/m], > 0.
  Real stretch_warp = 5e3;
  /// The same along the weft.
  Real stretch_weft = 5e3;
  /// Shear modulus times thickness [N/m], > 0: the force on a side of length one that turns warp against weft by a
  /// radian. Of woven cloth a hundredth of the others.
  Real shear = 50;
  /// Poisson's ratio, 0 to 0.5, of a sheet without threads, where warp and weft are alike; of others it is not
  /// expressed.
  Real poisson = 0;
  /// Bending rigidity [N·m], > 0.
  Real bending = 1e-5;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"area_density", "kg/m²", "mass per area", positive}, self.area_density);
    field(OptionInfo{"stretch_warp", "N/m", "Young's modulus times thickness along the warp", positive},
          self.stretch_warp);
    field(OptionInfo{"stretch_weft", "N/m", "the same along the weft", positive}, self.stretch_weft);
    field(OptionInfo{"shear", "N/m", "shear modulus times thickness", positive}, self.shear);
    field(OptionInfo{"poisson", "", "Poisson's ratio, of a sheet whose warp and weft are alike", Range{0, 0.5}},
          self.poisson);
    field(OptionInfo{"bending", "N·m", "bending rigidity", positive}, self.bending);
  }
};

/// Soft bodies: what meshes of tetrahedra are made of.
struct SolidMaterial {
  /// Mass per volume [kg/m³], > 0.
  Real density = 1000;
  /// E [Pa], > 0.
  Real young_modulus = 1e5;
  /// ν, 0 to 0.49: strain and volume together express it at large stretches as well.
  Real poisson = 0.45;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"density", "kg/m³", "mass per volume", positive}, self.density);
    field(OptionInfo{"young_modulus", "Pa", "E", positive}, self.young_modulus);
    field(OptionInfo{"poisson", "", "Poisson's ratio", Range{0, 0.49}}, self.poisson);
  }
};

/// What a sheet and a solid both have.
struct SurfaceMaterial {
  /// μ of Coulomb's law on itself, ≥ 0.
  Real friction = 0.4;
  /// c [1/s], ≥ 0: vibrations decay as e^(−ct). 2π times the damping ratio at 1 Hz.
  Real damping = 1;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"friction", "", "μ of Coulomb's law on itself", not_negative}, self.friction);
    field(OptionInfo{"damping", "1/s", "vibrations decay as e^(-damping t)", not_negative}, self.damping);
  }
};

struct Material {
  std::string name;
  std::string description{};  ///< a line
  std::string source{};       ///< where its numbers come from
  std::variant<SheetMaterial, SolidMaterial> of{};
  SurfaceMaterial surface{};

  bool is_sheet() const { return std::holds_alternative<SheetMaterial>(of); }
};

/// Those that come with the library: sheets, then solids, each by name.
std::span<const Material> builtin_materials();

/// The one of that name; null where there is none.
const Material* find_builtin_material(std::string_view name);

/// The same. Throws Error(input) that names those there are.
const Material& builtin_material(std::string_view name);

}  // namespace pliant
