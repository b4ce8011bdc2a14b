#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "render/hard_edges.h"
#include "render/loop_subdivision.h"

namespace test_loop_subdivision {

using namespace pliant_render;

namespace {

/// A coarse surface with what its spans refer to.
struct Surface {
  std::vector<Vec3f> points;
  std::vector<std::uint32_t> triangles, corners, copies, normals_from, edges;
  std::vector<float> rest_lengths;

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(points.size()); }
  CoarseSurface view() const {
    return {.vertex_count = vertex_count(),
            .triangles = triangles,
            .corners = corners,
            .copies = copies,
            .normals_from = normals_from,
            .edges = edges,
            .springs = edges,
            .rest_lengths = rest_lengths};
  }
  FineSurface fine(int levels) const { return subdivide(view(), levels); }
  std::vector<Vec3f> fine_points(int levels) const {
    std::vector<Vec3f> result;
    apply_stencils(fine(levels).points, points, result);
    return result;
  }
};

/// Corners are split at hard edges; springs and the wireframe have all edges.
Surface surface_of(const pliant::Positions& rest, const std::vector<pliant::Triangle>& triangles) {
  Surface surface;
  for (Eigen::Index i = 0; i < rest.rows(); ++i) surface.points.push_back(rest.row(i).transpose().cast<float>());
  pliant::Mesh mesh;
  mesh.vertices = rest;
  mesh.triangles = triangles;
  for (const pliant::Triangle& triangle : triangles) {
    for (const pliant::Index vertex : triangle) surface.triangles.push_back(static_cast<std::uint32_t>(vertex));
  }
  for (const pliant::Edge& edge : pliant::unique_edges(mesh)) {
    for (const pliant::Index vertex : edge) surface.edges.push_back(static_cast<std::uint32_t>(vertex));
    surface.rest_lengths.push_back(static_cast<float>((rest.row(edge[0]) - rest.row(edge[1])).norm()));
  }
  const ShadedCorners shaded = split_at_hard_edges(rest, triangles);
  surface.corners = shaded.numbers;
  surface.copies = shaded.copies;
  surface.normals_from = shaded.normals_from;
  return surface;
}

Surface surface_through(const std::vector<Vec3f>& points, const std::vector<pliant::Triangle>& triangles) {
  pliant::Positions rest(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    rest.row(static_cast<Eigen::Index>(i)) = points[i].cast<double>().transpose();
  }
  return surface_of(rest, triangles);
}

Surface smooth(Surface surface) {
  surface.corners = surface.triangles;
  surface.copies.clear();
  surface.normals_from.clear();
  return surface;
}

Surface sheet() {
  const pliant::Mesh mesh = pliant::grid({.columns = 6, .rows = 5, .size = {1.0, 0.7}, .plane = pliant::Plane::xy});
  return surface_of(mesh.vertices, mesh.triangles);
}

Surface crate(int cells = 2) {
  const pliant::Mesh mesh = pliant::bar({.cells = {cells, cells, cells}, .size = {1, 1, 1}});
  return surface_of(mesh.vertices, pliant::boundary_triangles(mesh.tetrahedra));
}

Surface octahedron() {
  return smooth(
      surface_through({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}));
}

/// A regular polygon around vertex 0.
Surface fan(int count) {
  std::vector<Vec3f> points{{0, 0, 0}};
  std::vector<pliant::Triangle> triangles;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F);
    triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return surface_through(points, triangles);
}

/// Two strips of two cells each along x, on the planes z = 0 and y = 0, which meet at the hard edge of vertices 0,
/// 1, 2.
Surface fold() {
  return surface_through(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}},
      {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {1, 0, 6}, {1, 6, 7}, {2, 1, 7}, {2, 7, 8}});
}

/// The weight of each source, and 0 of all others.
std::vector<double> weights_of(const Stencils& stencils, std::size_t row, std::size_t source_count) {
  std::vector<double> weights(source_count, 0);
  for (std::uint32_t k = stencils.offsets.at(row); k < stencils.offsets.at(row + 1); ++k) {
    weights.at(stencils.sources[k]) += static_cast<double>(stencils.weights[k]);
  }
  return weights;
}

bool is_fixed(const Surface& surface, std::size_t vertex) {
  return weights_of(surface.fine(1).points, vertex, surface.points.size()).at(vertex) == 1;
}

