// Stiffness that is painted: factors from vertex to vertex, of a session and of the text of its scene.
#include <algorithm>
#include <cmath>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "viewer/carry_over.h"
#include "viewer/json_of.h"
#include "viewer/session.h"

namespace pliant_viewer {
namespace {

constexpr Real least_factor = 1e-3, most_factor = 1e3;

/// To three digits: what is saved is what is there.
Real rounded(Real factor) {
  const Real digits = std::pow(Real{10}, std::floor(std::log10(factor)) - 2);
  const Real whole = std::round(factor / digits);
  return digits < 1 ? whole / std::round(1 / digits) : whole * digits;
}

/// So much of the way to a factor; where three digits do not tell a step, to its end.
Real painted(Real before, Real factor, Real share) {
  constexpr Real least_share = 0.02;
  const Real now = rounded(std::exp((1 - share) * std::log(before) + share * std::log(factor)));
  return now == rounded(before) && share > least_share ? rounded(factor) : now;
}

void check(const PaintDab& dab) {
  if (dab.vertices.size() != dab.shares.size()) pliant::fail_input("a dab of paint needs a share for each vertex");
  if (!(dab.factor >= least_factor && dab.factor <= most_factor)) {
    pliant::fail_input("a painted stiffness is multiplied by 0.001 to 1000");
  }
  const auto is_share = [](Real share) { return share >= 0 && share <= 1; };
  if (!std::ranges::all_of(dab.shares, is_share)) pliant::fail_input("a share of paint is from 0 to 1");
}

}  // namespace

std::optional<pliant::GroupId> group_of_body(const pliant::Simulation& simulation, const std::string& name,
                                             const std::string& body) {
  for (const auto& [id, group] : simulation.groups()) {
    if (group.name == name && simulation.body(group.body).name == body) return id;
  }
  return {};
}

std::vector<PaintableGroup> Session::paintable() const {
  std::map<std::string, int> counts;
  for (const auto& [id, group] : simulation().groups()) ++counts[group.name];
  std::vector<PaintableGroup> list;
  for (const auto& [id, group] : simulation().groups()) {
    const bool takes_factors = group.source != nullptr && !group.other && simulation().stiffness(id).has_value();
    const bool is_alone = counts.at(group.name) == 1 && !is_hidden(id) && unchanged_.begins_with(group.name, changes_);
    if (takes_factors && is_alone) list.push_back({group.name, simulation().body(group.body).name});
  }
  return list;
}

void Session::paint(const std::string& group, const PaintDab& dab, bool goes_on) {
  const auto noted = note(action::Paint{group, dab, goes_on});
  check(dab);
  const std::vector<PaintableGroup> groups = paintable();
  if (std::ranges::find(groups, group, &PaintableGroup::group) == groups.end()) {
    pliant::fail_input("'" + pliant::printable(group) + "' is no group whose stiffness can be painted");
  }
  const pliant::GroupId id = *simulation().find_group(group);
  const pliant::Body& body = simulation().body(simulation().groups().at(id).body);
  const auto count = static_cast<std::size_t>(body.mesh.vertex_count());
  for (const Index vertex : dab.vertices) {
    if (vertex >= body.first_vertex && vertex < body.first_vertex + body.mesh.vertex_count()) continue;
    pliant::fail_input("vertex " + std::to_string(vertex) + " is not on '" + body.name + "'");
  }
  Edit edit{.what = "paint " + group, .before = changes_};
  const bool is_same_stroke = goes_on && stroke_.group == group && stroke_.before.size() == count && !done_.empty() &&
                              done_.back().what == edit.what && done_.back().after == edit.before;
  std::vector<Real> factors = simulation().groups().at(id).factors;
  factors.resize(count, 1);
  if (!is_same_stroke) stroke_ = {group, factors, std::vector<Real>(count, 0)};
  for (std::size_t i = 0; i < dab.vertices.size(); ++i) {
    const auto place = static_cast<std::size_t>(dab.vertices[i] - body.first_vertex);
    Real& share = stroke_.shares[place];
    share = std::max(share, dab.shares[i]);
    factors[place] = painted(stroke_.before[place], dab.factor, share);
  }
  scene_.simulation.set_stiffness_factors(id, std::move(factors));
  changes_.painted[group] = {body.name, simulation().groups().at(id).factors};  // none of ones
  ++look_changes_;
  if (is_same_stroke) {
    done_.back().after = changes_;
    undone_.clear();
  } else {
    remember(std::move(edit));
  }
}

/// Sets what was painted of the groups that there are.
void Session::set_painted(const SceneChanges& from, const SceneChanges& to) {
  for (const auto* changes : {&from, &to}) {
    for (const auto& [group, painted] : changes->painted) {
      if (const auto id = group_of_body(simulation(), group, painted.body)) {
        scene_.simulation.set_stiffness_factors(*id, unchanged_.factors_of(group, to));
      }
    }
  }
  ++look_changes_;
}

/// After another material: groups that it has too keep their paint, that of those which it has removed is gone.
void Session::keep_paint_of(const std::string& body, const std::set<std::string>& removed) {
  for (const auto& [group, factors] : unchanged_.painted_of(body, changes_)) {
    if (const auto id = group_of_body(simulation(), group, body)) {
      scene_.simulation.set_stiffness_factors(*id, factors);
    } else if (removed.contains(group)) {
      changes_.painted[group] = {body, {}};
    }
  }
}

std::vector<Real> UnchangedScene::factors_of(const std::string& group, const SceneChanges& changes) const {
  const auto painted = changes.painted.find(group);
  if (painted != changes.painted.end()) return painted->second.factors;
  const auto own = factors_.find(group);
  return own == factors_.end() ? std::vector<Real>() : own->second.factors;
}

std::map<std::string, std::vector<Real>> UnchangedScene::painted_of(const std::string& body,
                                                                    const SceneChanges& changes) const {
  std::map<std::string, std::vector<Real>> groups;
  for (const auto* all : {&factors_, &changes.painted}) {
    for (const auto& [group, painted] : *all) {
      if (painted.body == body) groups[group] = painted.factors;
    }
  }
  return groups;
}

void UnchangedScene::write_factors(const SceneChanges& changes, pliant::SceneDocument& document) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto painted = painted_of(bodies_[i].name, changes);
    const auto is_changed = [&](const auto& entry) { return changes.painted.contains(entry.first); };
    if (std::ranges::none_of(painted, is_changed)) continue;
    Json json = Json::object();
    for (const auto& [group, factors] : painted) {
      const bool fits = factors.size() == static_cast<std::size_t>(bodies_[i].vertex_count);
      if (fits && begins_with(group, changes)) json[group] = factors;
    }
    const std::string place = "bodies[" + std::to_string(i) + "].stiffness_factors";
    if (json.empty()) {
      document.remove(place);
    } else {
      document.set(place, json.dump());
    }
  }
}

}  // namespace pliant_viewer
