#include "pliant/constraints/position.h"

#include "pliant/constraints/build.h"

namespace pliant {
void HardPins::add(Index vertex, const Vec3& target) {
  held_.push_back(vertex);
  targets_.insert(targets_.end(), target.begin(), target.end());
  changed();
}

ConstraintSet build(const BodyView& body, const Position& options) {
  constexpr std::string_view type = Position::info.name;
  const Stencils chosen = choose_stencils(type, body, options.on, options.stencils, every_vertex(body), 1);
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
    if (set.count > 0) set.parts.push_back(std::move(pins));
    return set;
  }
  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<PositionProjection>>(stiffness.common());
  const Real one = 1;
  for (Index i = 0; i < chosen.size(); ++i) {
    const Vec3 point = target(i);
    batch->add(global_stencil(body, chosen[i]), {&one, 1}, stiffness.of(i), {point.data(), 3});
  }
  return one_part(std::move(batch));
}

}  // namespace pliant
