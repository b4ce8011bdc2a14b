#include "pliant/mesh/topology.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pliant {

namespace {

constexpr std::array<std::array<int, 2>, 3> triangle_sides{{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<std::array<int, 2>, 6> tetrahedron_sides{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
/// Outward faces of a tetrahedron of positive volume.
constexpr std::array<std::array<int, 3>, 4> tetrahedron_faces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

/// Entries in ascending order of (key vertex, entry); those of vertex v are [offsets[v], offsets[v + 1]).
template <typename Entry>
struct Buckets {
  std::vector<std::size_t> offsets;
  std::vector<Entry> entries;

  std::span<Entry> bucket(Index vertex) {
    return std::span(entries).subspan(offsets[at(vertex)], offsets[at(vertex) + 1] - offsets[at(vertex)]);
  }
};

/// One counting sort by vertex, then many tiny sorts: several times faster than one sort of all keys. `visit_all` calls
/// its argument with (vertex, entry) for every entry, and is run twice.
template <typename Entry, typename VisitAll>
Buckets<Entry> sort_into_buckets(Index vertex_count, const VisitAll& visit_all) {
  Buckets<Entry> buckets;
  buckets.offsets.assign(at(vertex_count) + 1, 0);
  visit_all([&](Index vertex, const Entry&) { ++buckets.offsets[at(vertex) + 1]; });
  std::partial_sum(buckets.offsets.begin(), buckets.offsets.end(), buckets.offsets.begin());
  buckets.entries.resize(buckets.offsets.back());
  std::vector<std::size_t> next(buckets.offsets.begin(), buckets.offsets.end() - 1);
  visit_all([&](Index vertex, const Entry& entry) { buckets.entries[next[at(vertex)]++] = entry; });
  for (Index v = 0; v < vertex_count; ++v) std::ranges::sort(buckets.bucket(v));
  return buckets;
}

/// Calls visit(smaller, larger) for each edge of each element, shared ones repeatedly.
template <typename Visit>
void for_each_edge(const Mesh& mesh, const Visit& visit) {
  const auto visit_sides = [&](const auto& elements, const auto& sides) {
    for (const auto& element : elements) {
      for (const auto& [i, j] : sides) {
        const auto [low, high] =
            std::minmax(element[static_cast<std::size_t>(i)], element[static_cast<std::size_t>(j)]);
        visit(low, high);
      }
    }
  };
  visit_sides(mesh.triangles, triangle_sides);
  visit_sides(mesh.tetrahedra, tetrahedron_sides);
  visit_sides(mesh.edges, std::array<std::array<int, 2>, 1>{{{0, 1}}});
}

/// The vertices that occur in the elements, ascending.
template <typename Element>
std::vector<Index> vertices_of(Index vertex_count, const std::vector<Element>& elements) {
  std::vector<char> occurs(at(vertex_count), 0);
  for (const Element& element : elements) {
    for (Index vertex : element) occurs[at(vertex)] = 1;
  }
  std::vector<Index> vertices;
  for (Index v = 0; v < vertex_count; ++v) {
    if (occurs[at(v)]) vertices.push_back(v);
  }
  return vertices;
}

std::vector<Index> chain_ends(const Mesh& mesh) {
  std::vector<Index> valence(at(mesh.vertex_count()), 0);
  for (const auto& [a, b] : mesh.edges) {
    ++valence[at(a)];
    ++valence[at(b)];
  }
  std::vector<Index> ends;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (valence[at(v)] == 1) ends.push_back(v);
  }
  return ends;
}

/// The sides opposite one vertex in the triangles around it, as a graph on its neighbors. The vertex is interior when
/// the graph is one cycle, and lies on the boundary when it is one path. Storage is kept between vertices.
class VertexLink {
 public:
  enum class Shape { cycle, path, other };

  explicit VertexLink(Index vertex_count) : joined_(at(vertex_count), Edge{-1, -1}) {}

  /// `sides` are the opposite sides, each in the direction of its triangle; at least one.
  Shape walk(std::span<const Edge> sides) {
    const bool is_simple = join(sides);
    const Shape shape = is_simple ? walk_joined(sides) : Shape::other;
    for (const auto& [a, b] : sides) joined_[at(a)] = joined_[at(b)] = {-1, -1};
    return shape;
  }

  /// After a walk along a cycle: the neighbors in order.
  std::span<const Index> walked() const { return walked_; }

 private:
  /// Notes the one or two neighbors that each neighbor is joined to; false when there is a third.
  bool join(std::span<const Edge> sides) {
    const auto add = [&](Index from, Index to) {
      Edge& slots = joined_[at(from)];
      if (slots[1] >= 0) return false;
      slots[slots[0] < 0 ? 0 : 1] = to;
      return true;
    };
    return std::ranges::all_of(sides, [&](const Edge& side) { return add(side[0], side[1]) && add(side[1], side[0]); });
  }

  Shape walk_joined(std::span<const Edge> sides) {
    const auto is_end = [&](Index vertex) { return joined_[at(vertex)][1] < 0; };
    Edge step = sides.front();
    for (const auto& [a, b] : sides) {
      if (is_end(a)) step = {a, b};
      if (is_end(b)) step = {b, a};
    }
    const Index start = step[0];
    walked_.assign(1, start);
    while (step[1] != start && !is_end(step[1]) && walked_.size() < sides.size()) {
      walked_.push_back(step[1]);
      const Edge& next = joined_[at(step[1])];
      step = {step[1], next[0] == step[0] ? next[1] : next[0]};
    }
    if (walked_.size() != sides.size()) return Shape::other;
    // Two triangles on the same three vertices close after two steps, which is no neighborhood on a surface.
    if (step[1] == start) return walked_.size() > 2 ? Shape::cycle : Shape::other;
    return is_end(step[1]) ? Shape::path : Shape::other;
  }

  std::vector<Edge> joined_;
  std::vector<Index> walked_;
};

/// For each vertex the opposite sides of its triangles, ordered by triangle.
Buckets<std::pair<Index, Edge>> opposite_sides(const Mesh& mesh) {
  return sort_into_buckets<std::pair<Index, Edge>>(mesh.vertex_count(), [&](const auto& emit) {
    for (Index t = 0; t < count_of(mesh.triangles); ++t) {
      const auto& [a, b, c] = mesh.triangles[at(t)];
      emit(a, std::pair{t, Edge{b, c}});
      emit(b, std::pair{t, Edge{c, a}});
      emit(c, std::pair{t, Edge{a, b}});
    }
  });
}

/// The edge x0 x1 as the triangle runs along it, and the vertex opposite.
Triangle turned_to_edge(const Triangle& triangle, const Edge& edge) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Index opposite = triangle[i];
    const Index from = triangle[(i + 1) % 3];
    const Index to = triangle[(i + 2) % 3];
    if (std::minmax(from, to) == std::minmax(edge[0], edge[1])) return {from, to, opposite};
  }
  return {edge[0], edge[1], edge[0]};
}

Index find_root(std::vector<Index>& parent, Index vertex) {
  while (parent[at(vertex)] != vertex) {
    parent[at(vertex)] = parent[at(parent[at(vertex)])];
    vertex = parent[at(vertex)];
  }
  return vertex;
}

}  // namespace

