#pragma once
// A scene file as a tree whose values know their place, for messages. Private to scene/: nlohmann's header is not part
// of the interface.
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "pliant/core/error.h"

namespace pliant {

using Json = nlohmann::json;

/// Lists and objects inside each other, at most.
inline constexpr std::size_t max_json_depth = 64;

/// Reads a text. `file` is what messages call it.
/// @throws Error (input): `file:line:column: what` for a slip of syntax; `file: path: what` for a key that stands twice
///   in an object, a number beyond the range of doubles, or too many levels.
Json parse_json(std::string_view text, std::string_view file);

/// Text of the user's made fit for one line of a message: without control characters, cut when long.
std::string printable(std::string_view text);

/// A value and its place, "bodies[0].mesh"; the whole text has the empty path. Refers to file name and value, which
/// must live longer.
class Node {
 public:
  Node(std::string_view file, const Json& value, std::string path = {})
      : file_(file), value_(&value), path_(std::move(path)) {}

  const Json& value() const { return *value_; }

  bool is_null() const { return value_->is_null(); }
  bool is_list() const { return value_->is_array(); }
  bool is_object() const { return value_->is_object(); }
  /// Entries of a list or keys of an object; 0 for other values.
  std::size_t size() const { return is_list() || is_object() ? value_->size() : 0; }

  /// Entry i of a list, with i in range.
  Node operator[](std::size_t i) const;
  /// The value of a key, or nothing when the key is not there.
  std::optional<Node> find(std::string_view key) const;
  bool has(std::string_view key) const { return value_->contains(key); }
  /// The value of a key that must be there.
  Node require(std::string_view key) const;

  void require_object() const;
  void require_list() const;
  void require_list(std::size_t size, std::string_view entries) const;
  /// Refuses anything but an object with no other keys than these.
  void check_keys(const std::vector<std::string_view>& known) const;
  /// The one key of these that the object has; refuses none and more than one.
  std::string_view require_one_of(const std::vector<std::string_view>& keys) const;

  /// Throws Error(input) `file: path: what`.
  [[noreturn]] void fail(std::string_view what) const;
  /// Throws "a number is wanted here, not a string".
  [[noreturn]] void fail_type(std::string_view wanted) const;

  /// Calls f; errors of its input get this place in front.
  template <class F>
  decltype(auto) locate(F&& f) const {
    try {
      return std::forward<F>(f)();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::input) throw;
      fail(error.what());
    }
  }

 private:
  std::string_view file_;
  const Json* value_;
  std::string path_;
};

}  // namespace pliant
