#pragma once
// .vtu files out: XML around arrays that are compressed by zlib and in base64.
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// Numbers of all points or cells.
struct VtuArray {
  std::string name;
  std::string_view type;  ///< "Float64" and so on
  Index components = 1;
  std::string bytes{};
};

template <class Number>
VtuArray vtu_array(std::string name, Index components, std::span<const Number> numbers) {
  constexpr bool is_known = std::is_same_v<Number, double> || std::is_same_v<Number, float> ||
                            std::is_same_v<Number, std::int32_t> || std::is_same_v<Number, std::int64_t> ||
                            std::is_same_v<Number, std::uint8_t>;
  static_assert(is_known);
  constexpr std::string_view type = std::is_same_v<Number, double>         ? "Float64"
                                    : std::is_same_v<Number, float>        ? "Float32"
                                    : std::is_same_v<Number, std::int32_t> ? "Int32"
                                    : std::is_same_v<Number, std::int64_t> ? "Int64"
                                                                           : "UInt8";
  VtuArray array{std::move(name), type, components, std::string(numbers.size_bytes(), '\0')};
  if (!numbers.empty()) std::memcpy(array.bytes.data(), numbers.data(), numbers.size_bytes());
  return array;
}

/// The cells of one mesh or several, encoded once for any number of files.
class VtuCells {
 public:
  /// Adds the tetrahedra of a mesh, else its polygons, else its triangles; its edges; and of one without any of them
  /// its vertices.
  void add(const Mesh& mesh, Index first_vertex);

  /// The element Cells; `count` how many there are.
  std::string element() const;
  std::int64_t count() const { return static_cast<std::int64_t>(types_.size()); }

 private:
  void add_cell(std::int64_t type, std::span<const Index> corners, Index first_vertex);

  std::vector<std::int64_t> corners_;
  std::vector<std::int64_t> ends_;
  std::vector<std::uint8_t> types_;
};

/// What a file needs beside its points and their numbers.
struct VtuFrame {
  std::string_view cells;  ///< VtuCells::element()
  std::int64_t cell_count = 0;
};

/// Writes a file, whole or not at all.
void write_vtu_file(const std::filesystem::path& path, const Positions& positions, const VtuFrame& frame,
                    std::span<const VtuArray> point_data);

/// Text as the value of an attribute: without what XML cannot hold.
std::string xml_attribute_text(std::string_view text);

}  // namespace pliant
