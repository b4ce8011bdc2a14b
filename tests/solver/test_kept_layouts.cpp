// What was laid out of groups that stay is kept while others come, go and change: then the system is that of the same
// groups made anew, to the last bit.
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/constraints/build.h"
#include "pliant/constraints/builtin.h"
#include "pliant/mesh/join.h"
#include "pliant/mesh/shapes.h"
#include "pliant/solver/system.h"

namespace test_kept_layouts {

using namespace pliant;
using namespace pliant_tests;

namespace {

using Groups = std::vector<std::unique_ptr<ConstraintGroup>>;

/// Two sheets side by side and what may be added to them: linear forces, pairs of vertices that others have as well,
/// and such as connect the sheets.
struct Sheets {
  Mesh mesh;
  Positions q;
  Random random;

  explicit Sheets(Index side, bool is_shuffled = false) {
    const Mesh sheet = grid({.columns = side, .rows = side});
    mesh = join(std::vector<MeshPart>{{"", sheet}, {"", sheet}});
    if (is_shuffled) shuffle();
    q = mesh.vertices;
    for (Index i = 0; i < q.rows(); ++i) q.row(i) += random.vector(0.01).transpose();
  }
  Index count() const { return mesh.vertex_count(); }
  void shuffle() {
    std::vector<Index> numbers(at(count()));
    std::iota(numbers.begin(), numbers.end(), 0);
    for (Index i = count(); i > 1; --i) std::swap(numbers[at(i - 1)], numbers[at(random.index(i))]);
    const Positions before = mesh.vertices;
    for (Index i = 0; i < count(); ++i) mesh.vertices.row(numbers[at(i)]) = before.row(i);
    for (Triangle& triangle : mesh.triangles) {
      for (Index& corner : triangle) corner = numbers[at(corner)];
    }
  }
  BodyView view() const { return {mesh, mesh.vertices, 0, "sheets"}; }

  ConstraintSet make(Index kind) {
    switch (kind) {
      case 0:
        return build(view(), EdgeSpring{.stiffness = random.uniform(10, 100)});
      case 1:
        return build(view(), TriangleStrain{.stiffness = random.uniform(10, 100)});
      case 2:
        return build(view(), HingeBending{.stiffness = random.uniform(0.1, 1)});
      case 3:
        return build(view(), Position{.on = {random.index(count() / 2), count() - 1}});
      case 4:
        return build(view(), Position{.on = {random.index(count())}, .hold = Hold::soft, .stiffness = 50});
      case 5:
        return build(view(), Bending{.stiffness = random.uniform(0.1, 1)});  // around more neighbors than pay
      default:
        return build(view(), Line{.on = {random.index(count() / 2), count() / 2 + random.index(count() / 2)},
                                  .direction = Vec3(1, 0, 0)});
    }
  }
};

std::vector<ConstraintGroup*> pointers(const Groups& groups) {
  std::vector<ConstraintGroup*> list;
  for (const auto& group : groups) list.push_back(group.get());
  return list;
}

/// What a system says of an iterate.
struct Answer {
  Real elastic = 0;
  Positions forces, all_forces, move;
  std::vector<Real> energies;
  std::int64_t entries = 0;
  bool operator==(const Answer&) const = default;
};

Answer ask(System& system, const Groups& groups, const Sheets& sheets) {
  ThreadPool threads(1);
  SetUpTimes times;
  const std::vector<Real> masses(at(sheets.count()), 0.01);
  system.set_groups(sheets.count(), pointers(groups));
  if (system.needs_layout()) system.lay_out();
  system.factorize(masses, {}, 0.01, Precision::double_, threads, times);
  Positions q = sheets.q, s = sheets.mesh.vertices, r(q.rows(), 3), x(q.rows(), 3);
  system.order().gather(sheets.q, q);
  system.order().gather(sheets.mesh.vertices, s);
  Answer answer;
  const LocalResult local = system.local_step(q, s, r, threads);
  answer.elastic = local.elastic;
  answer.forces = r;
  system.solve(r, local.residual, x, threads);
  answer.move = x;
  answer.energies.resize(system.components().count());
  system.elastic_step(q, answer.all_forces = q, answer.energies, threads);
  answer.entries = system.describe(masses).matrix_entries;
  return answer;
}

std::unique_ptr<System> make_system() {
  auto system = std::make_unique<System>();
  system->set_factorization(make_factorization(Backend::eigen));
  return system;
}

/// Returns how many sizes of chunks there were, and whether the solver's order was another at the end.
std::pair<std::size_t, bool> check_edits(Sheets& sheets, int edits) {
  const auto system = make_system();
  Groups groups;
  std::set<std::size_t> slots_of_chunks;
  for (const Index kind : {0, 1, 2, 3}) {
    for (auto& batch : sheets.make(kind).batches) groups.push_back(std::move(batch));
  }
  for (int edit = 0; edit < edits; ++edit) {
    CAPTURE(edit);
    CHECK(ask(*system, groups, sheets) == ask(*make_system(), groups, sheets));
    slots_of_chunks.insert(std::max<std::size_t>(system->slot_count() / 64, 1024));
    if (sheets.random.index(8) == 0) system->set_factorization(make_factorization(Backend::eigen));
    const auto place = [&] { return groups.begin() + sheets.random.index(static_cast<Index>(groups.size())); };
    Groups removed;  // lives until the system knows of it no longer
    while (groups.size() > 6 || (groups.size() > 2 && sheets.random.index(2) == 0)) {
      const auto which = place();
      removed.push_back(std::move(*which));
      groups.erase(which);
    }
    if (sheets.random.index(4) != 0) {
      for (auto& batch : sheets.make(sheets.random.index(7)).batches) groups.insert(place(), std::move(batch));
    }
    if (sheets.random.index(4) == 0) {
      const auto which = place();
      const std::vector<Real> factors(at((*which)->shape().count), sheets.random.uniform(0.5, 2));
      (*which)->scale_measures(factors);
    }
    system->set_groups(sheets.count(), pointers(groups));
  }
  return {slots_of_chunks.size(), system->order().is_reordered()};
}

/// Springs that tell how often their coefficients were asked for.
class Watched final : public ConstraintGroup {
 public:
  explicit Watched(std::unique_ptr<ConstraintGroup> springs) : springs_(std::move(springs)) {}
  std::string_view type() const override { return springs_->type(); }
  GroupShape shape() const override { return springs_->shape(); }
  std::span<const Index> stencil() const override { return springs_->stencil(); }
  std::span<const Real> reduction() const override {
    ++reads;
    return springs_->reduction();
  }
  std::span<const Real> rest_measure() const override { return springs_->rest_measure(); }
  Real project(const Positions& q, std::span<Real> out, Index begin, Index end) const override {
    return springs_->project(q, out, begin, end);
  }
  using ConstraintGroup::changed;

