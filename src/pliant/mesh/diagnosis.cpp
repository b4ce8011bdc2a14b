#include "pliant/mesh/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "pliant/mesh/detail/element_uses.h"
#include "pliant/mesh/detail/sheets.h"
#include "pliant/mesh/topology.h"

namespace pliant {

namespace {

/// Distance of a corner from its polygon's plane, relative to the polygon's size, past which the polygon is bent.
constexpr Real bend_limit = 0.05;

class SpreadOf {
 public:
  void add(Real value) {
    spread_.min = count_ == 0 ? value : std::min(spread_.min, value);
    spread_.max = std::max(spread_.max, value);
    sum_ += value;
    ++count_;
  }
  Real sum() const { return sum_; }
  Spread result() const {
    Spread spread = spread_;
    if (count_ > 0) spread.mean = sum_ / static_cast<Real>(count_);
    return spread;
  }

 private:
  Spread spread_;
  Real sum_ = 0;
  std::int64_t count_ = 0;
};

class MeshChecker {
 public:
  explicit MeshChecker(Mesh mesh) : mesh_(std::move(mesh)) {}

  Diagnosis run() {
    count();
    find_far_vertices();
    find_lonely_vertices();
    find_duplicate_vertices();
    examine_polygons();
    mesh_.faces = {};  // what is left needs memory, but no polygons
    mesh_.groups.clear();
    examine_triangles();
    examine_tetrahedra();
    examine_edges();
    measure_volume();
    note(DefectKind::collapsed_facets, mesh_.collapsed_face_count);
    std::erase_if(defects_, [](const Defect& defect) { return defect.count == 0; });
    std::ranges::sort(defects_, {}, &Defect::kind);
    result_.defects = std::move(defects_);
    return std::move(result_);
  }

 private:
  // ---- defects

  Defect& defect_of(DefectKind kind) {
    const auto entry = std::ranges::find(defects_, kind, &Defect::kind);
    if (entry != defects_.end()) return *entry;
    defects_.push_back({kind, 0, {}});
    return defects_.back();
  }

  /// Keeps the lowest ones.
  void add(DefectKind kind, Index index, Index other = -1) {
    Defect& defect = defect_of(kind);
    ++defect.count;
    const std::array<Index, 2> place = {index, other};
    if (defect.first.size() == Defect::max_listed) {
      if (defect.first.back() <= place) return;
      defect.first.pop_back();
    }
    defect.first.insert(std::ranges::upper_bound(defect.first, place), place);
  }

  void note(DefectKind kind, std::int64_t count) { defect_of(kind).count += count; }
  bool has(DefectKind kind) { return defect_of(kind).count > 0; }

  // ---- vertices and polygons

  void count() {
    result_.vertex_count = mesh_.vertex_count();
    result_.edge_element_count = count_of(mesh_.edges);
    result_.triangle_count = count_of(mesh_.triangles);
    result_.tetrahedron_count = count_of(mesh_.tetrahedra);
    result_.polygon_count = mesh_.faces.face_count();
  }

  void find_far_vertices() {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const Vec3 x = row(mesh_.vertices, v);
      if (!(x.cwiseAbs().maxCoeff() <= coordinate_limit)) add(DefectKind::far_vertices, v);
    }
    result_.is_measured = !has(DefectKind::far_vertices);
    if (result_.is_measured) result_.box = bounding_box(mesh_.vertices);
  }

  void find_lonely_vertices() {
    std::vector<char> is_used(at(mesh_.vertex_count()), 0);
    Parts parts(at(mesh_.vertex_count()));
    const auto use = [&](const auto& elements) {
      for (const auto& element : elements) {
        for (const Index vertex : element) {
          is_used[at(vertex)] = 1;
          parts.join(vertex, element[0]);
        }
      }
    };
    use(mesh_.edges);
    use(mesh_.triangles);
    use(mesh_.tetrahedra);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (is_used[at(v)] == 0) {
        add(DefectKind::isolated_vertices, v);
      } else if (parts.is_first(v)) {
        ++result_.component_count;
      }
    }
  }

