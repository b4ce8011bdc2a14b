#include "pliant/constraints/attachment.h"

#include <numeric>

#include <fmt/format.h>

#include "pliant/constraints/build.h"
#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/nearest_face.h"
#include "pliant/mesh/nearest_vertex.h"
#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

/// A tie shorter than this share of the largest coordinate is as long as rounding made it.
constexpr Real rounding_share = 1e-12;

/// A vertex of the first body and a point of the second, in their own indices.
struct Tie {
  Index vertex;
  std::vector<Index> corners;
  std::vector<Real> weights;
  Real measure = 1;
  bool is_swapped = false;  ///< the vertex is of the second body, the point of the first
};

class AttachmentBuilder {
 public:
  AttachmentBuilder(const BodyView& from, const BodyView& to, const Attachment& options)
      : from_(from),
        to_(to),
        options_(options),
        on_(selected(from, options.on, "from")),
        to_on_(selected(to, options.to_on, "to")),
        rounding_(rounding_share * std::max(from.start.cwiseAbs().maxCoeff(), to.start.cwiseAbs().maxCoeff())) {}

  ConstraintSet build() {
    const std::vector<Tie> ties = find_ties();
    if (ties.empty()) fail("ties nothing, since both sides are the same vertices; select others");
    const Values& given = options_.stiffness;
    if (given.of_vertices()) fail("stiffness has a value for each vertex; give one for all ties, or one each");
    check_length(Attachment::info.name, "stiffness", given, count_of(ties));
    const Real usual = is_seam(options_.mode) ? Attachment::usual_seam_stiffness : Attachment::usual_stiffness;
    ConstraintSet set;
    set.count = count_of(ties);
    Batch<AttachmentProjection>* batch = nullptr;
    for (Index i = 0; i < count_of(ties); ++i) {
      const Tie& tie = ties[at(i)];
      const auto size = static_cast<int>(tie.corners.size()) + 1;
      if (batch == nullptr || batch->shape().vertices != size) {  // a batch for each run of one size keeps the order
        const Real common = given.empty() ? usual : given.each() ? 1 : given[0];
        set.batches.push_back(std::make_unique<Batch<AttachmentProjection>>(common, size));
        batch = static_cast<Batch<AttachmentProjection>*>(set.batches.back().get());
      }
      add(tie, given.each() ? given[i] * tie.measure : tie.measure, *batch);
    }
    return set;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    fail_input(fmt::format("attachment of body '{}' to body '{}': {}", from_.name, to_.name, what));
  }
  bool is_one_body() const { return from_.first_vertex == to_.first_vertex; }

  std::vector<Index> selected(const BodyView& body, const Selection& selection, std::string_view side) const {
    std::vector<Index> vertices = selection.vertices;
    const Index count = body.rest.vertex_count();
    if (selection.everything) {
      vertices.resize(at(count));
      std::iota(vertices.begin(), vertices.end(), Index{0});
    }
    if (vertices.empty()) fail(fmt::format("'{}' selects no vertex; select some", side));
    std::vector<char> is_there(at(count), 0);
    for (const Index v : vertices) {
      if (v < 0 || v >= count) {
        fail(fmt::format("'{}' selects vertex {}, which is out of range; body '{}' has vertices 0 to {}", side, v,
                         body.name, count - 1));
      }
      if (is_there[at(v)] != 0) fail(fmt::format("'{}' names vertex {} twice; leave one out", side, v));
      is_there[at(v)] = 1;
    }
    return vertices;
  }

  std::vector<Tie> find_ties() const {
    switch (options_.mode) {
      case AttachmentMode::nearest_vertex:
        return to_vertices();
      case AttachmentMode::nearest_face:
        return to_faces();
      default:
        return along_seam();
    }
  }

  std::vector<Tie> to_vertices() const {
    Positions places(static_cast<Eigen::Index>(to_on_.size()), 3);
    for (std::size_t i = 0; i < to_on_.size(); ++i) {
      places.row(static_cast<Eigen::Index>(i)) = to_.rest.vertices.row(to_on_[i]);
    }
    const NearestVertex nearest(places);
    std::vector<Tie> ties;
    for (const Index v : on_) {
      const Index found = to_on_[at(nearest(row(from_.rest.vertices, v)))];
      if (is_one_body() && found == v) {
        fail(fmt::format("vertex {} would be tied to itself; leave it out of 'from' or of 'to'", v));
      }
      ties.push_back({v, {found}, {1}});
    }
    return ties;
  }