void check_rows(const Stencils& stencils, std::size_t row_count, std::size_t source_count) {
  REQUIRE(stencils.offsets.size() == row_count + 1);
  REQUIRE(stencils.offsets.back() == stencils.sources.size());
  REQUIRE(stencils.weights.size() == stencils.sources.size());
  for (std::size_t row = 0; row < row_count; ++row) {
    CHECK(stencils.offsets[row] < stencils.offsets[row + 1]);
    double sum = 0;
    for (const double weight : weights_of(stencils, row, source_count)) sum += weight;
    CHECK(sum == doctest::Approx(1).epsilon(1e-6));
  }
}

/// What holds of every surface, whatever is wrong with it.
void check_numbers(const Surface& surface, int levels) {
  const FineSurface fine = surface.fine(levels);
  CHECK(fine.triangles.size() == surface.triangles.size() << (2 * levels));
  REQUIRE(fine.corners.size() == fine.triangles.size());
  REQUIRE(fine.normals_from.size() == fine.copies.size());
  std::vector<int> is_taken(fine.vertex_count + fine.copies.size(), 0);
  for (std::size_t i = 0; i < fine.corners.size(); ++i) {
    const std::uint32_t number = fine.corners[i];
    is_taken.at(number) = 1;
    CHECK((number < fine.vertex_count ? number : fine.copies.at(number - fine.vertex_count)) == fine.triangles[i]);
  }
  for (std::uint32_t i = 0; i < fine.copies.size(); ++i) {
    const std::uint32_t from = fine.normals_from[i];
    CHECK(from <= fine.vertex_count + i);
    CHECK((from < fine.vertex_count ? from : fine.copies[from - fine.vertex_count]) == fine.copies[i]);
  }
  for (std::size_t i = surface.vertex_count(); i < is_taken.size(); ++i) {
    if (i < fine.vertex_count || i >= fine.vertex_count + surface.copies.size()) CHECK(is_taken[i] == 1);
  }
  check_rows(fine.points, fine.vertex_count, surface.points.size());
  check_rows(fine.places, is_taken.size(), surface.points.size() + surface.copies.size());
  for (const Vec3f& p : surface.fine_points(levels)) CHECK(p.allFinite());
  const FineSurface again = surface.fine(levels);
  CHECK(again.triangles == fine.triangles);
  CHECK(again.corners == fine.corners);
  CHECK(again.points.sources == fine.points.sources);
  CHECK(again.points.weights == fine.points.weights);
  CHECK(again.places.sources == fine.places.sources);
}

Eigen::AlignedBox3f box_of(const std::vector<Vec3f>& points) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& p : points) box.extend(p);
  return box;
}

float radius_ratio(const std::vector<Vec3f>& points) {
  const auto norm = [](const Vec3f& p) { return p.norm(); };
  return std::ranges::max(points, {}, norm).norm() / std::ranges::min(points, {}, norm).norm();
}

}  // namespace

TEST_CASE("each level has a vertex more for each edge, and four triangles for each") {
  for (const Surface& surface : {sheet(), crate(), octahedron(), fan(6), fold()}) {
    for (const int levels : {1, 2, 3}) check_numbers(surface, levels);
    CHECK(surface.fine(1).vertex_count == surface.points.size() + surface.edges.size() / 2);
    CHECK(surface.fine(0).triangles == surface.triangles);
    CHECK(surface.fine_points(0) == surface.points);
  }
  const FineSurface twice = octahedron().fine(2);
  CHECK(twice.vertex_count == 6 + 12 + 48);  // by Euler, for 32 triangles after the first level
  CHECK(twice.triangles.size() == 3 * 8 * 16);
}

TEST_CASE("a vertex with six neighbors, and the edges around it, have Loop's weights") {
  const FineSurface fine = fan(6).fine(1);
  constexpr double n = 1 / 16.0;
  CHECK(weights_of(fine.points, 0, 7) == std::vector<double>{10 * n, n, n, n, n, n, n});
  // The edge from 0 to 1 is the first, and has 2 and 6 across.
  CHECK(weights_of(fine.points, 7, 7) == std::vector<double>{0.375, 0.375, 0.125, 0, 0, 0, 0.125});
  // The edge from 1 to 2 is the first after the six spokes, and on the border.
  CHECK(weights_of(fine.points, 13, 7) == std::vector<double>{0, 0.5, 0.5, 0, 0, 0, 0});
}

