#include "pliant/mesh/shapes/sheets.h"

#include "pliant/mesh/shapes/limits.h"

namespace pliant {

namespace {

std::array<int, 2> axes_of(Plane plane) {
  switch (plane) {
    case Plane::xy:
      return {0, 1};
    case Plane::xz:
      return {0, 2};
    case Plane::yz:
      break;
  }
  return {1, 2};
}

/// Rows and columns of vertices in a plane, and the cells between them.
struct Lattice {
  Index columns;
  Index rows;
  std::array<Real, 2> size;
  Plane plane;

  explicit Lattice(const auto& options)
      : columns(options.columns), rows(options.rows), size(options.size), plane(options.plane) {}

  Index vertex(Index i, Index j) const { return j * columns + i; }
  Index vertex_count() const { return columns * rows; }
  bool is_border(Index i, Index j) const { return i == 0 || j == 0 || i == columns - 1 || j == rows - 1; }

  /// The place of (i, j), which may lie between vertices.
  Vec3 place(Real i, Real j) const {
    const auto [first, second] = axes_of(plane);
    Vec3 x = Vec3::Zero();
    x[first] = i / (columns - 1) * size[0];
    x[second] = j / (rows - 1) * size[1];
    return x;
  }
  Eigen::Matrix<Real, 1, 2> texture_coordinate(Real i, Real j) const { return {i / (columns - 1), j / (rows - 1)}; }

  /// Calls f(i, j) for each cell, named by its lower left vertex.
  void for_each_cell(auto&& f) const {
    for (Index j = 0; j + 1 < rows; ++j) {
      for (Index i = 0; i + 1 < columns; ++i) f(i, j);
    }
  }
};

/// Places vertex (i, j), which may lie between others, with the texture coordinates of its place.
void set_vertex(Mesh& mesh, const Lattice& lattice, Index vertex, Real i, Real j) {
  mesh.vertices.row(vertex) = lattice.place(i, j).transpose();
  mesh.texture_coordinates.row(vertex) = lattice.texture_coordinate(i, j);
}

void resize_vertices(Mesh& mesh, Index count) {
  mesh.vertices.resize(count, 3);
  mesh.texture_coordinates.resize(count, 2);
}

enum class Diagonal { forward, backward };

/// Appends the two triangles of the cell with these corners, see the drawing at `grid`.
void cut_cell(Diagonal diagonal, Index a, Index b, Index c, Index d, std::vector<Triangle>& triangles) {
  if (diagonal == Diagonal::forward) {
    triangles.insert(triangles.end(), {{a, b, d}, {a, d, c}});
  } else {
    triangles.insert(triangles.end(), {{a, b, c}, {b, d, c}});
  }
}

Diagonal alternating(Index i, Index j) {
  return (i + j) % 2 == 0 ? Diagonal::forward : Diagonal::backward;
}

/// The diagonal of a pillow's cell: through the corner where the cell has one, else alternating.
Diagonal sewn_diagonal(const Lattice& lattice, Index i, Index j) {
  const bool is_side = i == 0 || i == lattice.columns - 2;
  const bool is_end = j == 0 || j == lattice.rows - 2;
  if (!is_side || !is_end) return alternating(i, j);
  return (i == 0) == (j == 0) ? Diagonal::forward : Diagonal::backward;
}

/// Texture coordinates belong to corners of polygons: here the triangles. Vertex v has row v.
void keep_triangles_as_faces(Mesh& mesh) {
  for (const Triangle& triangle : mesh.triangles) {
    mesh.faces.offsets.push_back(static_cast<Index>(mesh.faces.vertices.size()));
    mesh.faces.vertices.insert(mesh.faces.vertices.end(), triangle.begin(), triangle.end());
  }
  mesh.faces.offsets.push_back(static_cast<Index>(mesh.faces.vertices.size()));
  mesh.faces.texture_coordinates = mesh.faces.vertices;
}

FaceGroup face_range(std::string name, std::size_t begin, std::size_t end) {
  FaceGroup group{std::move(name), FaceGroupKind::group, {}};
  for (std::size_t f = begin; f < end; ++f) group.faces.push_back(static_cast<Index>(f));
  return group;
}

}  // namespace

Mesh grid(const GridOptions& options) {
  check_options(options.shape, options);
  const bool is_crossed = options.diagonals == Diagonals::crossed;
  const Index cell_columns = options.columns - 1;
  const Index cell_rows = options.rows - 1;
  require_vertex_count("grid: columns and rows", Real{1} * options.columns * options.rows +
                                                     (is_crossed ? Real{1} * cell_columns * cell_rows : 0));

  const Lattice lattice(options);
  Mesh mesh;
  resize_vertices(mesh, lattice.vertex_count() + (is_crossed ? cell_columns * cell_rows : 0));
  for (Index j = 0; j < options.rows; ++j) {
    for (Index i = 0; i < options.columns; ++i) set_vertex(mesh, lattice, lattice.vertex(i, j), i, j);
  }
  lattice.for_each_cell([&](Index i, Index j) {
    const Index a = lattice.vertex(i, j);
    const Index b = a + 1;
    const Index c = lattice.vertex(i, j + 1);
    const Index d = c + 1;
    if (is_crossed) {
      const Index e = lattice.vertex_count() + j * cell_columns + i;
      set_vertex(mesh, lattice, e, i + 0.5, j + 0.5);
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, e}, {b, d, e}, {d, c, e}, {c, a, e}});
      return;
    }
    const Diagonal uniform = options.diagonals == Diagonals::forward ? Diagonal::forward : Diagonal::backward;
    cut_cell(options.diagonals == Diagonals::alternating ? alternating(i, j) : uniform, a, b, c, d, mesh.triangles);
  });
  keep_triangles_as_faces(mesh);
  return mesh;
}

