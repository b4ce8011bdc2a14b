#include "pliant/simulation/group_stiffness.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "pliant/constraints/attachment.h"
#include "pliant/constraints/edge_strain.h"
#include "pliant/constraints/fibre_strain.h"

namespace pliant {
namespace {

/// Looks for the unit of the stiffness.
class UnitFinder final : public OptionLister {
 public:
  std::string_view unit;

  void list(const OptionInfo& info, const Values&) override { look_at(info); }
  void list(const OptionInfo& info, const Real&) override { look_at(info); }
  void list(const OptionInfo&, const Index&) override {}
  void list(const OptionInfo&, const std::optional<Real>&) override {}
  void list(const OptionInfo&, const bool&) override {}
  void list(const OptionInfo&, const Vec3&) override {}
  void list(const OptionInfo&, const Points&) override {}
  void list(const OptionInfo&, std::span<const std::string_view>, int) override {}

 private:
  void look_at(const OptionInfo& info) {
    if (info.name == "stiffness") unit = info.unit;
  }
};

/// Numbers for each vertex of a body, or none, which stand for 1.
struct VertexFactors {
  const std::vector<Real>& numbers;
  Index first_vertex;

  Real mean(std::span<const Index> stencil) const {
    if (numbers.empty()) return 1;
    Real sum = 0;
    for (const Index vertex : stencil) sum += numbers[static_cast<std::size_t>(vertex - first_vertex)];
    return sum / static_cast<Real>(stencil.size());
  }
};

/// The range of what the constraints multiply the stiffness of their group by, each after its vertices.
std::pair<Real, Real> range_by_vertices(const Group& group, const VertexFactors& values, const VertexFactors& factors) {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  std::pair<Real, Real> range{infinity, -infinity};
  for (const auto& batch : group.set.batches) {
    const auto n = static_cast<std::size_t>(batch->shape().vertices);
    for (std::size_t i = 0; i < batch->rest_measure().size(); ++i) {
      const std::span<const Index> stencil = batch->stencil().subspan(i * n, n);
      const Real own = values.mean(stencil) * factors.mean(stencil);
      range = {std::min(range.first, own), std::max(range.second, own)};
    }
  }
  return range;
}

}  // namespace

std::string_view stiffness_unit(const Group& group) {
  if (const auto* fibers = options_in<EdgeStrain>(group)) return fibers->measure == FibreMeasure::rope ? "N" : "N/m";
  if (const auto* ties = options_in<Attachment>(group)) return is_seam(ties->mode) ? "N/m²" : "N/m";
  UnitFinder finder;
  if (group.source != nullptr) group.source->list(finder);
  return finder.unit;
}

std::optional<StiffnessRange> stiffness_range(const Simulation& simulation, GroupId id) {
  const std::optional<Real> common = simulation.stiffness(id);
  if (!common) return std::nullopt;
  const Group& group = simulation.groups().at(id);
  StiffnessRange range{*common, *common, stiffness_unit(group)};
  if (const auto* fibers = options_in<FibreStrain>(group)) range.taut_factor = fibers->taut_factor;

  const Index first_vertex = simulation.body(group.body).first_vertex;
  const Values* given = group.source == nullptr ? nullptr : group.source->stiffness();
  const std::vector<Real> none;
  const bool is_of_vertices = given != nullptr && given->of_vertices();
  if (is_of_vertices || !group.factors.empty()) {
    const auto [least, most] =
        range_by_vertices(group, {is_of_vertices ? given->list() : none, first_vertex}, {group.factors, first_vertex});
    range.least *= least;
    range.most *= most;
  }
  if (given != nullptr && given->each() && !is_of_vertices && !given->list().empty()) {
    const auto [least, most] = std::ranges::minmax(given->list());
    range.least *= least;
    range.most *= most;
  }
  return range;
}

}  // namespace pliant