TEST_CASE("vertices with other numbers of neighbors have Loop's weights, too") {
  for (const int count : {3, 4, 5, 7, 12, 200}) {
    const std::vector<double> weights = weights_of(fan(count).fine(1).points, 0, static_cast<std::size_t>(count) + 1);
    const double cosine = std::cos(2 * std::numbers::pi / count);
    const double kept = 3 / 8.0 + (3 / 8.0 + cosine / 4) * (3 / 8.0 + cosine / 4);
    CHECK(weights[0] == doctest::Approx(kept).epsilon(1e-6));
    for (int i = 1; i <= count; ++i) {
      CHECK(weights[static_cast<std::size_t>(i)] == doctest::Approx((1 - kept) / count).epsilon(1e-6));
    }
  }
  CHECK_FALSE(is_fixed(fan(256), 0));
  CHECK(is_fixed(fan(257), 0));  // its stencils would be a quarter of a million entries, and the next level's
}

TEST_CASE("a border is a cubic B-spline where it has no corner") {
  const FineSurface fine = fan(8).fine(1);  // angles of 135 degrees
  CHECK(weights_of(fine.points, 3, 9) == std::vector<double>{0, 0, 0.125, 0.75, 0.125, 0, 0, 0, 0});
  CHECK(is_fixed(fan(6), 3));  // of 120
  // One corner of 270 degrees and five of 90.
  const Surface angle = surface_through({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, -1, 0}},
                                        {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  for (std::size_t i = 0; i < 6; ++i) CHECK(is_fixed(angle, i));
}

TEST_CASE("what counts are angles at rest, and where a length is unknown there is no corner") {
  Surface surface = fan(6);
  for (Vec3f& p : surface.points) p = Vec3f(5 * p.x(), p.y(), 0);
  CHECK(is_fixed(surface, 1));
  CHECK(is_fixed(surface, 2));
  Surface spoilt = fan(6);
  spoilt.rest_lengths.clear();
  CHECK_FALSE(is_fixed(spoilt, 1));
  spoilt = fan(6);
  for (float& length : spoilt.rest_lengths) length = 0;
  check_numbers(spoilt, 2);
  CHECK_FALSE(is_fixed(spoilt, 1));
  for (float& length : spoilt.rest_lengths) length = std::numeric_limits<float>::quiet_NaN();
  check_numbers(spoilt, 2);
  spoilt = fan(6);
  spoilt.rest_lengths[0] = 1e6F;  // no triangle has such sides
  check_numbers(spoilt, 2);
}

TEST_CASE("a flat sheet stays in its plane, between its borders, with its corners") {
  const Surface surface = sheet();
  const Eigen::AlignedBox3f box = box_of(surface.points);
  for (const int levels : {1, 2, 3}) {
    const FineSurface fine = surface.fine(levels);
    const std::vector<Vec3f> points = surface.fine_points(levels);
    for (const Vec3f& p : points) CHECK(p.z() == 0);
    CHECK(box_of(points).isApprox(box, 1e-6F));
    int corner_count = 0;
    double area = 0;
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
      const Vec3f& p = surface.points[i];
      if ((p - box.min()).head<2>().cwiseProduct((p - box.max()).head<2>()) != Vec2f::Zero()) continue;
      CHECK(points[i] == p);
      ++corner_count;
    }
    CHECK(corner_count == 4);
    for (std::size_t t = 0; t < fine.triangles.size(); t += 3) {
      const Vec3f &a = points[fine.triangles[t]], &b = points[fine.triangles[t + 1]],
                  &c = points[fine.triangles[t + 2]];
      const float twice_area = (b - a).cross(c - a).z();
      CHECK(twice_area > 0);  // none is turned over
      area += static_cast<double>(twice_area) / 2;
    }
    CHECK(area == doctest::Approx(static_cast<double>(box.sizes().x() * box.sizes().y())).epsilon(1e-5));
  }
}