  void find_duplicate_vertices() {
    std::vector<Index> order(at(mesh_.vertex_count()));
    std::iota(order.begin(), order.end(), 0);
    const auto place = [&](Index v) {
      const Real* x = mesh_.vertices.data() + 3 * static_cast<std::ptrdiff_t>(v);
      return std::tuple(x[0], x[1], x[2]);
    };
    std::ranges::sort(order, [&](Index a, Index b) {
      const auto place_a = place(a);
      const auto place_b = place(b);
      return place_a != place_b ? place_a < place_b : a < b;
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (place(order[i]) == place(order[i - 1])) add(DefectKind::duplicate_vertices, order[i]);
    }
  }

  void examine_polygons() {
    const PolygonFaces& faces = mesh_.faces;
    for (Index f = 0; f < faces.face_count(); ++f) {
      const auto first = at(faces.offsets[at(f)]);
      const auto corners = std::span(faces.vertices).subspan(first, at(faces.offsets[at(f) + 1]) - first);
      result_.largest_polygon = std::max(result_.largest_polygon, count_of(corners));
      if (corners.size() > 3 && result_.is_measured && is_bent(corners)) add(DefectKind::bent_polygons, f);
    }
  }

  /// The plane goes through the middle of the corners, along Newell's normal.
  bool is_bent(std::span<const Index> corners) const {
    Vec3 middle = Vec3::Zero();
    for (const Index vertex : corners) middle += row(mesh_.vertices, vertex) / static_cast<Real>(corners.size());
    Vec3 normal = Vec3::Zero();
    Real size = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 from = row(mesh_.vertices, corners[i]) - middle;
      const Vec3 to = row(mesh_.vertices, corners[(i + 1) % corners.size()]) - middle;
      normal += from.cross(to);
      size = std::max(size, from.stableNorm());
    }
    normal.stableNormalize();
    return std::ranges::any_of(corners, [&](Index vertex) {
      return std::abs(normal.dot(row(mesh_.vertices, vertex) - middle)) > bend_limit * size;
    });
  }

  // ---- elements

  void examine_triangles() {
    visit_triangles(mesh_, [&](std::span<const TriangleUse> uses) {
      for (const TriangleUse& use : uses.subspan(1)) add(DefectKind::duplicate_triangles, use.triangle);
    });
    if (!result_.is_measured) return;
    SpreadOf areas;
    for (Index t = 0; t < count_of(mesh_.triangles); ++t) {
      const Triangle& triangle = mesh_.triangles[at(t)];
      areas.add(area_of(triangle));
      if (has_no_extent(mesh_.vertices, triangle)) add(DefectKind::zero_area_triangles, t);
    }
    result_.triangle_area = areas.result();
    result_.area = areas.sum();
    if (!mesh_.triangles.empty()) return;
    for (const Triangle& triangle : boundary_triangles(mesh_.tetrahedra)) result_.area += area_of(triangle);
  }

  Real area_of(const Triangle& triangle) const {
    const auto& [a, b, c] = triangle;
    return triangle_area(row(mesh_.vertices, a), row(mesh_.vertices, b), row(mesh_.vertices, c));
  }

  void examine_tetrahedra() {
    if (!result_.is_measured) return;
    const std::vector<Real> volumes = tetrahedron_volumes(mesh_.vertices, mesh_.tetrahedra);
    for (Index t = 0; t < count_of(volumes); ++t) {
      result_.volume += volumes[at(t)];
      if (has_no_extent(mesh_.vertices, mesh_.tetrahedra[at(t)])) {
        add(DefectKind::zero_volume_tetrahedra, t);
      } else if (volumes[at(t)] < 0) {
        add(DefectKind::inverted_tetrahedra, t);
      }
    }
  }

  // ---- edges

  void examine_edges() {
    SpreadOf lengths;
    std::vector<Edge> boundary;
    TurnedSheets sheets(mesh_.triangles.size());
    std::vector<char> ends_nonmanifold_edge(at(mesh_.vertex_count()), 0);
    visit_edges(mesh_, [&](std::span<const EdgeUse> uses) {
      const Edge edge = {uses[0].low, uses[0].high};
      ++result_.edge_count;
      if (result_.is_measured) {
        lengths.add((row(mesh_.vertices, edge[1]) - row(mesh_.vertices, edge[0])).stableNorm());
        if (has_no_extent(mesh_.vertices, edge)) add(DefectKind::zero_length_edges, edge[0], edge[1]);
      }
      const auto triangles = triangles_of(uses);
      if (triangles.size() == 1) boundary.push_back(edge);
      if (triangles.size() > 2) {
        add(DefectKind::nonmanifold_edges, edge[0], edge[1]);
        ends_nonmanifold_edge[at(edge[0])] = ends_nonmanifold_edge[at(edge[1])] = 1;
      }
      if (triangles.size() == 2) {
        sheets.join(triangles[0].triangle(), triangles[1].triangle(),
                    triangles[0].is_reversed() != triangles[1].is_reversed());
      }
    });
    result_.edge_length = lengths.result();
    result_.is_closed = !mesh_.triangles.empty() && boundary.empty() && !has(DefectKind::nonmanifold_edges);
    find_flipped_triangles(sheets);
    sheets = TurnedSheets(0);
    find_pinched_vertices(ends_nonmanifold_edge);
    trace_boundary(std::move(boundary));
  }

