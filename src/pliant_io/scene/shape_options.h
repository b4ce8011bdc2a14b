#pragma once
// The shapes that scene files know. A shape's name and options stand with it, in mesh/shapes/.
#include <tuple>

#include "pliant/mesh/shapes.h"

namespace pliant {

using Shapes = std::tuple<GridOptions, PanelOptions, NetOptions, PillowOptions, TorusOptions, SphereOptions,
                          CylinderOptions, CapsuleOptions, TubeOptions, BarOptions, ChainOptions>;

inline Mesh make_shape(const GridOptions& options) {
  return grid(options);
}
inline Mesh make_shape(const PanelOptions& options) {
  return panel(options);
}
inline Mesh make_shape(const NetOptions& options) {
  return net(options);
}
inline Mesh make_shape(const PillowOptions& options) {
  return pillow(options);
}
inline Mesh make_shape(const TorusOptions& options) {
  return torus(options);
}
inline Mesh make_shape(const SphereOptions& options) {
  return sphere(options);
}
inline Mesh make_shape(const CylinderOptions& options) {
  return cylinder(options);
}
inline Mesh make_shape(const CapsuleOptions& options) {
  return capsule(options);
}
inline Mesh make_shape(const TubeOptions& options) {
  return tube(options);
}
inline Mesh make_shape(const BarOptions& options) {
  return bar(options);
}
inline Mesh make_shape(const ChainOptions& options) {
  return chain(options);
}

}  // namespace pliant
