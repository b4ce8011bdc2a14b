// Stiffness that is painted: factors from vertex to vertex, of a session and of the text of its scene.
#include <algorithm>
#include <cmath>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
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

void check(const PaintDab& dab) {
  if (dab.vertices.size() != dab.shares.size()) pliant::fail_input("a dab of paint needs a share for each vertex");
  if (!(dab.factor >= least_factor && dab.factor <= most_factor)) {
    pliant::fail_input("a painted stiffness is multiplied by 0.001 to 1000");
  }
  const auto is_share = [](Real share) { return share >= 0 && share <= 1; };
  if (!std::ranges::all_of(dab.shares, is_share)) pliant::fail_input("a share of paint is from 0 to 1");
}

}  // namespace

void Session::paint(const std::string& group, const PaintDab& dab, bool goes_on) {
  const auto noted = note(action::Paint{group, dab, goes_on});
  check(dab);
  const auto is_named = [&](const auto& entry) { return entry.second.name == group; };
  const auto& groups = simulation().groups();
  const auto found = std::ranges::find_if(groups, is_named);
  if (found == groups.end() || is_hidden(found->first) || !simulation().stiffness(found->first)) {
    pliant::fail_input("there is no group '" + pliant::printable(group) + "' with a stiffness to be painted");
  }
  if (std::ranges::count_if(groups, is_named) > 1 || unchanged_.comes_later(group)) {
    pliant::fail_input("'" + pliant::printable(group) + "' cannot be painted: " +
                       (unchanged_.comes_later(group) ? "an event adds it" : "several groups have this name"));
  }
  const pliant::Body& body = simulation().body(found->second.body);
  std::vector<Real> factors = found->second.factors;
  factors.resize(static_cast<std::size_t>(body.mesh.vertex_count()), 1);
  for (std::size_t i = 0; i < dab.vertices.size(); ++i) {
    const Index place = dab.vertices[i] - body.first_vertex;
    if (place < 0 || place >= body.mesh.vertex_count()) {
      pliant::fail_input("vertex " + std::to_string(dab.vertices[i]) + " is not on '" + body.name + "'");
    }
    Real& factor = factors[static_cast<std::size_t>(place)];
    const Real share = dab.shares[i];
    factor = rounded(std::exp((1 - share) * std::log(factor) + share * std::log(dab.factor)));
  }
  Edit edit{.what = "paint " + group, .before = changes_};
  scene_.simulation.set_stiffness_factors(found->first, factors);
  changes_.painted[group] = {body.name, std::move(factors)};
  ++look_changes_;
  if (goes_on && !done_.empty() && done_.back().what == edit.what && done_.back().after == edit.before) {
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
      const auto id = simulation().find_group(group);
      if (id) scene_.simulation.set_stiffness_factors(*id, unchanged_.factors_of(group, to));
    }
  }
  ++look_changes_;
}

/// After another material: groups that stay keep their paint, of others it is gone.
void Session::keep_paint_of(const std::string& body) {
  for (const auto& [group, factors] : unchanged_.painted_of(body, changes_)) {
    const auto id = simulation().find_group(group);
    if (id) {
      scene_.simulation.set_stiffness_factors(*id, factors);
    } else {
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
  const auto is_off = [&](const std::string& group) {
    return changes.switched_off.contains(group) && as_read_.places.contains(group);
  };
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto painted = painted_of(bodies_[i].name, changes);
    const auto is_changed = [&](const auto& entry) {
      return changes.painted.contains(entry.first) || is_off(entry.first);
    };
    if (std::ranges::none_of(painted, is_changed)) continue;
    Json json = Json::object();
    for (const auto& [group, factors] : painted) {
      if (!factors.empty() && !is_off(group)) json[group] = factors;
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