std::vector<Edge> unique_edges(const Mesh& mesh) {
  auto larger_ends =
      sort_into_buckets<Index>(mesh.vertex_count(), [&](const auto& emit) { for_each_edge(mesh, emit); });
  std::vector<Edge> edges;
  edges.reserve(larger_ends.entries.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    for (Index larger : larger_ends.bucket(v)) {
      if (const Edge edge{v, larger}; edges.empty() || edges.back() != edge) edges.push_back(edge);
    }
  }
  edges.shrink_to_fit();
  return edges;
}

std::span<const Index> EdgeTriangles::triangles_of(Index edge) const {
  return std::span(triangles).subspan(at(offsets[at(edge)]), at(offsets[at(edge) + 1] - offsets[at(edge)]));
}

EdgeTriangles edge_triangles(const Mesh& mesh) {
  using End = std::pair<Index, Index>;  // the larger end, the triangle
  auto ends = sort_into_buckets<End>(mesh.vertex_count(), [&](const auto& emit) {
    for (Index t = 0; t < count_of(mesh.triangles); ++t) {
      const Triangle& triangle = mesh.triangles[at(t)];
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
        emit(low, End{high, t});
      }
    }
  });
  EdgeTriangles result;
  result.triangles.reserve(ends.entries.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    for (const auto& [larger, triangle] : ends.bucket(v)) {
      if (const Edge edge{v, larger}; result.edges.empty() || result.edges.back() != edge) {
        result.edges.push_back(edge);
        result.offsets.push_back(count_of(result.triangles));
      }
      result.triangles.push_back(triangle);
    }
  }
  result.offsets.push_back(count_of(result.triangles));
  return result;
}

