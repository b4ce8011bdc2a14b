#pragma once
// Options from JSON, written once over the list that every type makes of its options (core/options.h).
#include <fmt/format.h>

#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/detail/read_map.h"
#include "pliant_io/scene/detail/selection.h"

namespace pliant {

/// A type that lists options of its own.
template <class Options>
concept has_options = requires(Options options) {
  Options::visit(options, [](const OptionInfo&, auto&) {});
};

template <class Options>
void read_options(const Node& node, Options& options, std::vector<std::string_view> more_keys = {},
                  const SceneBody* body = nullptr);

/// A visitor that reads each option whose key the object has.
struct OptionReader {
  const Node& node;
  const SceneBody* body = nullptr;  ///< what selections and stencils refer to; needed for types that have those

  template <class Option>
  void operator()(const OptionInfo& info, Option& option) const {
    if (const std::optional<Node> value = node.find(info.name)) read_option(info, *value, option);
  }

 private:
  template <class Option>
  void read_option(const OptionInfo& info, const Node& value, Option& option) const {
    if constexpr (has_options<Option>) {
      read_options(value, option);
    } else if constexpr (std::is_same_v<Option, Selection>) {
      if (node.has("stencils")) value.fail("'stencils' says already where; keep one of the two keys");
      option = read_selection(value, *body);
    } else if constexpr (std::is_same_v<Option, Stencils>) {
      option = read_stencils(value, body->mesh.vertex_count());
    } else {
      if constexpr (std::is_same_v<Option, Values>) {
        if (value.is_object() && body != nullptr) return read_map_option(info, value, option);
      }
      if constexpr (std::is_same_v<Option, Index>) {
        if (!info.word.empty() && value.is_text()) return read_word(info, value, option);
      }
      read(value, option);
      check_range(value, info);
    }
  }

  static void read_word(const OptionInfo& info, const Node& value, Index& option) {
    if (value.text() != info.word) value.fail(fmt::format("found a string; give a whole number, or \"{}\"", info.word));
    option = info.number_of_word;
  }

  void read_map_option(const OptionInfo& info, const Node& value, Values& option) const {
    std::vector<Real> values = read_mapped_values(value, body->mesh);
    check_mapped_range(value, values, info);
    option = Values::of_vertices(std::move(values));
  }
};

/// Reads options of any type that lists them. Other keys than theirs and `more_keys` are refused.
template <class Options>
void read_options(const Node& node, Options& options, std::vector<std::string_view> more_keys, const SceneBody* body) {
  Options::visit(options, [&](const OptionInfo& info, const auto&) { more_keys.push_back(info.name); });
  node.check_keys(more_keys);
  Options::visit(options, OptionReader{node, body});
}

}  // namespace pliant
