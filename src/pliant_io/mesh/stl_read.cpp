#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/polygon_builder.h"
#include "pliant_io/mesh/detail/text_lexer.h"
#include "pliant_io/mesh/stl.h"

namespace pliant {

namespace {

constexpr std::uint64_t header_size = 84;
constexpr std::uint64_t facet_size = 50;

using Point = std::array<Real, 3>;

/// STL repeats the points of every facet. Equal ones become one vertex, in the order in which they first appear.
class PointMerger {
 public:
  Index merge(Point point) {
    for (Real& x : point) x += 0;  // −0 is 0
    if (2 * points_.size() >= slots_.size()) grow();
    Index& slot = slot_of(point);
    if (slot < 0) {
      slot = static_cast<Index>(points_.size());
      points_.push_back(point);
    }
    return slot;
  }

  std::size_t count() const { return points_.size(); }
  const std::vector<Point>& points() const { return points_; }

 private:
  /// The slot that holds the point, or the free one that it belongs into.
  Index& slot_of(const Point& point) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash(point) & mask;
    while (slots_[at] >= 0 && points_[static_cast<std::size_t>(slots_[at])] != point) at = (at + 1) & mask;
    return slots_[at];
  }

  void grow() {
    slots_.assign(std::max<std::size_t>(1 << 10, 2 * slots_.size()), -1);
    for (std::size_t p = 0; p < points_.size(); ++p) slot_of(points_[p]) = static_cast<Index>(p);
  }

  /// Sums of products with random keys, of which the upper half is taken: whatever two points are, their hashes are the
  /// same with probability 2^-32 (multilinear hashing: Carter and Wegman 1979, Lemire and Kaser 2014). So no file can
  /// be made for points that all meet in one slot. Numbers do not depend on the keys, only the time to find them does.
  std::size_t hash(const Point& point) const {
    std::uint64_t sum = keys_[6];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto bits = std::bit_cast<std::uint64_t>(point[k]);
      sum += keys_[2 * k] * (bits & 0xffffffffU) + keys_[2 * k + 1] * (bits >> 32U);
    }
    const std::uint64_t mixed = (sum >> 32U) * 0x9e3779b97f4a7c15U;  // grids would give rows of neighboring slots
    return static_cast<std::size_t>(mixed >> 32U);
  }

  static std::array<std::uint64_t, 7> random_keys() {
    std::random_device device;
    std::array<std::uint64_t, 7> keys{};
    for (std::uint64_t& key : keys) key = std::uint64_t{device()} << 32U | device();
    return keys;
  }

  std::array<std::uint64_t, 7> keys_ = random_keys();
  std::vector<Point> points_;
  std::vector<Index> slots_;  ///< a power of two, at most half of them used; -1 is free
};

class FacetList {
 public:
  explicit FacetList(const ByteSource& source) : source_(source) {}

  void reserve(std::uint64_t facets) { mesh_.triangles.reserve(static_cast<std::size_t>(facets)); }

  /// Two corners at one point leave no facet.
  void add(const std::array<Point, 3>& corners) {
    if (points_.count() + 3 > max_index_count)
      source_.fail(fmt::format("more than {} vertices; cut it up", max_index_count));
    const Triangle triangle = {points_.merge(corners[0]), points_.merge(corners[1]), points_.merge(corners[2])};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
      ++mesh_.collapsed_face_count;
    } else {
      mesh_.triangles.push_back(triangle);
    }
  }

  Mesh finish() {
    if (points_.count() == 0) source_.fail("no facets; export the mesh again");
    mesh_.vertices =
        Eigen::Map<const Positions>(points_.points().front().data(), static_cast<Eigen::Index>(points_.count()), 3);
    return std::move(mesh_);
  }

 private:
  const ByteSource& source_;
  Mesh mesh_;
  PointMerger points_;
};

// ---- binary: 80 bytes of anything, a count, and 50 bytes a facet: normal, three points, two bytes of anything

std::uint32_t little_endian(const char* bytes) {
  std::array<unsigned char, 4> b;
  std::memcpy(b.data(), bytes, 4);
  return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

Point read_point(const char* bytes, const ByteSource& source, std::uint64_t facet) {
  Point point;
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = std::bit_cast<float>(little_endian(bytes + 4 * k));
    if (!std::isfinite(point[k])) {
      source.fail(fmt::format("facet {} has a coordinate that is not finite; export the mesh again", facet));
    }
  }
  return point;
}