  std::vector<Tie> to_faces() const {
    std::vector<char> is_selected(at(to_.rest.vertex_count()), 0);
    for (const Index v : to_on_) is_selected[at(v)] = 1;
    std::vector<Triangle> triangles;
    const bool is_solid = to_.rest.triangles.empty();
    for (const Triangle& each : is_solid ? boundary_triangles(to_.rest.tetrahedra) : to_.rest.triangles) {
      if (std::ranges::all_of(each, [&](Index v) { return is_selected[at(v)] != 0; })) triangles.push_back(each);
    }
    if (triangles.empty()) {
      fail(fmt::format("body '{}' has no triangle {}; select more of it, or use mode 'nearest_vertex'", to_.name,
                       options_.to_on.everything ? "at all" : "whose corners are all selected by 'to'"));
    }
    const NearestFace nearest(to_.rest.vertices, triangles);
    std::vector<Tie> ties;
    for (const Index v : on_) {
      const FacePoint point = nearest(row(from_.rest.vertices, v));
      const Triangle& triangle = triangles[at(point.triangle)];
      if (is_one_body() && std::ranges::find(triangle, v) != triangle.end()) {
        fail(
            fmt::format("vertex {} would be tied to a face of its own, ({}, {}, {}); leave it out of 'from' or of 'to'",
                        v, triangle[0], triangle[1], triangle[2]));
      }
      Tie tie{v, {}, {}};
      for (std::size_t i = 0; i < 3; ++i) {
        if (point.weights[i] == 0) continue;
        tie.corners.push_back(triangle[i]);
        tie.weights.push_back(point.weights[i]);
      }
      ties.push_back(std::move(tie));
    }
    return ties;
  }

  Chain chain(const BodyView& body, const std::vector<Index>& vertices, std::string_view side) const {
    std::optional<Chain> chain = chain_of(body.rest, vertices);
    if (!chain) {
      fail(fmt::format(
          "the {} vertices that '{}' selects make no single chain or loop of edges of body '{}'; select one "
          "row of at least two, or use mode 'nearest_vertex'",
          vertices.size(), side, body.name));
    }
    if (!(lengths_along(*chain, body.rest.vertices).back() > 0)) {
      fail(fmt::format("the chain that '{}' selects has length 0 at rest; select another", side));
    }
    return *std::move(chain);
  }

  /// By length, each vertex of the finer side is tied to the coarser one, so that none is left loose.
  std::vector<Tie> along_seam() const {
    const Chain from = chain(from_, on_, "from"), to = chain(to_, to_on_, "to");
    const auto shape = [](const Chain& each) {
      return fmt::format("a {} of {} vertices", each.is_closed ? "loop" : "chain", each.vertices.size());
    };
    if (from.is_closed != to.is_closed) {
      fail(fmt::format("'from' selects {}, 'to' {}; select two loops or two open chains", shape(from), shape(to)));
    }
    const Positions &x_from = from_.rest.vertices, &x_to = to_.rest.vertices;
    if (options_.mode == AttachmentMode::seam) {
      if (from.vertices.size() != to.vertices.size()) {
        fail(fmt::format("'from' selects {}, 'to' {}; select as many, or use mode 'seam_by_length'", shape(from),
                         shape(to)));
      }
      return ties_of(stitch_in_order(from, x_from, to, x_to, options_.direction), false);
    }
    const bool is_swapped = to.vertices.size() > from.vertices.size();
    return ties_of(is_swapped ? stitch_by_length(to, x_to, from, x_from, options_.direction)
                              : stitch_by_length(from, x_from, to, x_to, options_.direction),
                   is_swapped);
  }

  /// Leaves out a vertex that both sides have, as at the tip of a dart.
  std::vector<Tie> ties_of(const std::vector<Stitch>& stitches, bool is_swapped) const {
    std::vector<Tie> ties;
    for (const Stitch& each : stitches) {
      if (is_one_body() && (each.vertex == each.a || each.vertex == each.b)) continue;
      Tie tie{each.vertex, {each.a}, {1}, each.length, is_swapped};
      if (each.share > 0) {
        tie.corners.push_back(each.b);
        tie.weights = {1 - each.share, each.share};
      }
      if (!(tie.measure > 0)) {
        fail(fmt::format("the edges at vertex {} of the seam have length 0 at rest; join their ends, or leave it out",
                         each.vertex));
      }
      ties.push_back(std::move(tie));
    }
    return ties;
  }

  void add(const Tie& tie, Real measure, Batch<AttachmentProjection>& batch) const {
    const BodyView& one = tie.is_swapped ? to_ : from_;
    const BodyView& other = tie.is_swapped ? from_ : to_;
    std::vector<Index> stencil = {tie.vertex + one.first_vertex};
    std::vector<Real> reduction = {1};
    Vec3 z = Vec3::Zero();  // as sum_stencil() sums it
    const Vec3 x = row(one.start, tie.vertex);
    for (std::size_t j = 0; j < tie.corners.size(); ++j) {
      stencil.push_back(tie.corners[j] + other.first_vertex);
      reduction.push_back(-tie.weights[j]);
      z += -tie.weights[j] * (row(other.start, tie.corners[j]) - x);
    }
    const Real now = std::sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    const bool is_as_it_is = options_.keep_distance || now <= rounding_;
    const Real end = is_as_it_is ? std::max(now, options_.length) : options_.length;
    std::array<Real, 5> fields = {end, end, std::max(now, end), from_.time, options_.closing_time};
    fields[0] = AttachmentProjection::length_at(from_.time, fields.data());
    batch.add(stencil, reduction, measure, fields);
  }

  const BodyView& from_;
  const BodyView& to_;
  const Attachment& options_;
  std::vector<Index> on_;
  std::vector<Index> to_on_;
  Real rounding_;  // [m]
};

}  // namespace

ConstraintSet build(const BodyView& from, const BodyView& to, const Attachment& options) {
  if (options.keep_distance && options.length > 0) {
    fail_input("attachment: 'keep_distance' and 'length' both say how long ties are; leave out one");
  }
  return AttachmentBuilder(from, to, options).build();
}

}  // namespace pliant