TEST_CASE("what is moved and turned as a whole is so when it is fine") {
  for (Surface surface : {sheet(), crate(), octahedron(), fold()}) {
    const std::vector<Vec3f> before = surface.fine_points(2);
    const Eigen::Matrix3f turn = Eigen::AngleAxisf(0.7F, Vec3f(1, 2, 3).normalized()).toRotationMatrix();
    const Vec3f shift(0.3F, -2, 1);
    for (Vec3f& p : surface.points) p = turn * p + shift;
    const std::vector<Vec3f> after = surface.fine_points(2);
    for (std::size_t i = 0; i < before.size(); ++i) CHECK((turn * before[i] + shift - after[i]).norm() < 3e-6F);
  }
}

TEST_CASE("a crate stays one: straight edges, flat faces, eight corners") {
  const Surface surface = crate();
  const Eigen::AlignedBox3f box = box_of(surface.points);
  // Of the three coordinates, how many are at an end: 1 on a face, 2 on an edge, 3 at a corner.
  const auto ends = [&](const Vec3f& p) {
    return ((p - box.min()).array().abs() < 1e-6F || (p - box.max()).array().abs() < 1e-6F).count();
  };
  const FineSurface fine = surface.fine(2);
  const std::vector<Vec3f> points = surface.fine_points(2);
  Eigen::Index counts[4] = {};
  for (std::size_t i = 0; i < points.size(); ++i) {
    ++counts[ends(points[i])];
    const Eigen::Index before = i < surface.points.size() ? ends(surface.points[i]) : 1;
    if (before == 0 || before == 3) CHECK(points[i] == surface.points[i]);
  }
  CHECK(counts[0] == 1);       // in no triangle
  CHECK(counts[1] == 6 * 49);  // 9 by 9 vertices on a face
  CHECK(counts[2] == 12 * 7);
  CHECK(counts[3] == 8);
  CHECK(fine.copies.size() == 8 * 2 + 12 * 7);
  for (std::uint32_t i = 0; i < fine.copies.size(); ++i) CHECK(fine.normals_from[i] == fine.vertex_count + i);
  // The corners that share a number lie on one face.
  std::vector<Vec3f> normals(fine.vertex_count + fine.copies.size(), Vec3f::Zero());
  for (std::size_t t = 0; t < fine.triangles.size(); t += 3) {
    const Vec3f &a = points[fine.triangles[t]], &b = points[fine.triangles[t + 1]], &c = points[fine.triangles[t + 2]];
    const Vec3f normal = (b - a).cross(c - a).normalized();
    for (std::size_t k = t; k < t + 3; ++k) {
      Vec3f& known = normals[fine.corners[k]];
      if (known.norm() > 0) CHECK((known - normal).norm() < 1e-4F);
      known = normal;
    }
  }
}

TEST_CASE("without hard edges, a crate and an octahedron become rounder and smaller") {
  Surface box = smooth(crate());
  const Vec3f center = std::accumulate(box.points.begin(), box.points.end(), Vec3f::Zero().eval()) / 27;
  for (Vec3f& p : box.points) p -= center;
  std::erase_if(box.points, [](const Vec3f& p) { return p.norm() < 1e-3F; });  // the last but 13
  REQUIRE(box.points.size() == 26);
  for (std::uint32_t& vertex : box.triangles) vertex -= vertex > 13 ? 1 : 0;
  box.corners = box.triangles;
  const Surface ball = octahedron();
  for (const Surface& surface : {box, ball}) {
    for (const int levels : {2, 3, 4}) {
      std::vector<Vec3f> flat;  // as many vertices, on the coarse triangles
      apply_stencils(surface.fine(levels).places, surface.points, flat);
      const std::vector<Vec3f> points = surface.fine_points(levels);
      CHECK(radius_ratio(points) < 0.8F * radius_ratio(flat));
      for (std::size_t i = 0; i < points.size(); ++i) CHECK(points[i].norm() < flat[i].norm() + 1e-6F);
    }
  }
  // Four neighbors whose mean is m: v becomes 33 / 64 v + 31 / 64 m, and m becomes 3 / 8 v + 5 / 8 m.
  double v = 1, m = 0;
  for (const int levels : {1, 2, 3, 4}) {
    const double v_before = v;
    v = (33 * v + 31 * m) / 64;
    m = (3 * v_before + 5 * m) / 8;
    CHECK(static_cast<double>(ball.fine_points(levels)[0].x()) == doctest::Approx(v).epsilon(1e-6));
  }
}