Mesh net(const NetOptions& options) {
  check_options(options.shape, options);
  require_vertex_count("net: columns and rows", Real{1} * options.columns * options.rows);

  const Lattice lattice(options);
  Mesh mesh;
  mesh.vertices.resize(lattice.vertex_count(), 3);
  for (Index j = 0; j < options.rows; ++j) {
    for (Index i = 0; i < options.columns; ++i) {
      mesh.vertices.row(lattice.vertex(i, j)) = lattice.place(i, j).transpose();
      if (i > 0) mesh.edges.push_back({lattice.vertex(i - 1, j), lattice.vertex(i, j)});
    }
  }
  for (Index j = 1; j < options.rows; ++j) {
    for (Index i = 0; i < options.columns; ++i) {
      mesh.edges.push_back({lattice.vertex(i, j - 1), lattice.vertex(i, j)});
    }
  }
  if (options.diagonals == NetDiagonals::none) return mesh;
  lattice.for_each_cell([&](Index i, Index j) {
    mesh.edges.push_back({lattice.vertex(i, j), lattice.vertex(i + 1, j + 1)});
    mesh.edges.push_back({lattice.vertex(i + 1, j), lattice.vertex(i, j + 1)});
  });
  return mesh;
}

Mesh pillow(const PillowOptions& options) {
  check_options(options.shape, options);
  const Index inner_columns = options.columns - 2;
  const Index inner_rows = options.rows - 2;
  require_vertex_count("pillow: columns and rows",
                       Real{1} * options.columns * options.rows + Real{1} * inner_columns * inner_rows);

  const Lattice lattice(options);
  const auto back = [&](Index i, Index j) {
    if (lattice.is_border(i, j)) return lattice.vertex(i, j);
    return lattice.vertex_count() + (j - 1) * inner_columns + i - 1;
  };
  const auto [first, second] = axes_of(options.plane);
  const Vec3 normal = Vec3::Unit(first).cross(Vec3::Unit(second));
  Mesh mesh;
  resize_vertices(mesh, lattice.vertex_count() + inner_columns * inner_rows);
  for (Index j = 0; j < options.rows; ++j) {
    for (Index i = 0; i < options.columns; ++i) {
      set_vertex(mesh, lattice, lattice.vertex(i, j), i, j);
      if (lattice.is_border(i, j)) continue;
      set_vertex(mesh, lattice, back(i, j), i, j);
      mesh.vertices.row(lattice.vertex(i, j)) += options.gap / 2 * normal.transpose();
      mesh.vertices.row(back(i, j)) -= options.gap / 2 * normal.transpose();
    }
  }
  lattice.for_each_cell([&](Index i, Index j) {
    cut_cell(sewn_diagonal(lattice, i, j), lattice.vertex(i, j), lattice.vertex(i + 1, j), lattice.vertex(i, j + 1),
             lattice.vertex(i + 1, j + 1), mesh.triangles);
  });
  const std::size_t front_count = mesh.triangles.size();
  lattice.for_each_cell([&](Index i, Index j) {
    cut_cell(sewn_diagonal(lattice, i, j), back(i, j), back(i + 1, j), back(i, j + 1), back(i + 1, j + 1),
             mesh.triangles);
  });
  for (std::size_t t = front_count; t < mesh.triangles.size(); ++t) {
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  keep_triangles_as_faces(mesh);
  mesh.groups = {face_range("front", 0, front_count), face_range("back", front_count, mesh.triangles.size())};
  return mesh;
}

}  // namespace pliant