Mesh read_binary(const ByteSource& source, std::uint64_t facet_count) {
  constexpr std::size_t facets_at_once = 4096;
  std::vector<char> block(static_cast<std::size_t>(facet_size) * facets_at_once);
  FacetList facets(source);
  facets.reserve(facet_count);
  for (std::uint64_t first = 0; first < facet_count; first += facets_at_once) {
    const std::uint64_t count = std::min<std::uint64_t>(facets_at_once, facet_count - first);
    source.read(header_size + first * facet_size, block.data(), static_cast<std::size_t>(count * facet_size));
    for (std::uint64_t f = 0; f < count; ++f) {
      const char* const points = block.data() + f * facet_size + 12;
      facets.add({read_point(points, source, first + f), read_point(points + 12, source, first + f),
                  read_point(points + 24, source, first + f)});
    }
  }
  return facets.finish();
}

// ---- text: words, wherever the lines end

class StlTextReader {
 public:
  explicit StlTextReader(const ByteSource& source) : lexer_(source, {}), facets_(source) {}

  Mesh read() {
    expect("solid");
    lexer_.skip_rest_of_line();  // a name
    for (;;) {
      const std::string_view word = next_word();
      if (is(word, "facet")) {
        read_facet();
      } else if (is(word, "endsolid")) {
        lexer_.skip_rest_of_line();
        if (!lexer_.next_line()) return facets_.finish();
        expect("solid");
        lexer_.skip_rest_of_line();
      } else {
        lexer_.fail(fmt::format("{} in place of a facet; write facet or endsolid", TextLexer::quoted(word)));
      }
    }
  }

 private:
  /// Small letters and capitals are the same.
  static bool is(std::string_view word, std::string_view keyword) {
    return std::ranges::equal(word, keyword, [](char a, char b) {
      return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    });
  }

  std::string_view next_word() {
    std::string_view word = lexer_.next_word();
    while (word.empty()) {
      if (!lexer_.next_line()) lexer_.fail("the file ends without endsolid; it may be cut short");
      word = lexer_.next_word();
    }
    return word;
  }

  void expect(std::string_view keyword) {
    const std::string_view word = next_word();
    if (!is(word, keyword)) {
      lexer_.fail(fmt::format("{} in place of {}; export the mesh again", TextLexer::quoted(word), keyword));
    }
  }

  void read_facet() {
    expect("normal");
    for (int k = 0; k < 3; ++k) next_word();  // often zero or not finite, and never needed
    expect("outer");
    expect("loop");
    std::array<Point, 3> corners;
    for (Point& corner : corners) {
      expect("vertex");
      for (Real& x : corner) x = lexer_.number(next_word());
    }
    expect("endloop");
    expect("endfacet");
    facets_.add(corners);
  }

  TextLexer lexer_;
  FacetList facets_;
};

/// Whether the first bytes are text that starts with `solid`, which headers of binary files may do as well.
bool looks_like_text(std::string_view start) {
  const std::string_view mark = "\xEF\xBB\xBF";
  if (start.starts_with(mark)) start.remove_prefix(mark.size());
  const std::size_t first = start.find_first_not_of(" \t\r\n\v\f");
  if (first == std::string_view::npos || start.size() - first < 5) return false;
  const std::string_view keyword = start.substr(first, 5);
  const bool is_solid = std::ranges::equal(keyword, std::string_view("solid"),
                                           [](char a, char b) { return static_cast<char>(a | 0x20) == b; });
  return is_solid && start.find('\0') == std::string_view::npos;
}

}  // namespace

Mesh read_stl(const ByteSource& source) {
  std::array<char, 1024> bytes{};
  const std::string_view start(bytes.data(), source.read(0, bytes.data(), bytes.size()));
  const bool has_count = start.size() >= header_size;
  const std::uint64_t facet_count = has_count ? little_endian(start.data() + 80) : 0;
  const std::uint64_t expected = header_size + facet_count * facet_size;
  // The size of a binary file follows from its count; text never meets it, its "count" being four letters.
  if (has_count && source.size() == expected) return read_binary(source, facet_count);
  if (looks_like_text(start)) return StlTextReader(source).read();
  if (!has_count)
    source.fail("neither starts with \"solid\" nor has the 84 bytes of a binary header; give an STL file");
  if (source.size() < expected || source.size() >= expected + facet_size) {
    source.fail(
        fmt::format("the header counts {} facets, which take {} bytes, but the file has {}; it may be cut short",
                    facet_count, expected, source.size()));
  }
  return read_binary(source, facet_count);
}

}  // namespace pliant
