#include "pliant/constraints/position.h"

#include <algorithm>

#include "pliant/constraints/build.h"
#include "pliant/core/error.h"

namespace pliant {

std::unique_ptr<ConstraintGroup> HardPins::reordered(std::span<const Index>, std::span<const Index> numbers) const {
  auto pins = std::make_unique<HardPins>();
  for (const Index vertex : held_) pins->held_.push_back(numbers[static_cast<std::size_t>(vertex)]);
  pins->targets_ = targets_;
  return pins;
}

void HardPins::sync_parameters(const ConstraintGroup& from, std::span<const Index> order) {
  ConstraintGroup::sync_parameters(from, order);
  std::ranges::copy(dynamic_cast<const HardPins&>(from).targets_, targets_.begin());
}

void HardPins::add(Index vertex, const Vec3& target) {
  held_.push_back(vertex);
  targets_.insert(targets_.end(), target.begin(), target.end());
  changed();
}

ConstraintSet build(const BodyView& body, const Position& options) {
  constexpr std::string_view type = Position::info.name;
  const Stencils chosen = choose_vertices(type, body, options.on, options.stencils);
  check_length(type, "targets", options.targets, chosen.size());
  const auto target = [&](Index i) {
    return options.targets.empty() ? row(body.start, chosen[i][0]) : options.targets[i];
  };
  if (options.hold == Hold::hard) {
    of_stencils(type, body, "stiffness", options.stiffness, chosen);  // of no use, but refused where a soft pin would
    auto pins = std::make_unique<HardPins>();
    for (Index i = 0; i < chosen.size(); ++i) pins->add(body.first_vertex + chosen[i][0], target(i));
    ConstraintSet set;
    set.count = chosen.size();
    if (set.count > 0) set.batches.push_back(std::move(pins));
    return set;
  }
  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<PositionProjection>>(stiffness.common());
  const Real one = 1;
  for (Index i = 0; i < chosen.size(); ++i) {
    const Vec3 point = target(i);
    batch->add(global_stencil(body, chosen[i]), {&one, 1}, stiffness.of(i), {point.data(), 3});
  }
  return one_batch(std::move(batch));
}

namespace {

/// Which constraints of a batch stay, given the vertex of each.
std::vector<std::size_t> kept_places(std::span<const Index> vertices, std::span<const Index> released) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!std::ranges::binary_search(released, vertices[i])) kept.push_back(i);
  }
  return kept;
}

std::unique_ptr<ConstraintGroup> release(HardPins& pins, std::span<const Index> released) {
  auto rest = std::make_unique<HardPins>();
  for (const std::size_t i : kept_places(pins.pinned_vertices(), released)) {
    rest->add(pins.pinned_vertices()[i], Eigen::Map<const Vec3>(pins.targets().subspan(3 * i, 3).data()));
  }
  return rest;
}

std::unique_ptr<ConstraintGroup> release(const Batch<PositionProjection>& pins, std::span<const Index> released) {
  auto rest = std::make_unique<Batch<PositionProjection>>(pins.stiffness());
  for (const std::size_t i : kept_places(pins.stencil(), released)) {
    rest->add(pins.stencil().subspan(i, 1), pins.reduction().subspan(i, 1), pins.rest_measure()[i],
              pins.fields().subspan(3 * i, 3));
  }
  return rest;
}

}  // namespace

ConstraintSet release(const ConstraintSet& positions, std::span<const Index> vertices) {
  std::vector<Index> released(vertices.begin(), vertices.end());
  std::ranges::sort(released);
  ConstraintSet rest;
  std::vector<Index> all;
  for (const auto& batch : positions.batches) {
    std::unique_ptr<ConstraintGroup> kept;
    if (auto* pins = dynamic_cast<HardPins*>(batch.get())) {
      kept = release(*pins, released);
      all.insert(all.end(), pins->pinned_vertices().begin(), pins->pinned_vertices().end());
    } else if (const auto* soft = dynamic_cast<const Batch<PositionProjection>*>(batch.get())) {
      kept = release(*soft, released);
      all.insert(all.end(), soft->stencil().begin(), soft->stencil().end());
    } else {
      fail_input(std::string(batch->type()) + ": only positions can be released; remove the group, or replace it");
    }
    const auto count = static_cast<Index>(kept->targets().size() / 3);
    rest.count += count;
    if (count > 0) rest.batches.push_back(std::move(kept));
  }
  std::ranges::sort(all);
  for (const Index vertex : released) {
    if (std::ranges::binary_search(all, vertex)) continue;
    fail_input("vertex " + std::to_string(vertex) + " is not pinned here, so it cannot be released; leave it out");
  }
  return rest;
}

}  // namespace pliant
