#include "pliant_io/checkpoint/state_file.h"

#include "pliant/core/printable.h"
#include "pliant/core/version.h"
#include "pliant_io/checkpoint/detail/checkpoint_file.h"
#include "pliant_io/checkpoint/detail/read_state.h"
#include "pliant_io/checkpoint/detail/read_values.h"
#include "pliant_io/checkpoint/detail/write_state.h"
#include "pliant_io/checkpoint/detail/write_values.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/read_file.h"

namespace pliant {
namespace {

void check_bodies(const Node& list, std::span<const Body> bodies) {
  list.require_list();
  if (list.size() != bodies.size()) {
    list.fail(
        fmt::format("{}, where the simulation has {}; make it as the program did before", list.size(), bodies.size()));
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
  const Unsealed unsealed = unseal(bytes, name);
  const Document document(parse_cbor(unsealed.content, name), {&origin});
  const Node root(document);
  if (root.has("source")) {
    fail_input(fmt::format("{}: a checkpoint of a scene; load it as one", printable_place(name)));
  }
  check_bodies(root.require("bodies"), simulation.bodies());
  const std::vector<BatchNumbers> numbers = read_groups(root.require("groups"), simulation);
  const Node node = root.require("state");
  const State state = read_state(node, simulation.state());
  node.locate([&] { simulation.restore(state); });
  set_numbers(numbers);
}

void restore_state(const std::filesystem::path& path, Simulation& simulation) {
  restore_state(read_file(path), path.string(), simulation);
}

}  // namespace pliant
