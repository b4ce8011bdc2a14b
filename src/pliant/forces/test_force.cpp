#include "pliant/forces/test_force.h"

#include <fmt/format.h>

namespace pliant {
namespace {

class TimedForce final : public Force {
 public:
  TimedForce(std::vector<Index> vertices, const TestForce& options)
      : vertices_(std::move(vertices)), options_(options) {}

  std::string_view type() const override { return TestForce::info.name; }
  std::unique_ptr<Force> copy() const override { return std::make_unique<TimedForce>(*this); }

  void add_to(Positions& forces, const StateView& state, Real) override {
    if (!options_.is_active(state.step)) return;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      forces.row(vertices_[i]) += options_.force[static_cast<Index>(i)].transpose();
    }
  }

 private:
  std::vector<Index> vertices_;
  TestForce options_;
};

}  // namespace

std::unique_ptr<Force> build(const ForceScope& scope, const TestForce& options) {
  constexpr std::string_view type = TestForce::info.name;
  check_options(type, options);
  std::vector<Index> vertices = selected_vertices(type, scope, options.vertices);
  if (options.force.empty() || (options.force.each() && options.force.list().size() != vertices.size())) {
    fail_input(fmt::format("{}: {} forces for {} vertices; give one for all, or one each", type,
                           options.force.list().size(), vertices.size()));
  }
  const auto [first, end] = options.frames;
  if (first < 0 || first >= end) {
    fail_input(
        fmt::format("{}: the frames [{}, {}) are none; give a first frame from 0 and a later end", type, first, end));
  }
  return std::make_unique<TimedForce>(std::move(vertices), options);
}

}  // namespace pliant