std::vector<Edge> boundary_edges(const Mesh& mesh) {
  const EdgeTriangles adjacency = edge_triangles(mesh);
  std::vector<Edge> boundary;
  for (Index e = 0; e < adjacency.edge_count(); ++e) {
    if (adjacency.triangles_of(e).size() == 1) boundary.push_back(adjacency.edges[at(e)]);
  }
  return boundary;
}

std::vector<std::vector<Index>> boundary_loops(std::vector<Edge> edges) {
  const std::size_t count = edges.size();
  edges.reserve(2 * count);
  for (std::size_t e = 0; e < count; ++e) edges.push_back({edges[e][1], edges[e][0]});
  std::ranges::sort(edges);
  std::vector<char> is_walked(edges.size(), 0);
  std::vector<std::size_t> next(edges.size());  // of the entries of a vertex, kept at its first: the first not walked
  std::iota(next.begin(), next.end(), std::size_t{0});
  const auto entry = [&](const Edge& edge) {
    return static_cast<std::size_t>(std::ranges::lower_bound(edges, edge) - edges.begin());
  };
  std::vector<std::vector<Index>> loops;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (is_walked[start] != 0) continue;
    std::vector<Index>& loop = loops.emplace_back();
    for (Index vertex = edges[start][0];;) {
      std::size_t& step = next[entry({vertex, 0})];
      while (step < edges.size() && edges[step][0] == vertex && is_walked[step] != 0) ++step;
      if (step == edges.size() || edges[step][0] != vertex) break;
      const Edge edge = edges[step];
      is_walked[step] = is_walked[entry({edge[1], edge[0]})] = 1;
      loop.push_back(vertex);
      vertex = edge[1];
    }
  }
  return loops;
}

std::vector<Triangle> boundary_triangles(std::span<const Tetrahedron> tetrahedra) {
  const auto face_of = [&](std::size_t face) {
    const Tetrahedron& tetrahedron = tetrahedra[face / 4];
    const auto& corners = tetrahedron_faces[face % 4];
    return Triangle{tetrahedron[static_cast<std::size_t>(corners[0])],
                    tetrahedron[static_cast<std::size_t>(corners[1])],
                    tetrahedron[static_cast<std::size_t>(corners[2])]};
  };
  Index vertex_count = 0;
  for (const Tetrahedron& tetrahedron : tetrahedra)
    vertex_count = std::max(vertex_count, 1 + *std::ranges::max_element(tetrahedron));

  using Entry = std::pair<Edge, std::size_t>;  // the two larger vertices, the face
  auto faces = sort_into_buckets<Entry>(vertex_count, [&](const auto& emit) {
    for (std::size_t f = 0; f < 4 * tetrahedra.size(); ++f) {
      Triangle sorted = face_of(f);
      std::ranges::sort(sorted);
      emit(sorted[0], Entry{{sorted[1], sorted[2]}, f});
    }
  });
  std::vector<std::size_t> lonely;
  for (Index v = 0; v < vertex_count; ++v) {
    const auto bucket = faces.bucket(v);
    for (auto first = bucket.begin(); first != bucket.end();) {
      const auto last =
          std::find_if(first, bucket.end(), [&](const Entry& entry) { return entry.first != first->first; });
      if (last - first == 1) lonely.push_back(first->second);
      first = last;
    }
  }
  std::ranges::sort(lonely);
  std::vector<Triangle> surface;
  surface.reserve(lonely.size());
  for (std::size_t face : lonely) surface.push_back(face_of(face));
  return surface;
}

