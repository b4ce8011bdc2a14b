#pragma once
// A text of JSON (or CBOR) as a tree that does not change, in few bytes: 8 for each value, and as many again for a
// number with a fraction or a text. So any text and its tree together stay far below ten times the text, which a
// general tree of nodes with a heap block each does not.
//
// A value is one word: its kind in 4 bits, then the number itself, or a count and a place in one of two stores, which
// grow by blocks and never move. Entries of a list stand side by side, those of an object as key, value, key, value. A
// container's words follow those of everything inside it, which is how path_of() finds its way.
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Words in blocks: growth copies nothing, and the end can be moved elsewhere without both being held in full.
class WordStore {
 public:
  using Word = std::uint64_t;

  std::size_t size() const { return size_; }
  Word operator[](std::size_t i) const { return (*blocks_[i / block_size])[i % block_size]; }
  void push_back(Word word);
  /// Moves the words from `begin` on to the end of another store.
  void move_tail(std::size_t begin, WordStore& target);

 private:
  static constexpr std::size_t block_size = 512;
  using Block = std::array<Word, block_size>;
  std::vector<std::unique_ptr<Block>> blocks_;
  std::size_t size_ = 0;
};

/// Texts, each in one piece.
class TextStore {
 public:
  /// Returns the place of a copy.
  std::size_t add(std::string_view text);
  const char* at(std::size_t place) const { return blocks_[place / block_size].get() + place % block_size * unit; }

 private:
  static constexpr std::size_t unit = 8;  // places count in these, so that they fit into 30 bits
  static constexpr std::size_t block_size = 512;
  static constexpr std::size_t long_text = 512;  // bytes from which a text has a block of its own
  std::vector<std::unique_ptr<char[]>> blocks_;
  std::size_t open_block_ = 0;
  std::size_t used_ = block_size;  // of the open block
};

class Document {
 public:
  enum class Kind : std::uint64_t { null, boolean, integer, wide_integer, real, text, bytes, list, object };

  /// One value of the document: where its word stands.
  using Place = std::uint32_t;

  Place root() const { return static_cast<Place>(words_.size() - 1); }
  Kind kind(Place place) const { return kind_of(words_[place]); }
  /// Entries of a list, keys of an object, bytes of a text.
  std::size_t size(Place place) const { return size_of(words_[place]); }
  /// Entry i of a list.
  Place entry(Place list, std::size_t i) const { return first_of(words_[list]) + static_cast<Place>(i); }
  Place key(Place object, std::size_t i) const { return first_of(words_[object]) + static_cast<Place>(2 * i); }
  /// The value of key i.
  Place member(Place object, std::size_t i) const { return key(object, i) + 1; }

  bool boolean(Place place) const { return words_[place] >> kind_bits != 0; }
  std::int64_t integer(Place place) const;
  Real real(Place place) const { return std::bit_cast<Real>(words_[first_of(words_[place])]); }
  /// Of a text or bytes, or of a key.
  std::string_view text(Place place) const { return text_of(words_[place]); }

  /// "bodies[0].mesh" for the value at that place; "" for the root.
  std::string path_of(Place place) const;

 private:
  friend class DocumentBuilder;
  using Word = WordStore::Word;

  static constexpr unsigned kind_bits = 4;
  static constexpr unsigned size_bits = 30;  // of counts and places
  static constexpr Word low_bits(unsigned bits) { return (Word{1} << bits) - 1; }
  static Kind kind_of(Word word) { return static_cast<Kind>(word & low_bits(kind_bits)); }
  static std::size_t size_of(Word word) { return word >> kind_bits & low_bits(size_bits); }
  static Place first_of(Word word) { return static_cast<Place>(word >> (kind_bits + size_bits)); }
  static Word word_of(Kind kind, std::size_t size, std::size_t first) {
    return static_cast<Word>(first) << (kind_bits + size_bits) | static_cast<Word>(size) << kind_bits |
           static_cast<Word>(kind);
  }
  std::string_view text_of(Word word) const {
    return size_of(word) == 0 ? std::string_view() : std::string_view(texts_.at(first_of(word)), size_of(word));
  }

  WordStore words_;
  TextStore texts_;
};

/// Lists and objects inside each other, at most.
inline constexpr std::size_t max_document_depth = 64;
/// Bytes that a text may have, so that counts and places fit into 30 bits.
inline constexpr std::size_t max_document_bytes = (std::size_t{1} << 30U) - 1;

/// Reads a text. `file` is what messages call it.
/// @throws Error (input): `file:line:column: what` for a slip of syntax; `file: path: what` for a key that stands twice
///   in an object, a number beyond the range of doubles, or too many levels.
Document parse_json(std::string_view text, std::string_view file);

/// The same for CBOR (RFC 8949), which may hold bytes besides; strings come in one piece each.
Document parse_cbor(std::string_view bytes, std::string_view file);

/// Whether the text is sound JSON.
bool is_json(std::string_view text);

/// The document that is one text.
Document text_document(std::string_view text);

/// "path.key", or the key alone where the path is empty; fit for a message.
std::string join_key(std::string_view path, std::string_view key);

/// Throws Error(input) `file: path: what`.
[[noreturn]] void fail_at(std::string_view file, std::string_view path, std::string_view what);

}  // namespace pliant