TEST_CASE("a hard edge is a crease up to the border, and where it ends within a surface the end is smoothed") {
  const Surface surface = fold();
  REQUIRE(surface.copies.size() == 3);
  CHECK(weights_of(surface.fine(1).points, 1, 9) == std::vector<double>{0.125, 0.75, 0.125, 0, 0, 0, 0, 0, 0});
  CHECK(is_fixed(surface, 0));  // two borders and the hard edge
  for (const Vec3f& p : surface.fine_points(3)) CHECK(std::min(p.y(), p.z()) == 0);

  // A fan whose edges from 0 to 1 and from 0 to 3 are hard: a crease through its middle.
  Surface through = smooth(fan(8));
  through.copies = {0, 1, 3};
  through.normals_from = {9, 10, 11};
  for (const std::size_t t : {0U, 1U}) through.corners[3 * t] = 9;
  through.corners[3 * 0 + 1] = 10;
  through.corners[3 * 1 + 2] = 11;
  check_numbers(through, 3);
  CHECK(weights_of(through.fine(1).points, 0, 9) == std::vector<double>{0.75, 0.125, 0, 0.125, 0, 0, 0, 0, 0});

  // One whose edge from 0 to 1 alone is hard: different normals at 1, and the same at 0.
  Surface dart = smooth(fan(8));
  dart.copies = {1};
  dart.normals_from = {9};
  dart.corners[1] = 9;
  check_numbers(dart, 3);
  const FineSurface fine = dart.fine(1);
  CHECK(weights_of(fine.points, 0, 9) == weights_of(smooth(fan(8)).fine(1).points, 0, 9));
  CHECK(weights_of(fine.points, 9, 9) == std::vector<double>{0.5, 0.5, 0, 0, 0, 0, 0, 0, 0});
  CHECK(fine.copies == std::vector<std::uint32_t>{1, 9});  // and the normals differ at the middle
  CHECK(fine.normals_from == std::vector<std::uint32_t>{25, 26});
  CHECK(is_fixed(dart, 1));
  CHECK(dart.fine(2).copies.size() == 4);  // at 1 and three new vertices, but not at 0
}

TEST_CASE("a seam of a texture is no crease, and what is linear stays so on both sides") {
  Surface surface = sheet();
  // The third of six columns of vertices has copies for the triangles to the right.
  float seam = std::numeric_limits<float>::infinity();
  for (const Vec3f& p : surface.points) seam = std::min(seam, p.x() + 0.4F);
  std::vector<Vec2f> places;
  for (const Vec3f& p : surface.points) places.emplace_back(p.x(), 2 * p.y());
  std::vector<std::uint32_t> copy_of(surface.points.size(), 0);
  for (std::size_t k = 0; k < surface.triangles.size(); ++k) {
    float center = 0;
    for (std::size_t i = k / 3 * 3; i < k / 3 * 3 + 3; ++i) center += surface.points[surface.triangles[i]].x() / 3;
    const std::uint32_t vertex = surface.triangles[k];
    if (std::abs(surface.points[vertex].x() - seam) > 1e-3F || center < seam) continue;
    if (copy_of[vertex] == 0) {
      copy_of[vertex] = static_cast<std::uint32_t>(surface.points.size() + surface.copies.size());
      surface.copies.push_back(vertex);
      surface.normals_from.push_back(vertex);
      places.emplace_back(10 - surface.points[vertex].x(), 3.0F);
    }
    surface.corners[k] = copy_of[vertex];
  }
  REQUIRE(surface.copies.size() == 5);
  check_numbers(surface, 2);
  const FineSurface fine = surface.fine(1), without = sheet().fine(1);
  CHECK(fine.points.sources == without.points.sources);
  CHECK(fine.points.weights == without.points.weights);
  CHECK(fine.copies.size() == 9);
  for (std::size_t i = 0; i < fine.copies.size(); ++i) CHECK(fine.normals_from[i] == fine.copies[i]);

  // On each of a triangle's four parts, what is at a corner is half of what its ends have.
  std::vector<Vec2f> fine_places;
  apply_stencils(fine.places, places, fine_places);
  REQUIRE(fine_places.size() == fine.vertex_count + fine.copies.size());
  for (std::size_t t = 0; t < surface.triangles.size() / 3; ++t) {
    Vec2f corner[3];
    for (std::size_t k = 0; k < 3; ++k) corner[k] = places[surface.corners[3 * t + k]];
    const Vec2f ab = (corner[0] + corner[1]) / 2, bc = (corner[1] + corner[2]) / 2, ca = (corner[2] + corner[0]) / 2;
    const Vec2f expected[12] = {corner[0], ab, ca, ab, corner[1], bc, ca, bc, corner[2], ab, bc, ca};
    for (std::size_t k = 0; k < 12; ++k) CHECK((fine_places[fine.corners[12 * t + k]] - expected[k]).norm() < 1e-6F);
  }
  std::vector<float> numbers(places.size(), 3.0F), fine_numbers;
  apply_stencils(surface.fine(3).places, numbers, fine_numbers);
  for (const float number : fine_numbers) CHECK(number == 3);
}

