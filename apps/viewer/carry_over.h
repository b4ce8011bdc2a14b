#pragma once
// From a scene that has run for a while to the same one with other changes: time goes on where it was.
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "pliant_io/scene/scene.h"
#include "viewer/sliders.h"

namespace pliant_viewer {

/// What does not come from the scene that ran.
struct NotCarried {
  std::size_t event_count = 0;  ///< of the scene's own events; those behind them act before all others
  std::vector<Index> left_out_of_from{}, left_out_of_to{};  ///< of the scene's own, ascending
  std::vector<Index> idle_of_from{}, idle_of_to{};          ///< of the scene's own, that act on nothing, ascending
  std::set<std::string> values;                             ///< keys of sliders
  std::set<std::string> bodies;                             ///< whose material has changed
  std::set<Index> pins;                                     ///< vertices
  std::set<std::string> removed;                            ///< groups that the last events of `to` take away
  std::function<bool(pliant::GroupId)> is_hidden = {};      ///< as of list_sliders, of `from`
};

/// A group of another simulation, in this one: that of its number where it is called alike on the same body, as in a
/// copy, whose groups may share a name; else that of its name.
std::optional<pliant::GroupId> find_same(const pliant::Simulation& in, pliant::GroupId id, const pliant::Group& group);

/// The first group of that name on the body of that name.
std::optional<pliant::GroupId> group_of_body(const pliant::Simulation& simulation, const std::string& name,
                                             const std::string& body);

/// Sets values where each is allowed only after another: a smallest stretch may be so only below the largest one.
/// Keys that there are not are left out. @throws pliant::Error (input): one that is never allowed.
void set_values(std::map<std::string, pliant::Vec3> values, pliant::Simulation& simulation);

/// Takes `to`, which was just read, to where `from` is: its events act that have acted there, moves go on, values, pins
/// and stiffnesses are those of `from`, and so are positions, velocities and time.
/// @throws pliant::Error (input) where they have other bodies.
void carry_over(const pliant::Scene& from, pliant::Scene& to, const NotCarried& rules);

}  // namespace pliant_viewer
