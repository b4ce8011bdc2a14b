#include "pliant/constraints/fibre_strain.h"

#include <numbers>

#include <fmt/format.h>

#include "pliant/constraints/build.h"
#include "pliant/constraints/strain_rest.h"

namespace pliant {
namespace {

/// Of what taut fibres have beyond the others, in the factor: with less, moves are taken back often, with more, the
/// sheet moves too little.
constexpr Real taut_share = 0.25;
/// Width of a rise in stiffness that is made at once.
constexpr Real least_rise = 1e-30;

void check_taut(std::string_view type, const FibreStrain& options, const Limits& limits, Index count) {
  const auto check_from_max = [&](std::string_view name, Real stretch) {
    for (Index i = 0; i < count; ++i) {
      if (stretch >= limits[i][1]) continue;
      fail_input(
          fmt::format("{}: {}: {} is below max_stretch {}; give at least as much", type, name, stretch, limits[i][1]));
    }
  };
  check_from_max("taut_stretch", options.taut_stretch);
  const Real onset = options.taut_onset.value_or(options.taut_stretch);
  check_from_max("taut_onset", onset);
  if (onset <= options.taut_stretch) return;
  fail_input(fmt::format("{}: taut_onset: {} is above taut_stretch {}; give at most as much", type, onset,
                         options.taut_stretch));
}

}  // namespace

ConstraintSet build(const BodyView& body, const FibreStrain& options) {
  constexpr std::string_view type = FibreStrain::info.name;
  const Stencils chosen = choose_stencils(
      type, body, options.on, options.stencils, [&] { return to_stencils(body.rest.triangles); }, 3);
  const Limits limits(type, body, "stretch", options.min_stretch, options.max_stretch, chosen);
  const std::vector<Vec2> warp = warp_directions(type, body, chosen, options.direction, options.grain);
  const Eigen::Rotation2D<Real> turn(options.angle * std::numbers::pi / 180);

  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  const Real rise_factor = options.taut_factor / options.slack_factor;
  const bool gets_taut = rise_factor > 1;
  if (gets_taut) check_taut(type, options, limits, chosen.size());
  const Real onset = options.taut_onset.value_or(options.taut_stretch);
  const Real rise = std::max(options.taut_stretch - onset, least_rise);
  std::unique_ptr<Batch<FibreStrainProjection>> batch;
  std::unique_ptr<Batch<TautFibrePotential>> taut;
  if (gets_taut) {
    taut = std::make_unique<Batch<TautFibrePotential>>(stiffness.common());
    taut->set_factor_share(1 + taut_share * (rise_factor - 1));
  } else {
    batch = std::make_unique<Batch<FibreStrainProjection>>(stiffness.common());
  }
  for (Index i = 0; i < chosen.size(); ++i) {
    const auto corner = [&](std::size_t j) { return row(body.rest.vertices, chosen[i][j]); };
    const RestElement<3> rest = rest_triangle(corner(0), corner(1), corner(2));
    check_rest_measure(type, body, i, rest.measure, "area; leave it out, or fix its vertices");
    const Vec2 d = turn * warp[static_cast<std::size_t>(i)];
    std::array<Real, 3> along;
    for (std::size_t j = 1; j < 3; ++j) along[j] = d[0] * rest.reduction[j] + d[1] * rest.reduction[3 + j];
    along[0] = -(along[1] + along[2]);
    const Real measure = stiffness.of(i) * rest.measure;
    if (gets_taut) {
      const std::array<Real, 5> fields = {limits[i][0], limits[i][1], onset, rise, rise_factor - 1};
      taut->add(global_stencil(body, chosen[i]), along, options.slack_factor * measure, fields);
    } else {
      batch->add(global_stencil(body, chosen[i]), along, measure, limits[i]);
    }
  }
  return gets_taut ? one_batch(std::move(taut)) : one_batch(std::move(batch));
}

}  // namespace pliant
