#include "pliant/forces/wind.h"

#include <algorithm>

#include "pliant/forces/air_drag.h"

namespace pliant {
namespace {

/// The thesis' wind is a force at qₙ; the relative one is a group inside the minimization.
class WindForce final : public Force {
 public:
  WindForce(SurfaceTriangles surface, const Wind& options) : surface_(std::move(surface)), options_(options) {
    if (has_drag(options)) drag_ = std::make_unique<AirDrag>(surface_, options_);
  }

  std::string_view type() const override { return Wind::info.name; }
  std::string remedy() const override {
    return options_.model == WindModel::relative ? "reduce its velocity or its drag"
                                                 : "reduce it, or give it `area` `rest` or the model `relative`";
  }

  std::vector<ConstraintGroup*> groups() const override {
    return drag_ ? std::vector<ConstraintGroup*>{drag_.get()} : std::vector<ConstraintGroup*>();
  }

  bool exchange(Force& other) override {
    auto* wind = dynamic_cast<WindForce*>(&other);
    if (wind == nullptr || has_drag(wind->options_) != has_drag(options_) || wind->surface_ != surface_) return false;
    std::swap(options_, wind->options_);
    return true;
  }

  std::unique_ptr<Force> copy() const override { return std::make_unique<WindForce>(surface_, options_); }

  void add_to(Positions& forces, const StateView& state, Real) override {
    if (options_.model != WindModel::thesis) return;
    const Vec3 air = air_velocity(options_, state.time);
    share_.setZero(forces.rows(), 3);
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const WindFace face = wind_face(surface_, t, state.positions, options_.area);
      const Vec3 force = face.area * face.normal.dot(air) * face.normal;
      for (const Index vertex : surface_.triangles[t]) share_.row(vertex) += force.transpose() / 3;
    }
    forces += share_;
  }

  std::optional<Index> vertex_out_of_range(Index vertex_count) const override {
    for (const Triangle& triangle : surface_.triangles) {
      for (const Index vertex : triangle) {
        if (vertex < 0 || vertex >= vertex_count) return vertex;
      }
    }
    return std::nullopt;
  }

 private:
  static bool has_drag(const Wind& options) { return options.model == WindModel::relative && options.drag > 0; }

  SurfaceTriangles surface_;
  Wind options_;
  std::unique_ptr<AirDrag> drag_;  // refers to both
  Positions share_;                // scratch: this wind's force on each vertex
};

}  // namespace

std::unique_ptr<Force> build(const ForceScope& scope, const Wind& options) {
  check_options(Wind::info.name, options);
  SurfaceTriangles surface(scope);
  if (surface.triangles.empty()) {
    fail_input("wind: there are no triangles for it to blow on; give it a body that has some");
  }
  return std::make_unique<WindForce>(std::move(surface), options);
}

}  // namespace pliant
