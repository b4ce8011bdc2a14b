#pragma once
// Forces as scene files have them.
#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "pliant/forces/mouse_spring.h"
#include "pliant/forces/pressure.h"
#include "pliant/forces/test_force.h"
#include "pliant/forces/wind.h"
#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

struct SceneReader;

/// Whether all keys that a force must have are wanted, or only those that change.
enum class Reading { all, changes };

// Each has its type's name, `read` from an object of its keys and others that are known already, and `make`.

struct GravityEntry {
  static constexpr std::string_view type = "gravity";
  Vec3 acceleration{0, 0, -9.81};

  std::unique_ptr<Force> make(const Simulation& simulation) const;
};

struct WindEntry {
  static constexpr std::string_view type = "wind";
  std::optional<BodyId> body{};  // default: all
  WindOptions options{};

  void read(const Node& node, std::vector<std::string_view> keys, const SceneReader& scene, Reading reading);
  std::unique_ptr<Force> make(const Simulation& simulation) const;
};

struct TestForceEntry {
  static constexpr std::string_view type = "test_force";
  BodyId body{};
  std::vector<Index> vertices{};  // of the simulation
  Points force{};
  std::array<std::int64_t, 2> frames = {0, TestForce::forever};

  void read(const Node& node, std::vector<std::string_view> keys, const SceneReader& scene, Reading reading);
  std::unique_ptr<Force> make(const Simulation& simulation) const;
};

struct MouseSpringEntry {
  static constexpr std::string_view type = "mouse_spring";
  BodyId body{};
  Index vertex = 0;  // of the simulation
  MouseSpringOptions options{};

  void read(const Node& node, std::vector<std::string_view> keys, const SceneReader& scene, Reading reading);
  std::unique_ptr<Force> make(const Simulation& simulation) const;
};

struct PressureEntry {
  static constexpr std::string_view type = "pressure";
  BodyId body{};
  PressureOptions options{};

  void read(const Node& node, std::vector<std::string_view> keys, const SceneReader& scene, Reading reading);
  std::unique_ptr<Force> make(const Simulation& simulation) const;
};

using ForceOptions = std::variant<WindEntry, TestForceEntry, MouseSpringEntry, PressureEntry, GravityEntry>;

/// Whether that is the type of a force.
bool is_force_type(std::string_view type);
/// The force of the type that the key "type" names; "name" and `more_keys` are known besides its own keys.
ForceOptions read_force_options(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene);
void read_changed_force(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene,
                        ForceOptions& options);
std::string_view type_of(const ForceOptions& options);
std::unique_ptr<Force> make(const ForceOptions& options, const Simulation& simulation);

}  // namespace pliant
