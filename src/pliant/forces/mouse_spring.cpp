#include "pliant/forces/mouse_spring.h"

#include <fmt/format.h>

namespace pliant {
namespace {

class MouseSpringForce final : public Force {
 public:
  MouseSpringForce(std::vector<Index> vertices, const MouseSpring& options)
      : vertices_(std::move(vertices)), options_(options) {}

  std::string_view type() const override { return MouseSpring::info.name; }
  bool is_conservative() const override { return true; }
  bool is_explicit_spring() const override { return true; }
  std::unique_ptr<Force> copy() const override { return std::make_unique<MouseSpringForce>(*this); }

  void add_to(Positions& forces, const StateView& state, Real) override {
    for (const Index vertex : vertices_) {
      const Vec3 d = options_.anchor - row(state.positions, vertex);
      const Real length = d.stableNorm();
      if (!(length > 0)) continue;  // no direction, no force
      forces.row(vertex) += (options_.stiffness * (length - options_.rest_length) / length * d).transpose();
    }
  }

  Real potential(const StateView& state) const override {
    Real energy = 0;
    for (const Index vertex : vertices_) {
      const Real stretch = (options_.anchor - row(state.positions, vertex)).stableNorm() - options_.rest_length;
      energy += options_.stiffness / 2 * stretch * stretch;
    }
    return energy;
  }

  std::optional<std::string> warning(const StateView& state, Real time_step) const override {
    for (const Index vertex : vertices_) {
      const Real mass = state.masses[static_cast<std::size_t>(vertex)];
      const Real limit = 4 * mass / (time_step * time_step);
      if (options_.stiffness < limit) continue;
      return fmt::format(
          "mouse_spring on vertex {}: stiffness {} N/m is not below the explicit spring's limit 4 m/h² = {} N/m, so it "
          "may grow without bound; use a drag, which has no limit",
          vertex, options_.stiffness, limit);
    }
    return std::nullopt;
  }

 private:
  std::vector<Index> vertices_;
  MouseSpring options_;
};

}  // namespace

std::unique_ptr<Force> build(const ForceScope& scope, const MouseSpring& options) {
  check_options(MouseSpring::info.name, options);
  return std::make_unique<MouseSpringForce>(selected_vertices(MouseSpring::info.name, scope, options.vertices),
                                            options);
}

}  // namespace pliant
