#pragma once
// What the writers share: the faces that a file shows, the check of positions, and text in blocks.
#include <charconv>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/mesh/mesh.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/number_text.h"

namespace pliant {

/// @throws Error (input), naming the file, unless there is a finite position for every vertex.
void check_positions(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

/// The triangles that a file shows of a mesh without polygons: its own, else the surface of its tetrahedra.
std::vector<Triangle> visible_triangles(const Mesh& mesh);

/// The faces that a file shows of a mesh: its polygons, else its visible triangles.
class VisibleFaces {
 public:
  explicit VisibleFaces(const Mesh& mesh);

  std::size_t size() const { return polygons_ != nullptr ? polygons_->offsets.size() - 1 : triangles_.size(); }
  std::span<const Index> operator[](std::size_t face) const;

  /// Where the corners of a polygon begin in PolygonFaces; nothing but polygons has texture coordinates.
  std::size_t first_corner(std::size_t face) const { return static_cast<std::size_t>(polygons_->offsets[face]); }
  bool has_texture() const { return polygons_ != nullptr && !polygons_->texture_coordinates.empty(); }
  /// Whether every corner has the texture coordinate of its vertex, a row of the same number.
  bool has_texture_by_vertex(const Mesh& mesh) const;

 private:
  const PolygonFaces* polygons_ = nullptr;
  std::vector<Triangle> triangles_;
};

/// Text on its way into a file, in blocks.
class TextOutput {
 public:
  explicit TextOutput(AtomicFile& file) : file_(file) {}

  TextOutput& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  /// The shortest digits that read back to the same number.
  template <typename Number>
  requires std::is_arithmetic_v<Number> TextOutput& operator<<(Number number) {
    NumberText digits;
    const char* end = nullptr;
    if constexpr (std::is_same_v<Number, Real>) {
      end = number_to_chars(digits, number);
    } else {
      end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    }
    text_ += std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
    return *this;
  }
  void end_line();
  void flush_when_full();
  /// Hands the rest to the file. To be called last.
  void flush();

 private:
  AtomicFile& file_;
  std::string text_;
};

}  // namespace pliant