std::vector<Index> boundary_vertices(const Mesh& mesh) {
  if (!mesh.triangles.empty()) return vertices_of(mesh.vertex_count(), boundary_edges(mesh));
  if (!mesh.tetrahedra.empty()) return vertices_of(mesh.vertex_count(), boundary_triangles(mesh.tetrahedra));
  return chain_ends(mesh);
}

std::span<const Index> VertexRings::ring(Index r) const {
  return std::span(neighbors).subspan(at(offsets[at(r)]), at(offsets[at(r) + 1] - offsets[at(r)]));
}

VertexRings vertex_rings(const Mesh& mesh) {
  VertexRings rings;
  rings.offsets.push_back(0);
  auto triangles = opposite_sides(mesh);
  VertexLink link(mesh.vertex_count());
  std::vector<Edge> sides;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    sides.clear();
    for (const auto& [triangle, side] : triangles.bucket(v)) sides.push_back(side);
    if (sides.empty()) {
      ++rings.isolated_vertex_count;
      continue;
    }
    const VertexLink::Shape shape = link.walk(sides);
    if (shape == VertexLink::Shape::path) ++rings.boundary_vertex_count;
    if (shape == VertexLink::Shape::other) ++rings.nonmanifold_vertex_count;
    if (shape != VertexLink::Shape::cycle) continue;
    rings.centers.push_back(v);
    rings.neighbors.insert(rings.neighbors.end(), link.walked().begin(), link.walked().end());
    rings.offsets.push_back(count_of(rings.neighbors));
  }
  return rings;
}

Hinges hinges(const Mesh& mesh) {
  const EdgeTriangles adjacency = edge_triangles(mesh);
  Hinges result;
  for (Index e = 0; e < adjacency.edge_count(); ++e) {
    const auto triangles = adjacency.triangles_of(e);
    if (triangles.size() == 1) ++result.boundary_edge_count;
    if (triangles.size() > 2) ++result.nonmanifold_edge_count;
    if (triangles.size() != 2) continue;
    const Edge& edge = adjacency.edges[at(e)];
    const auto [x0, x1, x2] = turned_to_edge(mesh.triangles[at(triangles[0])], edge);
    const Index x3 = turned_to_edge(mesh.triangles[at(triangles[1])], edge)[2];
    if (x2 == x3) {
      ++result.degenerate_edge_count;
    } else {
      result.stencils.push_back({x0, x1, x2, x3});
    }
  }
  return result;
}

std::vector<Index> components(const Mesh& mesh) {
  std::vector<Index> parent(at(mesh.vertex_count()));
  std::iota(parent.begin(), parent.end(), 0);
  // The smaller root always wins, so a component's root is its smallest vertex.
  for_each_edge(mesh, [&](Index a, Index b) {
    const auto [low, high] = std::minmax({find_root(parent, a), find_root(parent, b)});
    parent[at(high)] = low;
  });
  std::vector<Index> component(parent.size());
  Index count = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index root = find_root(parent, v);
    component[at(v)] = root == v ? count++ : component[at(root)];
  }
  return component;
}

}  // namespace pliant
