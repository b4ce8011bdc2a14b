// Energies and forces near rest are found from G, which is small there, since what is left of larger numbers would be
// their rounding: an objective that falls must be seen to fall.
#include "pliant/constraints/hyperelastic.h"

#include <cmath>
#include <limits>

#include "pliant/constraints/element_batch.h"
#include "pliant/core/svd.h"

namespace pliant {
namespace {

struct Moduli {
  Real mu, lambda;
};

template <int columns>
using Square = Eigen::Matrix<Real, columns, columns>;

/// Of a Young's modulus of 1: Lamé's, of triangles those of plane stress.
Moduli lame(Real poisson_ratio, int columns) {
  const Real nu = poisson_ratio;
  return {1 / (2 * (1 + nu)), columns == 3 ? nu / ((1 + nu) * (1 - 2 * nu)) : nu / (1 - nu * nu)};
}

/// Those with which the law has these of Lamé's at rest.
Moduli moduli_of(NeoHookean, Moduli lame, int columns) {
  if (columns == 3) return {4 * lame.mu / 3, lame.lambda + 5 * lame.mu / 6};
  return {lame.mu, lame.lambda + lame.mu};
}
Moduli moduli_of(StVenantKirchhoff, Moduli lame, int) {
  return lame;
}

template <int columns>
Square<columns> green_strain(const ThreeRows<columns>& F) {
  return (F.transpose() * F - Square<columns>::Identity()) / 2;
}

template <int columns>
bool is_near_rest(const Square<columns>& G) {
  return G.squaredNorm() < 0.01;
}

Real second_invariant(const Square<3>& G) {
  return (G.trace() * G.trace() - G.squaredNorm()) / 2;
}

/// J² − 1 = det(I + 2G) − 1
Real square_less_one(const Square<2>& G) {
  return 2 * G.trace() + 4 * G.determinant();
}
Real square_less_one(const Square<3>& G) {
  return 2 * G.trace() + 4 * second_invariant(G) + 8 * G.determinant();
}

/// J, and its gradient.
Real measure_of(const ThreeRows<3>& F, ThreeRows<3>& gradient) {
  gradient.col(0) = F.col(1).cross(F.col(2));
  gradient.col(1) = F.col(2).cross(F.col(0));
  gradient.col(2) = F.col(0).cross(F.col(1));
  return F.col(0).dot(gradient.col(0));
}
/// What has no area has no direction in which it would gain some.
Real measure_of(const ThreeRows<2>& F, ThreeRows<2>& gradient) {
  const Vec3 n = F.col(0).cross(F.col(1));
  const Real area = n.norm();
  const Vec3 unit = area > 0 ? Vec3(n / area) : Vec3(Vec3::Zero());
  gradient.col(0) = F.col(1).cross(unit);
  gradient.col(1) = unit.cross(F.col(0));
  return area;
}

/// x − ln(1 + x)
Real less_logarithm(Real x) {
  if (std::abs(x) > 1e-3) return x - std::log1p(x);
  return x * x * (0.5 - x * (1.0 / 3 - x * (0.25 - x * (0.2 - x / 6))));
}

/// Ψ less that at rest, with t = tr C − 3 and d = J − 1, for which t − 2d = d² − 4 G₂ − 8 G₃ (invariants of G).
Real neo_hookean_energy(const Moduli& moduli, const Square<3>& G, Real d, bool is_near) {
  const Real t = 2 * G.trace();
  const Real unlike = is_near ? d * d - 4 * second_invariant(G) - 8 * G.determinant() : t - 2 * d;
  return moduli.mu / 2 * less_logarithm(t / 4) + 3 * moduli.mu / 8 * unlike + moduli.lambda / 2 * d * d;
}
Real neo_hookean_energy(const Moduli& moduli, const Square<2>& G, Real d, bool is_near) {
  const Real unlike = is_near ? d * d - 4 * G.determinant() : 2 * G.trace() - 2 * d;
  return moduli.mu / 2 * unlike + moduli.lambda / 2 * d * d;
}

/// Of F and of the gradient of J in P.
std::array<Real, 2> neo_hookean_factors(const Moduli& moduli, const Square<3>& G, Real d) {
  return {moduli.mu * (1 - 1 / (2 * G.trace() + 4)), moduli.lambda * d - 3 * moduli.mu / 4};
}
std::array<Real, 2> neo_hookean_factors(const Moduli& moduli, const Square<2>&, Real d) {
  return {moduli.mu, moduli.lambda * d - moduli.mu};
}

/// Writes P = dΨ/dF; returns Ψ.
template <int columns>
Real evaluate(NeoHookean, const Moduli& moduli, const ThreeRows<columns>& F, ThreeRows<columns>& P) {
  const Square<columns> G = green_strain<columns>(F);
  ThreeRows<columns> gradient;
  const Real J = measure_of(F, gradient);
  const bool is_near = is_near_rest<columns>(G) && J > 0;
  const Real d = is_near ? square_less_one(G) / (J + 1) : J - 1;
  const std::array<Real, 2> factors = neo_hookean_factors(moduli, G, d);
  P = factors[0] * F + factors[1] * gradient;
  return neo_hookean_energy(moduli, G, d, is_near);
}

template <int columns>
Real evaluate(StVenantKirchhoff, const Moduli& moduli, const ThreeRows<columns>& F, ThreeRows<columns>& P) {
  const Square<columns> G = green_strain<columns>(F);
  P = F * (2 * moduli.mu * G + moduli.lambda * G.trace() * Square<columns>::Identity());
  return moduli.mu * G.squaredNorm() + moduli.lambda / 2 * G.trace() * G.trace();
}

template <class Law, int columns, class Options>
ConstraintSet build_potential(const BodyView& body, const Options& options) {
  const Moduli at_rest = lame(options.poisson_ratio, columns);
  const Real curvature = 2 * at_rest.mu + at_rest.lambda;
  const Moduli moduli = moduli_of(Law{}, at_rest, columns);
  const std::array<Real, 2> fields = {moduli.mu / curvature, moduli.lambda / curvature};
  using Potential = ElasticPotential<Law, columns>;
  const ElementOptions elements{Options::info.name, options.on, options.stencils, options.stiffness};
  return build_elements<Potential>(body, elements, choose_elements<Potential>(body, elements), curvature,
                                   [&](Index) { return fields; });
}

}  // namespace

/// Nothing but rounding is left of a force where all is at rest; its torque would set a free body turning.
template <class Law, int columns>
Real ElasticPotential<Law, columns>::potential(const Real* field, const Real* z, Real* d) {
  constexpr Real rounding = 64 * std::numeric_limits<Real>::epsilon();
  const ThreeRows<columns> F = Eigen::Map<const ThreeRows<columns>>(z);  // row a of z is column a of F
  ThreeRows<columns> P;
  const Real energy = evaluate<columns>(Law{}, {field[0], field[1]}, F, P);
  if (P.norm() <= rounding * (field[0] + field[1])) P.setZero();
  Eigen::Map<ThreeRows<columns>> to(d);
  to = -P;
  return energy;
}

template <class Law>
ConstraintSet build(const BodyView& body, const ElasticTetrahedra<Law>& options) {
  return build_potential<Law, 3>(body, options);
}
template <class Law>
ConstraintSet build(const BodyView& body, const ElasticTriangles<Law>& options) {
  return build_potential<Law, 2>(body, options);
}

template struct ElasticPotential<NeoHookean, 2>;
template struct ElasticPotential<NeoHookean, 3>;
template struct ElasticPotential<StVenantKirchhoff, 2>;
template struct ElasticPotential<StVenantKirchhoff, 3>;
template ConstraintSet build(const BodyView& body, const TetrahedronNeoHookean& options);
template ConstraintSet build(const BodyView& body, const TetrahedronStvk& options);
template ConstraintSet build(const BodyView& body, const TriangleNeoHookean& options);
template ConstraintSet build(const BodyView& body, const TriangleStvk& options);

}  // namespace pliant
