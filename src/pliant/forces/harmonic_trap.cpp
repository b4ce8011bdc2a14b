#include "pliant/forces/harmonic_trap.h"

#include <algorithm>
#include <limits>

namespace pliant {
namespace {

class HarmonicTrapForce final : public Force {
 public:
  HarmonicTrapForce(const HarmonicTrap& options, Index first, Index end)
      : options_(options), first_(first), end_(end) {}

  std::string_view type() const override { return HarmonicTrap::info.name; }

  void add_to(Positions& forces, const StateView& state, Real) override {
    const Index end = std::min(end_, static_cast<Index>(forces.rows()));
    const Real rate = options_.frequency * options_.frequency;
    for (Index i = first_; i < end; ++i) {
      forces.row(i) +=
          state.masses[static_cast<std::size_t>(i)] * rate * (options_.center.transpose() - state.positions.row(i));
    }
  }

  Real potential(const StateView& state) const override {
    Real energy = 0;
    const Index end = std::min(end_, static_cast<Index>(state.positions.rows()));
    const Real rate = options_.frequency * options_.frequency;
    for (Index i = first_; i < end; ++i) {
      energy += state.masses[static_cast<std::size_t>(i)] * rate / 2 *
                (state.positions.row(i) - options_.center.transpose()).squaredNorm();
    }
    return energy;
  }
  bool is_conservative() const override { return true; }

 private:
  HarmonicTrap options_;
  Index first_;
  Index end_;
};

}  // namespace

std::unique_ptr<Force> build(const ForceScope& scope, const HarmonicTrap& options) {
  check_options(HarmonicTrap::info.name, options);
  if (scope.is_whole) return std::make_unique<HarmonicTrapForce>(options, 0, std::numeric_limits<Index>::max());
  const ForceBody& body = only_body(HarmonicTrap::info.name, scope);
  return std::make_unique<HarmonicTrapForce>(options, body.first_vertex, body.first_vertex + body.rest.vertex_count());
}

}  // namespace pliant
