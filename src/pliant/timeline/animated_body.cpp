#include "pliant/timeline/animated_body.h"

#include <numeric>

#include <fmt/format.h>

#include "pliant/constraints/position.h"
#include "pliant/simulation/transaction.h"

namespace pliant {

GroupId animate(Simulation& simulation, Timeline& timeline, BodyId body, std::shared_ptr<Path> path, std::string name) {
  if (name.empty()) name = fmt::format("{}.animation", simulation.body(body).name);
  Transaction transaction(simulation);
  const GroupId held = simulation.add(body, Position{}, std::move(name));
  if (path) timeline.start(simulation, held, std::move(path));
  transaction.commit();
  return held;
}

std::shared_ptr<Path> play(std::shared_ptr<PointAnimation> animation) {
  std::vector<Index> points(static_cast<std::size_t>(animation->point_count()));
  std::iota(points.begin(), points.end(), Index{0});
  return follow_animation(std::move(animation), std::move(points), Attach::exact);
}

}  // namespace pliant
