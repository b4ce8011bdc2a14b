#include "pliant/mesh/closed_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/detail/element_uses.h"
#include "pliant/mesh/detail/sheets.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/loose.h"
#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

/// A volume below this share of area times size is none.
constexpr Real least_thickness = 1e-9;

void require_triangles_alone(const Mesh& mesh, std::string_view name) {
  if (!mesh.tetrahedra.empty()) {
    fail_input(fmt::format("{}: the mesh has tetrahedra already; leave out 'solid', or give its surface alone", name));
  }
  if (mesh.triangles.empty()) {
    fail_input(fmt::format("{}: the mesh has no triangles; a solid is made of a closed surface", name));
  }
  if (!mesh.edges.empty()) {
    fail_input(
        fmt::format("{}: the mesh has {} edge elements, such as ({}, {}), beside its triangles; make a body of "
                    "its own of them",
                    name, mesh.edges.size(), mesh.edges[0][0], mesh.edges[0][1]));
  }
  if (const std::vector<Index> loose = loose_vertices(mesh); !loose.empty()) {
    fail_input(
        fmt::format("{}: vertex {} is in no triangle, of {} such; leave them out: \"drop_loose\": true with the "
                    "file",
                    name, loose.front(), loose.size()));
  }
}

[[noreturn]] void fail_open(const Mesh& mesh, std::vector<Edge> boundary, std::string_view name) {
  const std::vector<std::vector<Index>> loops = boundary_loops(std::move(boundary));
  const std::vector<Index>& loop = loops.front();
  Real length = 0;
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 here = row(mesh.vertices, loop[i]);
    length += (row(mesh.vertices, loop[(i + 1) % loop.size()]) - here).norm();
    middle += here / static_cast<Real>(loop.size());
  }
  constexpr std::size_t shown = 5;
  const std::span first(loop.data(), std::min(loop.size(), shown));
  const std::string others = loops.size() == 1 ? "" : fmt::format(", and {} more such", loops.size() - 1);
  fail_input(
      fmt::format("{}: the surface is open: a loop of {} edges, {:.3g} m long, about ({:.3g}, {:.3g}, {:.3g}), with "
                  "the vertices {}{}"
                  "{}; close it, or merge vertices that lie on each other",
                  name, loop.size(), length, middle[0], middle[1], middle[2], fmt::join(first, ", "),
                  loop.size() > shown ? ", ..." : "", others));
}

/// Joins triangles across edges, each of which must have two.
TurnedSheets sheets_of(const Mesh& mesh, std::string_view name) {
  TurnedSheets sheets(mesh.triangles.size());
  std::vector<Edge> boundary;
  visit_edges(mesh, [&](std::span<const EdgeUse> uses) {
    const Edge edge = {uses[0].low, uses[0].high};
    if (uses.size() == 1) boundary.push_back(edge);
    if (uses.size() > 2) {
      fail_input(
          fmt::format("{}: the edge between vertices {} and {} has {} triangles, and the surface of a solid has "
                      "two at each; take inner walls out, or give parts that touch vertices of their own",
                      name, edge[0], edge[1], uses.size()));
    }
    if (uses.size() == 2) {
      sheets.join(uses[0].triangle(), uses[1].triangle(), uses[0].is_reversed() != uses[1].is_reversed());
    }
  });
  if (!boundary.empty()) fail_open(mesh, std::move(boundary), name);
  return sheets;
}

void turn(Triangle& triangle) {
  std::swap(triangle[1], triangle[2]);
}

