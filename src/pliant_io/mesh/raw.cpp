#include "pliant_io/mesh/raw.h"

#include <fmt/format.h>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/detail/text_lexer.h"

namespace pliant {

Mesh read_raw(const ByteSource& source) {
  TextLexer lexer(source, {.comment = '#'});
  Mesh mesh;
  std::vector<Real> numbers;
  while (lexer.next_line()) {
    const std::size_t start = numbers.size();
    for (auto word = lexer.next_word(); !word.empty(); word = lexer.next_word()) numbers.push_back(lexer.number(word));
    if (numbers.size() - start != 9) {
      lexer.fail(fmt::format("{} numbers for a triangle; give nine", numbers.size() - start));
    }
    const auto first = static_cast<Index>(start / 3);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.vertices = Eigen::Map<const Positions>(numbers.data(), static_cast<Eigen::Index>(numbers.size() / 3), 3);
  return mesh;
}

void write_raw(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  check_positions(path, mesh, positions);
  AtomicFile file(path);
  TextOutput text(file);
  for (const Triangle& triangle : visible_triangles(mesh)) {
    for (const Index corner : triangle) {
      for (int axis = 0; axis < 3; ++axis) text << positions(corner, axis) << " ";
    }
    text.end_line();
  }
  text.flush();
  file.commit();
}

}  // namespace pliant
