#pragma once
// Small meshes that no shape function makes, and what an error says.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "pliant/core/error.h"
#include "pliant/mesh/mesh.h"

namespace pliant_tests {

inline pliant::Mesh mesh_of(const std::vector<std::array<pliant::Real, 3>>& vertices,
                            std::vector<pliant::Triangle> triangles = {}) {
  pliant::Mesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    mesh.vertices.row(static_cast<Eigen::Index>(v)) << vertices[v][0], vertices[v][1], vertices[v][2];
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

/// A strip of three rows of vertices around a circle, closed with half a turn: vertex 3a + b, rows 0 and 2 together
/// form its one border.
inline pliant::Mesh moebius_strip(pliant::Index segments) {
  pliant::Mesh mesh;
  mesh.vertices.resize(3 * segments, 3);
  const auto vertex = [&](pliant::Index a, pliant::Index b) { return a < segments ? 3 * a + b : 2 - b; };
  for (pliant::Index a = 0; a < segments; ++a) {
    const pliant::Real angle = 2 * std::numbers::pi * a / segments;
    for (pliant::Index b = 0; b < 3; ++b) {
      const pliant::Real across = 0.2 * (b - 1);
      const pliant::Real radius = 1 + across * std::cos(angle / 2);
      mesh.vertices.row(3 * a + b) << radius * std::cos(angle), radius * std::sin(angle), across * std::sin(angle / 2);
    }
    for (pliant::Index b = 0; b < 2; ++b) {
      mesh.triangles.push_back({vertex(a, b), vertex(a + 1, b), vertex(a + 1, b + 1)});
      mesh.triangles.push_back({vertex(a, b), vertex(a + 1, b + 1), vertex(a, b + 1)});
    }
  }
  return mesh;
}

/// Three pages, each of two triangles a side, about the spine 0 1 2; page p has vertices 3 + 3p, 4 + 3p, 5 + 3p.
inline pliant::Mesh book_of_three_pages() {
  pliant::Mesh mesh = mesh_of({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}});
  mesh.vertices.conservativeResize(12, 3);
  for (pliant::Index page = 0; page < 3; ++page) {
    const pliant::Real angle = 0.5 * page;
    const pliant::Index first = 3 + 3 * page;
    for (pliant::Index i = 0; i < 3; ++i) mesh.vertices.row(first + i) << std::cos(angle), std::sin(angle), i;
    for (pliant::Index i = 0; i < 2; ++i) {
      mesh.triangles.push_back({i, first + i, first + i + 1});
      mesh.triangles.push_back({i, first + i + 1, i + 1});
    }
  }
  return mesh;
}

/// Both meshes in one, the second one's indices shifted.
inline pliant::Mesh joined(pliant::Mesh first, const pliant::Mesh& second) {
  const pliant::Index shift = first.vertex_count();
  first.vertices.conservativeResize(shift + second.vertex_count(), 3);
  first.vertices.bottomRows(second.vertex_count()) = second.vertices;
  for (const auto& [a, b, c] : second.triangles) first.triangles.push_back({a + shift, b + shift, c + shift});
  for (const auto& [a, b] : second.edges) first.edges.push_back({a + shift, b + shift});
  return first;
}

/// The message of the Error that `act` throws, checked to be of the kind and one line; empty when it throws none.
inline std::string error_of(const std::function<void()>& act, pliant::ErrorKind kind = pliant::ErrorKind::input) {
  try {
    act();
  } catch (const pliant::Error& error) {
    const std::string message = error.what();
    if (error.kind() != kind) return "of another kind: " + message;
    return message.find('\n') == std::string::npos ? message : "of several lines: " + message;
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Vertices and triangles in an order of no sense.
inline void number_at_random(pliant::Mesh& mesh) {
  std::mt19937 random(5);
  std::vector<pliant::Index> numbers(pliant::at(mesh.vertex_count()));
  std::iota(numbers.begin(), numbers.end(), 0);
  std::shuffle(numbers.begin(), numbers.end(), random);
  const pliant::Positions before = mesh.vertices;
  for (pliant::Index v = 0; v < mesh.vertex_count(); ++v) mesh.vertices.row(numbers[pliant::at(v)]) = before.row(v);
  for (pliant::Triangle& triangle : mesh.triangles) {
    for (pliant::Index& v : triangle) v = numbers[pliant::at(v)];
  }
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
}

}  // namespace pliant_tests
