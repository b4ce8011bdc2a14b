#pragma once
// Values of a scene that know their place, for messages.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/core/types.h"
#include "pliant_io/scene/detail/json_text.h"

namespace pliant {

class SceneFiles;

/// Where values come from: a file, or an option of the command line.
struct Origin {
  std::string name;                   ///< in messages
  std::filesystem::path folder = {};  ///< where paths in the values start
  SceneFiles* files = nullptr;        ///< reads what such paths name; null: no value names a file
};

/// The place of a value in the text that it was written in.
struct SourcePlace {
  const Origin* origin = nullptr;
  std::string path = {};  ///< "bodies[0].mesh"; empty: the whole text
};

/// Which values of a document stand elsewhere than the object or the list that holds them: those of included scenes,
/// and those that were set. Only the ways to such values are here.
struct OriginMap {
  std::optional<SourcePlace> place = {};  ///< none: inside that of what holds it
  std::map<std::string, OriginMap, std::less<>> keys = {};
  std::map<std::size_t, OriginMap> entries = {};
};

/// JSON with the origins of its values.
struct Document {
  Document(SceneJson value, SourcePlace place) : json(std::move(value)), origins{.place = std::move(place)} {}

  SceneJson json;
  OriginMap origins;  ///< with a place of its own
};

/// A value and its place, "bodies[0].mesh"; the whole text has the empty path. Cheap to copy: the path is found when a
/// message needs it. Refers to the document, which must live longer and stay as it is.
class Node {
 public:
  /// The whole document.
  explicit Node(const Document& document)
      : value_(&document.json),
        origins_(&document.origins),
        place_(&document.origins.place.value()),
        placed_(&document.json) {}

  const Origin& origin() const { return *place_->origin; }
  /// Where it was written.
  SourcePlace place() const;
  /// Whether it was written elsewhere than what holds it.
  bool has_own_place() const { return placed_ == value_; }
  const SceneJson& json() const { return *value_; }

  bool is_null() const { return value_->is_null(); }
  bool is_boolean() const { return value_->is_boolean(); }
  bool is_number() const { return value_->is_number(); }
  /// A number without point and exponent, within 64 bits.
  bool is_integer() const { return value_->is_number_integer(); }
  bool is_text() const { return value_->is_string(); }
  /// Bytes, of which JSON has none.
  bool is_bytes() const { return value_->is_binary(); }
  bool is_list() const { return value_->is_array(); }
  bool is_object() const { return value_->is_object(); }

  /// Entries of a list or keys of an object; 0 for other values.
  std::size_t size() const { return is_object() || is_list() ? value_->size() : 0; }
  bool empty() const { return size() == 0; }

  /// The value itself, of the type that was asked for first.
  bool boolean() const { return value_->get<bool>(); }
  std::int64_t integer() const { return value_->get<std::int64_t>(); }
  Real number() const { return value_->get<Real>(); }
  std::string_view text() const { return value_->get_ref<const std::string&>(); }
  std::string_view bytes() const;

  /// Entry i of a list, with i in range.
  Node operator[](std::size_t i) const;
  /// The value of a key, or nothing when the key is not there, or this is no object.
  std::optional<Node> find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  /// The value of a key that must be there.
  Node require(std::string_view key) const;
  /// The keys of an object, in the order of the text; none for other values.
  std::vector<std::string_view> keys() const;

  void require_object() const;
  void require_list() const;
  void require_list(std::size_t size, std::string_view entries) const;
  /// Refuses anything but an object with no other keys than these.
  void check_keys(const std::vector<std::string_view>& known) const;
  /// The one key of these that the object has; refuses none and more than one.
  std::string_view require_one_of(const std::vector<std::string_view>& keys) const;

  /// `file: path: what`, for a warning.
  std::string at(std::string_view what) const;
  /// Throws Error(input) `file: path: what`.
  [[noreturn]] void fail(std::string_view what) const;
  /// Throws "found a string; give a number".
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
  /// What this holds, with its origins if there are any.
  Node inner(const SceneJson& value, const OriginMap* origins) const;

  const SceneJson* value_;
  const OriginMap* origins_;  ///< of the value and what is in it; null: all of one place
  const SourcePlace* place_;  ///< of placed_
  const SceneJson* placed_;   ///< the value itself or what holds it
};

}  // namespace pliant
