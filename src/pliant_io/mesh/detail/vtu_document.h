#pragma once
// The XML of a .vtu file, and the part of the file behind it.
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include "pliant_io/mesh/detail/vtu_data.h"

namespace pliant {

class VtuDocument {
 public:
  /// Everything but appended data is in memory. @throws Error (input): no XML, or not that of an UnstructuredGrid.
  explicit VtuDocument(const ByteSource& source);

  /// The element UnstructuredGrid.
  pugi::xml_node grid() const { return grid_; }

  /// How many numbers an array has per point; "NumberOfComponents", 1 where it is missing.
  std::int64_t components(const pugi::xml_node& array) const;
  /// An attribute that counts, up to `most`.
  std::int64_t count(const pugi::xml_node& element, const char* attribute, std::uint64_t most) const;

  /// Fills `into` with the numbers of an array, of which there must be so many.
  void read_reals(const pugi::xml_node& array, std::span<Real> into);
  /// The numbers of an array, all of which must be from 0 to `most`; `what` is what messages call one.
  std::vector<Index> read_indices(const pugi::xml_node& array, std::int64_t most, std::string_view what);

  /// Whether there can be so many numbers.
  bool has_room(std::uint64_t numbers) const;

  /// Throws Error (input): `name:line: message`, with the line of the element.
  [[noreturn]] void fail(const pugi::xml_node& element, std::string_view message) const;

 private:
  void load();
  void check_text() const;
  void find_appended();
  void read_head();
  VtkType type_of(const pugi::xml_node& array) const;
  std::string bytes(const pugi::xml_node& array);
  [[noreturn]] void fail_at(std::uint64_t offset, std::string_view message) const;

  const ByteSource& source_;
  std::string text_;  ///< what the document points into
  pugi::xml_document document_;
  pugi::xml_node grid_;
  ByteRange appended_;
  VtuStream::Form appended_form_ = VtuStream::Form::raw;
  VtuCoding coding_;
  VtuDecoder decoder_;
};

}  // namespace pliant