  mutable int reads = 0;

 private:
  std::unique_ptr<ConstraintGroup> springs_;
};

}  // namespace

TEST_CASE("groups that come, go and change leave the system as if all were made anew") {
  Sheets sheets(6);
  check_edits(sheets, 80);
}

TEST_CASE("so do such as change the size of chunks") {
  Sheets sheets(60);
  CHECK(check_edits(sheets, 6).first > 2);
}

TEST_CASE("so do those of a mesh in random order, which the solver puts into another") {
  Sheets sheets(40, true);
  CHECK(check_edits(sheets, 6).second);
}

TEST_CASE("what stays is not looked at again, what has changed is") {
  Sheets sheets(10);
  Watched springs(std::move(sheets.make(0).batches.front()));
  const auto skin = sheets.make(1), pins = sheets.make(3);
  ConstraintGroup* const first = skin.batches.front().get();
  ConstraintGroup* const second = pins.batches.front().get();
  LocalStep step;
  SystemMatrix matrix;
  const auto reads = [&](const std::vector<ConstraintGroup*>& groups) {
    springs.reads = 0;
    step.set_groups(sheets.count(), groups);
    const int of_step = std::exchange(springs.reads, 0);
    matrix.set_groups(sheets.count(), groups);
    return std::pair(of_step > 0, springs.reads > 0);
  };
  CHECK(reads({&springs, first}) == std::pair(true, true));
  CHECK(reads({&springs, first, second}) == std::pair(false, false));
  CHECK(reads({second, &springs}) == std::pair(false, false));
  CHECK(reads({&springs}) == std::pair(false, false));
  springs.changed();
  CHECK(reads({&springs, first}) == std::pair(true, true));
}

TEST_CASE("nothing stays where there are more vertices, or two groups are copies") {
  Sheets few(5), many(7);
  const auto system = make_system();
  for (Sheets* sheets : {&few, &many, &few}) {
    Groups groups;
    for (const Index kind : {0, 1, 3}) {
      for (auto& batch : sheets->make(kind).batches) groups.push_back(std::move(batch));
    }
    groups.push_back(groups.front()->copy());
    REQUIRE(groups.back());
    CHECK(ask(*system, groups, *sheets) == ask(*make_system(), groups, *sheets));
    groups.front() = groups.back()->copy();
    CHECK(ask(*system, groups, *sheets) == ask(*make_system(), groups, *sheets));
    system->set_groups(sheets->count(), {});
  }
}

}  // namespace test_kept_layouts
