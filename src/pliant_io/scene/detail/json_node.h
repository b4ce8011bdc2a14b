#pragma once
// Values of a scene that know their place, for messages.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/scene/document.h"

namespace pliant {

class SceneFiles;
struct Overlay;

/// Where values come from: a file, or an option of the command line.
struct Origin {
  std::string name;                   ///< in messages
  std::filesystem::path folder = {};  ///< where paths in the values start
  SceneFiles* files = nullptr;        ///< reads what such paths name; null: no value names a file
};

/// A value and its place, "bodies[0].mesh"; the whole text has the empty path. Cheap to copy: the path is found when a
/// message needs it. Refers to document, origin and overlay, which must live longer.
///
/// An overlay (overlay.h) puts values of other origin in the place of some; those name their own place in messages.
class Node {
 public:
  /// The whole document.
  Node(const Document& document, const Origin& origin, const Overlay* overlay = nullptr)
      : Node(document, origin, document.root(), overlay) {}

  const Origin& origin() const { return *origin_; }

  bool is_null() const { return kind() == Document::Kind::null; }
  bool is_boolean() const { return kind() == Document::Kind::boolean; }
  bool is_number() const { return is_integer() || kind() == Document::Kind::real; }
  /// A number without point and exponent, within 64 bits.
  bool is_integer() const { return kind() == Document::Kind::integer || kind() == Document::Kind::wide_integer; }
  bool is_text() const { return kind() == Document::Kind::text; }
  /// Bytes, of which JSON has none.
  bool is_bytes() const { return kind() == Document::Kind::bytes; }
  bool is_list() const { return kind() == Document::Kind::list; }
  bool is_object() const { return kind() == Document::Kind::object; }

  /// Entries of a list or keys of an object; 0 for other values.
  std::size_t size() const { return is_object() ? keys().size() : is_list() ? document_->size(place_) : 0; }
  bool empty() const { return size() == 0; }

  /// The value itself, of the type that was asked for first.
  bool boolean() const { return document_->boolean(place_); }
  std::int64_t integer() const { return document_->integer(place_); }
  Real number() const { return is_integer() ? static_cast<Real>(integer()) : document_->real(place_); }
  /// Of a text, or bytes.
  std::string_view text() const { return document_->text(place_); }

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
  Node(const Document& document, const Origin& origin, Document::Place place, const Overlay* overlay)
      : document_(&document), origin_(&origin), overlay_(overlay), place_(place) {}
  Document::Kind kind() const { return document_->kind(place_); }
  /// The value below an overlay, of a key of the document.
  std::optional<Node> find_below(std::string_view key) const;

  const Document* document_;
  const Origin* origin_;
  const Overlay* overlay_;
  Document::Place place_;
};

}  // namespace pliant