TEST_CASE("the wireframe shows the coarse edges, in pieces") {
  Surface surface = sheet();
  surface.edges.insert(surface.edges.end(), {0, 29});  // of no triangle
  surface.rest_lengths.push_back(1);
  const std::size_t count = surface.edges.size() / 2 - 1;
  for (const int levels : {1, 2, 3}) {
    const FineSurface fine = surface.fine(levels);
    const std::size_t pieces = std::size_t{1} << levels;
    REQUIRE(fine.edges.size() == 2 * (count * pieces + 1));
    for (std::size_t e = 0; e < count; ++e) {
      const std::uint32_t* piece = &fine.edges[2 * e * pieces];
      CHECK(piece[0] == surface.edges[2 * e]);
      CHECK(piece[2 * pieces - 1] == surface.edges[2 * e + 1]);
      for (std::size_t k = 1; k < pieces; ++k) CHECK(piece[2 * k - 1] == piece[2 * k]);
    }
    CHECK(fine.edges[fine.edges.size() - 2] == 0);
    CHECK(fine.edges.back() == 29);
  }
}

TEST_CASE("surfaces with defects come out finite") {
  const std::vector<Vec3f> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {2, 0, 0}, {2, 2, 2}};
  using Triangles = std::vector<pliant::Triangle>;
  const std::vector<Triangles> cases = {
      {},
      {{0, 0, 0}},
      {{0, 0, 1}, {0, 1, 2}},
      {{0, 1, 2}, {0, 1, 2}},
      {{0, 1, 2}, {0, 2, 1}},
      {{0, 1, 2}, {1, 2, 0}, {2, 1, 0}, {0, 1, 2}},
      {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}},                        // an edge of three triangles
      {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 2, 3}, {3, 2, 0}},  // and a closed surface on two of them
      {{0, 1, 2}, {0, 3, 4}},                                   // which meet at a vertex
      {{0, 1, 2}, {0, 1, 3}},                                   // of opposite orientations
      {{0, 1, 5}, {0, 5, 2}},                                   // one without area
  };
  for (const Triangles& triangles : cases) {
    for (const int levels : {1, 2, 3}) {
      check_numbers(surface_through(points, triangles), levels);
      check_numbers(smooth(surface_through(points, triangles)), levels);
    }
    CHECK(is_fixed(surface_through(points, triangles), 6));  // in no triangle
  }
  CHECK(is_fixed(surface_through(points, cases[8]), 0));
  CHECK(is_fixed(smooth(surface_through(points, cases[7])), 0) == false);
  CHECK(surface_through(points, cases[2]).fine(1).vertex_count == 7 + 3);

  // Many triangles at one edge, no two of which share a normal.
  Triangles pages(20000, {0, 1, 2});
  for (std::size_t i = 1; i < pages.size(); i += 2) pages[i] = {0, 2, 1};
  const FineSurface book = surface_through(points, pages).fine(2);
  CHECK(book.triangles.size() == 3 * 16 * pages.size());
}

TEST_CASE("vertices where parts of a surface meet stay where they are") {
  // Two closed octahedra that have vertex 4 in common.
  Surface two = octahedron();
  const std::vector<std::uint32_t> one = two.triangles;
  for (const std::uint32_t vertex : one) two.triangles.push_back(vertex == 4 ? 4 : vertex + 6);
  for (std::size_t i = 0; i < 6; ++i) two.points.push_back(Vec3f(0, 0, 2) - two.points[i]);
  two = smooth(two);
  check_numbers(two, 2);
  CHECK(is_fixed(two, 4));
  CHECK_FALSE(is_fixed(two, 5));
  CHECK_FALSE(is_fixed(octahedron(), 4));
}

}  // namespace test_loop_subdivision
