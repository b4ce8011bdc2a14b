#pragma once
// Fibre strain: the stretch of a triangle along one direction of its rest shape stays between limits, as along the
// threads of a cloth.
//
//        x₂
//       ╱ d╲           z = F d, F = Ds Dm⁻¹ (3 × 2), d a unit vector in the plane of the rest triangle
//     x₀──↗─x₁         p = z/‖z‖ · clamp(‖z‖, min, max)        E = r k a/2 (‖z‖ − ‖p‖)² + (t − r) k a g(‖z‖)
//
//        g = 0 up to o; g″ rises evenly from 0 at o to 1 at s, and stays there
//
// The second term is of fibres that are t times as stiff once they are taut, at a stretch of s, and r times as stiff
// before: 1, or less of threads that are slack at rest. It is there now and then, so the factor has a part of it alone:
// all of it would keep the sheet from moving while it is slack. Both terms are found together, as one potential.
//
// Source: Bouaziz et al. 2014, Sec. 5.1 in one dimension; the same sheet at any resolution. Shear and whatever lies
// across d are free: a woven cloth is one entry along the warp, one along the weft (`angle` 90), and a
// `triangle_strain` of twice its shear modulus. At z = 0 every direction is equally near; the x axis is taken.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"
#include "pliant/constraints/edge_strain.h"
#include "pliant/constraints/grain.h"

namespace pliant {

struct FibreStrain {
  static constexpr ConstraintInfo info{"fibre_strain", "F d", "the vectors of length min to max", "½ k a (‖z‖ − ‖p‖)²",
                                       "Bouaziz et al. 2014, Sec. 5.1"};

  /// Vertices whose triangles have fibres; default: all.
  Selection on{};
  /// Triples of vertices, in place of the triangles of the mesh.
  Stencils stencils{};
  /// Of the warp, at rest, laid into the plane of each triangle; default: as `grain` says.
  Points direction{};
  /// `automatic`: v of the texture coordinates where there are any, else the axis that lies best in the surface;
  /// `uv`: v, and an error without them; `edge`: from the first to the second vertex of each triangle.
  Grain grain = Grain::automatic;
  /// From the warp to the fibre, in the plane of the triangle [degrees]; 90: the weft.
  Real angle = 0;
  /// Young's modulus times thickness along the fibre [N/m], > 0; of woven cloth about 5e3.
  Values stiffness = 1e3;
  /// Smallest stretch left alone, 0 to max_stretch.
  Values min_stretch = 1;
  /// Largest stretch left alone, from min_stretch.
  Values max_stretch = 1;
  /// How many times as stiff it is beyond taut_stretch, 1 to 1e6: woven threads are wavy, and stiff once drawn
  /// straight.
  Real taut_factor = 1;
  /// From max_stretch.
  Real taut_stretch = 1.01;
  /// How many times as stiff it is up to taut_onset, 1e-6 to 1: threads that are slack at rest.
  Real slack_factor = 1;
  /// From where on stiffness rises towards that, max_stretch to taut_stretch; none: at taut_stretch, all at once.
  std::optional<Real> taut_onset{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose triangles have fibres"}, self.on);
    field(OptionInfo{"stencils", "", "triples of vertices, in place of the triangles of the mesh"}, self.stencils);
    field(OptionInfo{"direction", "", "of the warp, at rest; it is laid into the plane of each triangle"},
          self.direction);
    field(OptionInfo{"grain", "",
                     "where no direction is given: `automatic`, v of the texture coordinates, else the axis that lies "
                     "best in the surface; `uv`, v; `edge`, from the first to the second vertex of each triangle"},
          self.grain);
    field(OptionInfo{"angle", "degrees", "from the warp to the fibre; 90: the weft"}, self.angle);
    field(OptionInfo{"stiffness", "N/m", "Young's modulus times thickness along the fibre; woven cloth about 5e3",
                     positive},
          self.stiffness);
    field(OptionInfo{"min_stretch", "", "smallest stretch left alone", not_negative}, self.min_stretch);
    field(OptionInfo{"max_stretch", "", "largest stretch left alone", not_negative}, self.max_stretch);
    field(OptionInfo{"taut_factor", "",
                     "how many times as stiff it is beyond `taut_stretch`, as threads whose waves are drawn out",
                     Range{1, 1e6}},
          self.taut_factor);
    field(OptionInfo{"slack_factor", "", "how many times as stiff it is before that, as threads that are slack at rest",
                     Range{1e-6, 1}},
          self.slack_factor);
    field(OptionInfo{"taut_stretch", "", "stretch at which it is taut", positive}, self.taut_stretch);
    field(OptionInfo{"taut_onset", "",
                     "stretch from which on stiffness rises to that, from `max_stretch` to `taut_stretch`; without it "
                     "all at once",
                     positive},
          self.taut_onset);
  }
};

struct FibreStrainProjection {
  static constexpr std::string_view name = "fibre_strain";
  static constexpr int vertices = 3;
  static constexpr int rows = 1;
  static constexpr int fields = 2;  // min, max
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr bool limits_stretches = true;
  static constexpr auto kernel = &LocalKernels::fibre_strain;
  static void project(const Real* field, const Real* z, Real* p) { EdgeStrainProjection::project(field, z, p); }
};

/// The same with fibres that get taut: energy and pull of both terms, of weight 1.
struct TautFibrePotential {
  static constexpr std::string_view name = FibreStrainProjection::name;
  static constexpr int vertices = 3;
  static constexpr int rows = 1;
  static constexpr int fields = 5;  // min, max, o, s − o > 0, t/r − 1; r is in the measure
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr bool limits_stretches = true;
  static constexpr auto kernel = &LocalKernels::taut_fibre;
  static Real potential(const Real* field, const Real* z, Real* d) {
    Real squared = find_pull<FibreStrainProjection>(field, z, d);
    const Real stretch = std::sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    const Real past = stretch - field[2];
    if (!(past > 0)) return squared;
    const Real rise = std::min(past, field[3]), over = past - rise;
    const Real pull = field[4] * (rise * (rise / field[3]) / 2 + over);
    for (std::size_t axis = 0; axis < 3; ++axis) d[axis] -= pull / stretch * z[axis];
    return squared + field[4] * (rise * (rise / field[3]) * rise / 3 + over * past) / 2;
  }
};

/// Throws Error(input) on a triangle without area, one that the direction is normal to, `uv` where a triangle has none,
/// min above max, an index out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const FibreStrain& options);

}  // namespace pliant