/// Numbers the parts and turns the triangles of each alike.
void take_parts(const Mesh& mesh, std::string_view name, ClosedSurface& made) {
  TurnedSheets sheets = sheets_of(mesh, name);
  std::vector<Index> number_of(mesh.triangles.size(), -1);
  made.triangles = mesh.triangles;
  for (Index t = 0; t < count_of(mesh.triangles); ++t) {
    const auto [lowest, is_turned] = sheets.find(t);
    if (sheets.is_unorientable(lowest)) {
      fail_input(
          fmt::format("{}: the part of triangle {} has one side only, as a Klein bottle, and so no inside; make "
                      "it of another surface",
                      name, lowest));
    }
    if (number_of[at(lowest)] < 0) number_of[at(lowest)] = made.part_count++;
    made.part.push_back(number_of[at(lowest)]);
    if (is_turned) turn(made.triangles[at(t)]);
  }
}

/// Signed volumes of the parts, by tetrahedra to a place near them.
std::vector<Real> volumes_of_parts(const Mesh& mesh, const ClosedSurface& made) {
  const Vec3 origin = row(mesh.vertices, 0);
  std::vector<Real> volumes(at(made.part_count), 0);
  for (std::size_t t = 0; t < made.triangles.size(); ++t) {
    const auto& [a, b, c] = made.triangles[t];
    volumes[at(made.part[t])] +=
        tetrahedron_volume(origin, row(mesh.vertices, a), row(mesh.vertices, b), row(mesh.vertices, c));
  }
  return volumes;
}

/// Turns all parts outward but for the walls of cavities.
void turn_outward(const Mesh& mesh, ClosedSurface& made) {
  std::vector<Real> volumes = volumes_of_parts(mesh, made);
  Real sum = 0;
  for (const Real volume : volumes) sum += volume;
  std::vector<char> is_inward(volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i) is_inward[i] = (volumes[i] < 0) != (sum < 0) ? 1 : 0;
  for (std::size_t t = 0; t < made.triangles.size(); ++t) {
    if (volumes[at(made.part[t])] < 0) turn(made.triangles[t]);
  }
  std::vector<char> is_cavity(volumes.size(), 0);
  for (Index part = 0; part < made.part_count; ++part) {
    if (is_inward[at(part)] == 0) continue;
    std::vector<Triangle> others;
    Index vertex = 0;
    for (std::size_t t = 0; t < made.triangles.size(); ++t) {
      if (made.part[t] == part) vertex = made.triangles[t][0];
      if (made.part[t] != part && is_inward[at(made.part[t])] == 0) others.push_back(made.triangles[t]);
    }
    if (solid_angle(mesh.vertices, others, row(mesh.vertices, vertex)) < 2 * std::numbers::pi) continue;
    is_cavity[at(part)] = 1;
    ++made.cavity_count;
  }
  for (std::size_t t = 0; t < made.triangles.size(); ++t) {
    if (is_cavity[at(made.part[t])] != 0) turn(made.triangles[t]);
  }
  for (std::size_t i = 0; i < volumes.size(); ++i) made.volume += std::abs(volumes[i]) * (is_cavity[i] != 0 ? -1 : 1);
}

}  // namespace

Real solid_angle(const Positions& x, std::span<const Triangle> triangles, const Vec3& place) {
  Real sum = 0;
  for (const Triangle& triangle : triangles) {
    const Vec3 a = row(x, triangle[0]) - place, b = row(x, triangle[1]) - place, c = row(x, triangle[2]) - place;
    const Real la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum;
}

ClosedSurface closed_surface(const Mesh& mesh, std::string_view name) {
  require_triangles_alone(mesh, name);
  ClosedSurface made;
  take_parts(mesh, name, made);
  turn_outward(mesh, made);
  for (const Real area : triangle_areas(mesh.vertices, made.triangles)) made.area += area;
  for (std::size_t t = 0; t < made.triangles.size(); ++t) {
    if (made.triangles[t] != mesh.triangles[t]) ++made.turned_count;
  }
  if (!(made.volume > least_thickness * made.area * bounding_box(mesh.vertices).diagonal())) {
    fail_input(fmt::format("{}: the surface encloses no volume ({:.3g} m³ within {:.3g} m²); give one with an inside",
                           name, made.volume, made.area));
  }
  return made;
}

}  // namespace pliant