  /// Those of other elements come last.
  static std::span<const EdgeUse> triangles_of(std::span<const EdgeUse> uses) {
    const auto others = std::ranges::find_if(uses, [](const EdgeUse& use) { return !use.is_triangle(); });
    return uses.first(static_cast<std::size_t>(others - uses.begin()));
  }

  /// The fewer of each sheet; of two halves, those that are not turned like its first triangle.
  void find_flipped_triangles(TurnedSheets& sheets) {
    std::vector<Index> balance(mesh_.triangles.size(), 0);
    for (Index t = 0; t < count_of(mesh_.triangles); ++t) {
      const auto [lowest, is_turned] = sheets.find(t);
      balance[at(lowest)] += is_turned ? -1 : 1;
      if (lowest == t && sheets.is_unorientable(t)) add(DefectKind::unorientable_sheets, t);
    }
    for (Index t = 0; t < count_of(mesh_.triangles); ++t) {
      const auto [lowest, is_turned] = sheets.find(t);
      const bool is_flipped = is_turned == (balance[at(lowest)] >= 0);
      if (is_flipped && !sheets.is_unorientable(lowest)) add(DefectKind::flipped_triangles, t);
    }
  }

  /// A vertex whose triangles form more than one fan, or that ends a non-manifold edge.
  void find_pinched_vertices(const std::vector<char>& ends_nonmanifold_edge) {
    for (Index v = 0; v < count_of(ends_nonmanifold_edge); ++v) {
      if (ends_nonmanifold_edge[at(v)] != 0) add(DefectKind::nonmanifold_vertices, v);
    }
    const auto is_open_question = [&](Index v) { return ends_nonmanifold_edge[at(v)] == 0; };
    std::vector<std::pair<Index, Index>> ends;  // of sides: neighbor, side
    visit_vertices(mesh_, is_open_question, [&](std::span<const SideUse> uses) {
      if (count_fans(uses, ends) > 1) add(DefectKind::nonmanifold_vertices, uses[0].vertex);
    });
  }

  /// Triangles belong to a fan when their sides opposite the vertex share an end. `ends` is scratch.
  static Index count_fans(std::span<const SideUse> uses, std::vector<std::pair<Index, Index>>& ends) {
    ends.clear();
    for (Index s = 0; s < count_of(uses); ++s) {
      for (const Index end : uses[at(s)].side) ends.emplace_back(end, s);
    }
    std::ranges::sort(ends);
    Parts fans(uses.size());
    for (std::size_t e = 1; e < ends.size(); ++e) {
      if (ends[e].first == ends[e - 1].first) fans.join(ends[e].second, ends[e - 1].second);
    }
    Index count = 0;
    for (Index s = 0; s < count_of(uses); ++s) count += fans.is_first(s) ? 1 : 0;
    return count;
  }

  void trace_boundary(std::vector<Edge> edges) {
    for (const std::vector<Index>& vertices : boundary_loops(std::move(edges))) {
      BoundaryLoop loop{vertices[0], static_cast<Index>(vertices.size()), 0};
      for (std::size_t i = 0; result_.is_measured && i < vertices.size(); ++i) {
        const Index next = vertices[(i + 1) % vertices.size()];
        loop.length += (row(mesh_.vertices, next) - row(mesh_.vertices, vertices[i])).stableNorm();
      }
      result_.boundary_loops.push_back(loop);
    }
  }

  /// Signed, from the middle of the box, so that a mesh far from the origin loses no digits.
  void measure_volume() {
    const bool is_solid = result_.is_closed && !has(DefectKind::flipped_triangles) &&
                          !has(DefectKind::unorientable_sheets) && mesh_.tetrahedra.empty();
    if (!is_solid || !result_.is_measured) return;
    const Vec3 middle = (result_.box.min + result_.box.max) / 2;
    for (const auto& [a, b, c] : mesh_.triangles) {
      result_.volume +=
          tetrahedron_volume(middle, row(mesh_.vertices, a), row(mesh_.vertices, b), row(mesh_.vertices, c));
    }
  }

  Mesh mesh_;
  Diagnosis result_;
  std::vector<Defect> defects_;
};

}  // namespace

const Defect* Diagnosis::find(DefectKind kind) const {
  const auto entry = std::ranges::find(defects, kind, &Defect::kind);
  return entry == defects.end() ? nullptr : &*entry;
}

Diagnosis diagnose(Mesh mesh) {
  return MeshChecker(std::move(mesh)).run();
}

}  // namespace pliant
