// VTK's legacy files, of versions 1 to 5.
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pliant_io/mesh/detail/text_lexer.h"
#include "pliant_io/mesh/detail/vtk_cells.h"
#include "pliant_io/mesh/detail/vtk_input.h"
#include "pliant_io/mesh/vtk.h"

namespace pliant {

namespace {

/// A section of POLYDATA, and the type of its cells.
struct PolyDataSection {
  std::string_view name;
  std::int64_t type;
};
constexpr std::array<PolyDataSection, 4> poly_data_sections{{{"VERTICES", vtk_cell::vertices},
                                                             {"LINES", vtk_cell::polyline},
                                                             {"POLYGONS", vtk_cell::polygon},
                                                             {"TRIANGLE_STRIPS", vtk_cell::strip}}};

char changed_case(char c, char first, char other) {
  return c >= first && c <= first + 25 ? static_cast<char>(c - first + other) : c;
}

/// Keywords may be written in either case.
std::string capitals(std::string word) {
  for (char& c : word) c = changed_case(c, 'a', 'A');
  return word;
}

std::string small_letters(std::string word) {
  for (char& c : word) c = changed_case(c, 'A', 'a');
  return word;
}

class VtkReader {
 public:
  explicit VtkReader(const ByteSource& source) : source_(source), input_(source), cells_(mesh_, source.size()) {}

  Mesh read() {
    read_head();
    for (std::string word = capitals(input_.next_word()); !word.empty(); word = capitals(input_.next_word())) {
      if (word == "POINT_DATA" || word == "CELL_DATA") break;  // no shape comes behind
      read_section(word);
    }
    if (mesh_.vertex_count() == 0) source_.fail("no POINTS; give at least one");
    if (is_grid_) add_grid_cells();
    cells_.finish();
    return std::move(mesh_);
  }

 private:
  void expect(std::string_view word) {
    const std::string found = input_.next_word();
    if (capitals(found) == word) return;
    input_.fail(fmt::format("{} in place of {}; save the mesh as a file of VTK", TextLexer::quoted(found), word));
  }

  void read_head() {
    for (const std::string_view word : {"#", "VTK", "DATAFILE", "VERSION"}) expect(word);
    const std::string version = input_.next_word();
    if (version.size() < 2 || version[0] < '1' || version[0] > '5' || version[1] != '.') {
      input_.fail(fmt::format("version {}; save the mesh in one from 1.0 to 5.1", TextLexer::quoted(version)));
    }
    input_.rest_of_line();
    input_.rest_of_line();  // the title
    const std::string form = input_.next_word();
    if (capitals(form) != "ASCII" && capitals(form) != "BINARY") {
      input_.fail(fmt::format("{} in place of ASCII or BINARY; save the file anew", TextLexer::quoted(form)));
    }
    expect("DATASET");
    const std::string dataset = input_.next_word();
    is_grid_ = capitals(dataset) == "UNSTRUCTURED_GRID";
    if (!is_grid_ && capitals(dataset) != "POLYDATA") {
      input_.fail(fmt::format("dataset {}; save an UNSTRUCTURED_GRID or POLYDATA", TextLexer::quoted(dataset)));
    }
    if (capitals(form) == "BINARY") input_.set_form(VtkInput::Form::binary);
  }

  void read_section(const std::string& name) {
    const auto* part = std::ranges::find(poly_data_sections, name, &PolyDataSection::name);
    if (name == "POINTS") {
      read_points();
    } else if (is_grid_ && name == "CELLS") {
      has_cells_ = true;
      read_lists();
    } else if (is_grid_ && name == "CELL_TYPES") {
      read_types();
    } else if (!is_grid_ && part != poly_data_sections.end()) {
      read_lists();
      for (std::size_t c = 0; c < cell_count(); ++c) add_cell(c, part->type);
      cell_number_ += cell_count();
    } else if (name == "METADATA") {
      input_.skip_to_empty_line();
    } else if (name == "FIELD") {
      skip_field();
    } else {
      input_.fail(fmt::format("{} in place of a section; save the mesh anew", TextLexer::quoted(name)));
    }
  }

  VtkType take_type() {
    const std::string name = input_.next_word();
    const auto type = legacy_type(small_letters(name));
    if (!type) input_.fail(fmt::format("numbers of type {}; save float, double or int", TextLexer::quoted(name)));
    return *type;
  }

  VtkType take_integer_type() {
    const VtkType type = take_type();
    if (is_float(type)) input_.fail("indices that are floats; save whole numbers");
    return type;
  }

  void read_points() {
    if (mesh_.vertex_count() > 0) input_.fail("POINTS twice; save one piece");
    const std::uint64_t count = input_.count(3, VtkType::int8);
    const VtkType type = take_type();
    input_.check_count(count, 3, type);
    input_.begin_numbers();
    mesh_.vertices.resize(static_cast<Eigen::Index>(count), 3);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      for (Eigen::Index k = 0; k < 3; ++k) mesh_.vertices(v, k) = input_.real(type);
      if (!mesh_.vertices.row(v).allFinite()) {
        input_.fail(fmt::format("a coordinate of vertex {} is not finite; give a number", v));
      }
    }
  }

  // ---- lists of vertices, one for each cell

  std::size_t cell_count() const { return ends_.size(); }

