#include "pliant/mesh/io/vertex_map.h"

#include <cmath>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/io/detail/obj_lexer.h"
#include "pliant/mesh/io/read_file.h"

namespace pliant {

std::vector<Real> parse_vertex_map(std::string_view bytes, std::string_view name) {
  ObjLexer lexer(bytes, name);
  std::vector<Real> values;
  while (lexer.next_line()) {
    values.push_back(lexer.number(lexer.next_word()));
    if (!lexer.next_word().empty()) lexer.fail("more than one number in a line; give one for each vertex");
  }
  if (values.empty()) fail_input(fmt::format("{}: no numbers; give one a line", name));
  return values;
}

std::vector<Real> read_vertex_map(const std::filesystem::path& path) {
  return parse_vertex_map(read_file(path), path.string());
}

}  // namespace pliant
