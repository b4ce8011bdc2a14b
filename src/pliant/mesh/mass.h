#pragma once
// How much each vertex weighs: a choice of ways to say it, and the lumped masses that follow.
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// How a body's mass is given. Every value must be finite and > 0, which vertex_masses checks.
class Mass {
 public:
  enum class Kind { per_vertex, total, area_density, density, line_density, each };

  /// The same mass for every vertex [kg]. It makes a refined mesh heavier.
  static Mass per_vertex(Real mass) { return Mass(Kind::per_vertex, {mass}); }
  /// The whole body's mass [kg], shared out by volume, by area or by length, whichever elements of the highest
  /// dimension the mesh has; equally when it has none.
  static Mass total(Real mass) { return Mass(Kind::total, {mass}); }
  /// Mass per area of the triangles [kg/m²]; cotton has about 0.15.
  static Mass area_density(Real density) { return Mass(Kind::area_density, {density}); }
  /// Mass per volume of the tetrahedra [kg/m³]; rubber has about 1100.
  static Mass density(Real density) { return Mass(Kind::density, {density}); }
  /// Mass per length of Mesh::edges [kg/m]; a climbing rope has about 0.06.
  static Mass line_density(Real density) { return Mass(Kind::line_density, {density}); }
  /// One mass for each vertex [kg].
  static Mass each(std::vector<Real> masses) { return Mass(Kind::each, std::move(masses)); }

  /// Both: planks by their volume and ropes by their length, say.
  friend Mass operator+(Mass a, const Mass& b) {
    a.parts_.insert(a.parts_.end(), b.parts_.begin(), b.parts_.end());
    return a;
  }

  /// What is added up.
  struct Part {
    Kind kind;
    std::vector<Real> values;  ///< one in the unit of the kind; for `each`, one for each vertex
  };
  std::span<const Part> parts() const { return parts_; }

 private:
  Mass(Kind kind, std::vector<Real> values) { parts_.push_back({kind, std::move(values)}); }

  std::vector<Part> parts_;
};

/// The mass of each vertex [kg], lumped: every element gives equal parts to its vertices (Bouaziz et al. 2014, section
/// 2: M is the lumped, diagonal mass matrix). `name` is what messages call the body.
/// @pre check_mesh(mesh).
/// @throws Error (input): a value that is not finite and > 0, a vertex that ends without a positive finite mass (a
///   density gives none to a vertex without elements), a kind of density whose elements the mesh lacks, a wrong count.
std::vector<Real> vertex_masses(const Mesh& mesh, const Mass& mass, std::string_view name);

}  // namespace pliant