  void read_lists() {
    const std::uint64_t first = input_.count(1, VtkType::int8);
    const std::uint64_t second = input_.count(1, VtkType::int8);
    input_.begin_numbers();
    ends_.clear();
    corners_.clear();
    input_.comes_next("OFFSETS") ? read_offsets(first, second) : read_counted(first, second);
  }

  /// In front of each list stands how long it is.
  void read_counted(std::uint64_t count, std::uint64_t size) {
    input_.check_count(size, 1, VtkType::int32);
    if (count > size) input_.fail(fmt::format("{} cells of {} numbers; correct the counts", count, size));
    ends_.reserve(static_cast<std::size_t>(count));
    corners_.reserve(static_cast<std::size_t>(size - count));
    for (std::uint64_t c = 0; c < count; ++c) {
      const std::int64_t length = input_.integer(VtkType::int32);
      if (length < 0 || static_cast<std::uint64_t>(length) > size - count - corners_.size()) {
        input_.fail(fmt::format("cell {} of {} vertices, more than the section counts; correct it", c, length));
      }
      for (std::int64_t i = 0; i < length; ++i) take_corner(VtkType::int32);
      ends_.push_back(static_cast<Index>(corners_.size()));
    }
    if (corners_.size() != size - count) {
      input_.fail(fmt::format("{} numbers in the cells, where the section counts {}; correct it",
                              corners_.size() + count, size));
    }
  }

  /// As version 5 has it: where each list begins, and at last where the last one ends; then all lists.
  void read_offsets(std::uint64_t offset_count, std::uint64_t corner_count) {
    expect("OFFSETS");
    const VtkType offset_type = take_integer_type();
    input_.check_count(offset_count, 1, offset_type);
    input_.begin_numbers();
    ends_.reserve(static_cast<std::size_t>(offset_count));
    std::int64_t last = 0;
    for (std::uint64_t i = 0; i < offset_count; ++i) {
      const std::int64_t end = input_.integer(offset_type);
      if (end < last || static_cast<std::uint64_t>(end) > corner_count || (i == 0 && end != 0)) {
        input_.fail(
            fmt::format("offset {} is {}, behind {} and for {} vertices; correct it", i, end, last, corner_count));
      }
      if (i > 0) ends_.push_back(static_cast<Index>(end));
      last = end;
    }
    expect("CONNECTIVITY");
    const VtkType type = take_integer_type();
    input_.check_count(corner_count, 1, type);
    input_.begin_numbers();
    corners_.reserve(static_cast<std::size_t>(corner_count));
    for (std::uint64_t i = 0; i < corner_count; ++i) take_corner(type);
  }

  void take_corner(VtkType type) {
    const std::int64_t vertex = input_.integer(type);
    if (mesh_.vertex_count() == 0) input_.fail("cells before any POINTS; give those first");
    if (vertex < 0 || vertex >= mesh_.vertex_count()) {
      input_.fail(fmt::format("vertex {} is out of range, since the file has {}; use 0 to {}", vertex,
                              mesh_.vertex_count(), mesh_.vertex_count() - 1));
    }
    corners_.push_back(static_cast<Index>(vertex));
  }

  void read_types() {
    const std::uint64_t count = input_.count(1, VtkType::int32);
    input_.begin_numbers();
    types_.clear();
    types_.reserve(static_cast<std::size_t>(count));
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::int64_t type = input_.integer(VtkType::int32);
      types_.push_back(static_cast<std::uint8_t>(type >= 0 && type < 255 ? type : 255));
    }
  }

  void add_grid_cells() {
    if (!has_cells_) source_.fail("no CELLS; the file may be cut short");
    if (types_.size() != cell_count()) {
      source_.fail(fmt::format("{} CELL_TYPES for {} cells; the file may be cut short", types_.size(), cell_count()));
    }
    for (std::size_t c = 0; c < cell_count(); ++c) add_cell(c, types_[c]);
  }

  void add_cell(std::size_t cell, std::int64_t type) {
    const auto begin = static_cast<std::size_t>(cell == 0 ? 0 : ends_[cell - 1]);
    const auto size = static_cast<std::size_t>(ends_[cell]) - begin;
    const std::string message = cells_.add(type, std::span(corners_).subspan(begin, size));
    if (!message.empty()) source_.fail(fmt::format("cell {}: {}", cell_number_ + cell, message));
  }

  /// Arrays of anything, say the time of a simulation.
  void skip_field() {
    input_.next_word();  // its name
    for (std::uint64_t left = input_.count(3, VtkType::int8); left > 0; --left) {
      input_.next_word();
      const std::uint64_t components = input_.count(0, VtkType::int8);
      const std::uint64_t tuples = input_.count(0, VtkType::int8);
      const VtkType type = take_type();
      input_.check_count(tuples, components, type);
      input_.begin_numbers();
      input_.skip(tuples * components, type);
    }
  }

  const ByteSource& source_;
  VtkInput input_;
  Mesh mesh_;
  VtkCellBuilder cells_;
  bool is_grid_ = false;  ///< or POLYDATA
  bool has_cells_ = false;
  std::vector<Index> ends_;  ///< of each list in corners_
  std::vector<Index> corners_;
  std::vector<std::uint8_t> types_;
  std::size_t cell_number_ = 0;  ///< of the first cell of the section
};

}  // namespace

Mesh read_vtk(const ByteSource& source) {
  return VtkReader(source).read();
}

}  // namespace pliant
