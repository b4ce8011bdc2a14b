#include "pliant_io/checkpoint/state_file.h"

#include "pliant/core/printable.h"
#include "pliant/core/version.h"
#include "pliant_io/checkpoint/detail/checkpoint_file.h"
#include "pliant_io/checkpoint/detail/read_state.h"
#include "pliant_io/checkpoint/detail/read_values.h"
#include "pliant_io/checkpoint/detail/write_state.h"
#include "pliant_io/checkpoint/detail/write_values.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/crc32.h"
#include "pliant_io/files/read_file.h"

namespace pliant {
namespace {

constexpr FileWords words{"state", "`write_state` or `save_state`", "simulate from the start"};

std::uint32_t masses_checksum(const Simulation& simulation) {
  const std::vector<Real>& masses = simulation.state().masses;
  return crc32({reinterpret_cast<const char*>(masses.data()), sizeof(Real) * masses.size()});
}

/// The types of all groups.
nlohmann::json types_json(const Simulation& simulation) {
  nlohmann::json types = nlohmann::json::array();
  for (const auto& [id, group] : simulation.groups()) types.push_back(bytes_of(group.type));
  return types;
}

void check_types(const Node& list, const Simulation& simulation) {
  list.require_list(simulation.groups().size(), "(one a group)");
  std::size_t i = 0;
  for (const auto& [id, group] : simulation.groups()) {
    const Node node = list[i++];
    const std::string type = read_bytes(node);
    if (type == group.type) continue;
    node.fail(fmt::format("'{}', where the group '{}' of the simulation is '{}'; make it as the program did before",
                          printable(type), printable(group.name), printable(group.type)));
  }
}

void check_masses(const Node& node, const Simulation& simulation) {
  std::int64_t sum = 0;
  read(node, sum);
  if (sum == masses_checksum(simulation)) return;
  node.fail("the masses are others than those of the simulation; make its bodies as the program did before");
}

void check_bodies(const Node& list, std::span<const Body> bodies) {
  list.require_list();
  if (list.size() != bodies.size()) {
    list.fail(fmt::format("{} bodies, where the simulation has {}; make it as the program did before", list.size(),
                          bodies.size()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Index vertices = 0;
    read(list[i].require("vertices"), vertices);
    const std::string name = read_bytes(list[i].require("name"));
    if (name == bodies[i].name && vertices == bodies[i].mesh.vertex_count()) continue;
    list[i].fail(
        fmt::format("'{}' with {} vertices, where the simulation has '{}' with {}; make it as the program did "
                    "before",
                    printable(name), vertices, printable(bodies[i].name), bodies[i].mesh.vertex_count()));
  }
}

}  // namespace

std::string state_bytes(const Simulation& simulation) {
  nlohmann::json bodies = nlohmann::json::array();
  for (const Body& body : simulation.bodies()) {
    bodies.push_back({{"name", bytes_of(body.name)}, {"vertices", body.mesh.vertex_count()}});
  }
  const nlohmann::json content = {{"pliant", version},
                                  {"compiler", compiler},
                                  {"bodies", std::move(bodies)},
                                  {"masses", masses_checksum(simulation)},
                                  {"types", types_json(simulation)},
                                  {"state", state_json(simulation.state())},
                                  {"groups", groups_json(simulation)}};
  std::string bytes;
  nlohmann::json::to_cbor(content, bytes);
  return seal(bytes);
}

void write_state(const std::filesystem::path& path, const Simulation& simulation) {
  write_file_atomically(path, state_bytes(simulation));
}

void restore_state(std::string_view bytes, std::string_view name, Simulation& simulation) {
  const Origin origin{std::string(name)};
  const Unsealed unsealed = unseal(bytes, name, words);
  const Document document(parse_cbor(unsealed.content, name), {&origin});
  const Node root(document);
  if (root.has("source")) {
    fail_input(fmt::format("{}: a checkpoint of a scene; read it with `read_checkpoint` or `load_checkpoint`",
                           printable_place(name)));
  }
  check_bodies(root.require("bodies"), simulation.bodies());
  check_masses(root.require("masses"), simulation);
  const std::vector<BatchNumbers> numbers = read_groups(root.require("groups"), simulation);
  check_types(root.require("types"), simulation);
  const Node node = root.require("state");
  const State state = read_state(node, simulation.state());
  node.locate([&] { simulation.restore(state); });
  set_numbers(numbers);
}

void restore_state(const std::filesystem::path& path, Simulation& simulation) {
  restore_state(read_file(path), path.string(), simulation);
}

}  // namespace pliant
