#pragma once
// Values that take the place of others in documents that do not change: `--set`, and "set" of an include.
#include <functional>
#include <map>
#include <span>

#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// What lies over one value and over what is in it.
struct Overlay {
  std::optional<Node> value = {};  ///< in its place
  std::optional<Node> made = {};   ///< the empty object that stands for a key that the document lacks
  std::map<std::string, Overlay, std::less<>> keys = {};
  std::map<std::size_t, Overlay> entries = {};
};

/// A document as one scene sees it. Overlays refer to documents, so both stay where they are.
struct SceneLayer {
  const Document& document;
  const Origin& origin;
  Overlay overlay = {};

  Node root() const { return Node(document, origin, &overlay); }
};

/// Whether this is one of the lists of a scene that go on from layer to layer; of other keys the last layer's count.
bool is_shared_list(std::string_view key);

/// Puts `value` at a path such as `bodies[0].mass.total` or `bodies[sheet].constraints[bend].stiffness`: entries of a
/// list go by their index or by their name ("name", or "type" where only one has it).
/// @throws Error(input) as `value` fails, where the path leads nowhere.
void set_value(std::span<SceneLayer* const> layers, std::string_view path, const Node& value);

}  // namespace pliant
