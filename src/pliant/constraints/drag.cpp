#include "pliant/constraints/drag.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "pliant/constraints/build.h"
#include "pliant/core/error.h"

namespace pliant {
namespace {

std::vector<Real> weights_of(const Drag& options, Index i) {
  const std::size_t size = options.stencils[i].size();
  const std::string where = "drag: stencil " + std::to_string(i);
  if (size < 1 || size > 4) {
    fail_input(where + " has " + std::to_string(size) + " vertices; give the one to four of an element");
  }
  if (options.weights.empty()) return std::vector<Real>(size, 1 / static_cast<Real>(size));
  const std::span<const Real> given = options.weights[i];
  const Real sum = std::accumulate(given.begin(), given.end(), Real(0));
  if (given.size() != size || !(std::abs(sum - 1) <= 1e-6)) {
    fail_input(fmt::format("{} has {} weights with the sum {}; give one for each vertex, with the sum 1", where,
                           given.size(), sum));
  }
  return {given.begin(), given.end()};
}

}  // namespace

ConstraintSet build(const BodyView& body, const Drag& options) {
  constexpr std::string_view type = Drag::info.name;
  const Index count = options.stencils.size();
  if (count == 0) fail_input("drag: stencils are missing; name the vertices of the point to be dragged");
  choose_stencils(
      type, body, {}, options.stencils, [] { return Stencils(); }, 0);
  check_length(type, "weights", static_cast<std::size_t>(options.weights.size()), !options.weights.empty(), count);
  check_length(type, "targets", options.targets, count);

  const StiffnessSplit stiffness(type, body, options.stiffness, options.stencils);
  ConstraintSet set;
  set.count = count;
  Batch<DragProjection>* batch = nullptr;
  for (Index i = 0; i < count; ++i) {
    const std::span<const Index> stencil = options.stencils[i];
    const std::vector<Real> weights = weights_of(options, i);
    Vec3 target = Vec3::Zero();
    for (std::size_t j = 0; j < stencil.size(); ++j) target += weights[j] * row(body.start, stencil[j]);
    if (!options.targets.empty()) target = options.targets[i];
    const auto size = static_cast<int>(stencil.size());
    if (batch == nullptr || batch->shape().vertices != size) {  // a batch for each run of one size keeps the order
      auto added = std::make_unique<Batch<DragProjection>>(stiffness.common(), size);
      batch = added.get();
      set.batches.push_back(std::move(added));
    }
    batch->add(global_stencil(body, stencil), weights, stiffness.of(i), {target.data(), 3});
  }
  return set;
}

}  // namespace pliant
