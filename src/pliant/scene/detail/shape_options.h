#pragma once
// The options of mesh/shapes.h as scene files have them: name, type and function of each shape.
#include <tuple>

#include "pliant/mesh/shapes.h"

namespace pliant {

constexpr std::array<std::string_view, 3> choice_names(Plane) {
  return {"xy", "xz", "yz"};
}
constexpr std::array<std::string_view, 4> choice_names(Diagonals) {
  return {"forward", "backward", "alternating", "crossed"};
}
constexpr std::array<std::string_view, 2> choice_names(Caps) {
  return {"open", "closed"};
}
constexpr std::array<std::string_view, 2> choice_names(TetrahedronCut) {
  return {"five", "six"};
}

struct GridShape {
  static constexpr std::string_view name = "grid";
  GridOptions options;
  Mesh make() const { return grid(options); }
  void visit(auto&& field) {
    field("columns", options.columns);
    field("rows", options.rows);
    field("size", options.size);
    field("plane", options.plane);
    field("diagonals", options.diagonals);
  }
};

struct TorusShape {
  static constexpr std::string_view name = "torus";
  TorusOptions options;
  Mesh make() const { return torus(options); }
  void visit(auto&& field) {
    field("major_segments", options.major_segments);
    field("minor_segments", options.minor_segments);
    field("major_radius", options.major_radius);
    field("minor_radius", options.minor_radius);
  }
};

struct SphereShape {
  static constexpr std::string_view name = "sphere";
  SphereOptions options;
  Mesh make() const { return sphere(options); }
  void visit(auto&& field) {
    field("subdivisions", options.subdivisions);
    field("radius", options.radius);
  }
};

struct CylinderShape {
  static constexpr std::string_view name = "cylinder";
  CylinderOptions options;
  Mesh make() const { return cylinder(options); }
  void visit(auto&& field) {
    field("segments", options.segments);
    field("rows", options.rows);
    field("radius", options.radius);
    field("height", options.height);
    field("caps", options.caps);
  }
};

struct BarShape {
  static constexpr std::string_view name = "bar";
  BarOptions options;
  Mesh make() const { return bar(options); }
  void visit(auto&& field) {
    field("cells", options.cells);
    field("size", options.size);
    field("cut", options.cut);
  }
};

struct ChainShape {
  static constexpr std::string_view name = "chain";
  ChainOptions options;
  Mesh make() const { return chain(options); }
  void visit(auto&& field) {
    field("links", options.links);
    field("length", options.length);
    field("direction", options.direction);
  }
};

using Shapes = std::tuple<GridShape, TorusShape, SphereShape, CylinderShape, BarShape, ChainShape>;

}  // namespace pliant
