// The kernels of the local step against the projections that they stand for, for every instruction set at hand.
#include <doctest/doctest.h>

#include "element_samples.h"
#include "pliant/constraints/kernels/local_kernels.h"

namespace test_kernels {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real not_a_number = std::numeric_limits<Real>::quiet_NaN();

/// Constraints of one type in lists as a batch has them, each on vertices of its own.
template <class Type>
struct Many {
  static constexpr int n = Type::vertices == dynamic_vertices ? 5 : Type::vertices;
  static constexpr bool is_fixed = requires { Type::is_difference; };
  using Reduction = Eigen::Matrix<Real, Type::rows, n, Eigen::RowMajor>;

  Positions positions;
  std::vector<Index> stencil;
  std::vector<Real> reduction, fields, measure;
  Real stiffness = 3;

  std::size_t count() const { return measure.size(); }

  static Reduction random_reduction(Random& random) {
    Reduction A;
    for (Real& c : A.reshaped()) c = random.uniform(-1, 1);
    A.col(0) -= A.rowwise().sum();
    if (is_fixed) A << -1, 1;
    return A;
  }

  void add(Random& random, const Fields& more, Real size, const Vec3& center) {
    const auto first = static_cast<Index>(positions.rows());
    positions.conservativeResize(first + n, 3);
    for (Index j = 0; j < n; ++j) {
      stencil.push_back(first + (j + 1) % n);
      positions.row(first + j) = (center + random.vector(size)).transpose();
    }
    const Reduction A = random_reduction(random);
    reduction.insert(reduction.end(), A.data(), A.data() + A.size());
    fields.insert(fields.end(), more.begin(), more.end());
    measure.push_back(random.uniform(0.1, 2));
  }

  /// Constraint `from` once more, at the end.
  void repeat(std::size_t from) {
    const auto copy = [from](auto& list, std::size_t size) {
      for (std::size_t a = 0; a < size; ++a) list.push_back(list[from * size + a]);
    };
    copy(stencil, n);
    copy(reduction, Type::rows * n);
    copy(fields, Type::fields);
    copy(measure, 1);
  }

  const Real* field(std::size_t i) const { return fields.data() + Type::fields * i; }
  Eigen::Map<const Reduction> reduction_of(std::size_t i) const {
    return Eigen::Map<const Reduction>(reduction.data() + Type::rows * n * i);
  }
  Rows<Type> z(std::size_t i) const {
    const Index* corners = stencil.data() + n * i;
    Eigen::Matrix<Real, n, 3, Eigen::RowMajor> e;
    for (Index j = 0; j < n; ++j) e.row(j) = positions.row(corners[j]) - positions.row(corners[0]);
    return reduction_of(i) * e;
  }

  LocalBlock block(std::size_t first, std::size_t many, const LaneCoefficients& coefficients, Real* out) const {
    constexpr bool is_dynamic = Type::vertices == dynamic_vertices;
    return {positions.data(),
            stencil.data() + n * first,
            is_dynamic ? reduction.data() + Type::rows * n * first : nullptr,
            is_dynamic ? nullptr : coefficients.from(first, many, reduction, {}),
            fields.data() + Type::fields * first,
            measure.data() + first,
            stiffness,
            static_cast<std::size_t>(n),
            many,
            out};
  }
};

template <class Type>
constexpr bool keeps_product =
    std::is_same_v<Type, TriangleAreaProjection> || std::is_same_v<Type, TetrahedronVolumeProjection>;

/// What a kernel writes for a constraint: its rows where there is one, else forces.
template <class Type>
using Written = Eigen::Matrix<Real, Type::rows == 1 ? 1 : Many<Type>::n, 3, Eigen::RowMajor>;

/// How much less well p is known of a triangle or tetrahedron that is nearly flat: 1 for a regular one.
template <class Type>
Real flatness(const Rows<Type>& z) {
  if constexpr (Type::rows == 1) {
    return 1;
  } else {
    const Eigen::Vector<Real, Type::rows> stretches = Eigen::JacobiSVD<Eigen::MatrixX<Real>>(z).singularValues();
    return stretches[0] / stretches[Type::rows - 1];
  }
}

template <class Type>
struct Outcome {
  std::vector<Written<Type>> written;
  std::vector<bool> is_done;
  Real energy = 0;
};

template <class Type>
Outcome<Type> run(const LocalKernels& kernels, const Many<Type>& many) {
  Outcome<Type> outcome;
  outcome.written.resize(many.count(), Written<Type>::Constant(not_a_number));
  outcome.is_done.resize(many.count(), false);
  LaneCoefficients coefficients(Type::rows, Many<Type>::n);
  coefficients.add_all(many.reduction);
  for (std::size_t first = 0; first < many.count(); first += local_block) {
    const std::size_t count = std::min(local_block, many.count() - first);
    const LocalDone done =
        (kernels.*Type::kernel)(many.block(first, count, coefficients, outcome.written[first].data()));
    CHECK(done.count <= count);
    outcome.energy += done.energy;
    std::vector<bool> is_left(count, false);
    for (std::size_t i = done.next(0); i < count; i = done.next(i + 1)) is_left[i] = true;
    for (std::size_t i = 0; i < count; ++i) outcome.is_done[first + i] = !is_left[i];
  }
  return outcome;
}

using Kernelled =
    std::tuple<EdgeSpringProjection, EdgeStrainProjection, TriangleStrainProjection, FibreStrainProjection,
               TautFibrePotential, TetrahedronStrainProjection, TriangleAreaProjection, TetrahedronVolumeProjection,
               ElasticPotential<NeoHookean, 2>, ElasticPotential<NeoHookean, 3>, ElasticPotential<StVenantKirchhoff, 2>,
               ElasticPotential<StVenantKirchhoff, 3>, FlatCurvature, AbsoluteCurvature, SignedFanCurvature>;

/// What rounding is measured by: of projections z, of potentials their terms of highest order.
template <class Type>
Real size_of_pull(const Rows<Type>& z) {
  return has_potential<Type> ? std::pow(1 + z.norm(), 5) : 1 + z.norm();
}

/// Sizes from far below to far above the rest shape, far from the origin as well.
template <class Type>
Many<Type> samples(Random& random, std::size_t count) {
  Many<Type> many;
  for (std::size_t i = 0; i < count; ++i) {
    many.add(random, Samples<Type>::fields(random), std::pow(10, random.uniform(-3, 3)), random.vector(100));
  }
  return many;
}

}  // namespace

TEST_CASE_TEMPLATE_DEFINE("a kernel writes what the projection or potential says", Type, as_projected) {
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    Random random;
    const Many<Type> many = samples<Type>(random, 1000);
    const Outcome<Type> outcome = run(*kernels, many);
    Real energy = 0;
    for (std::size_t i = 0; i < many.count(); ++i) {
      if (!outcome.is_done[i]) continue;
      CAPTURE(i);
      const Rows<Type> z = many.z(i);
      Rows<Type> pull;
      const Real weight = many.stiffness * many.measure[i];
      energy += weight * find_pull<Type>(many.field(i), z.data(), pull.data());
      Written<Type> expected;
      if constexpr (Type::rows == 1) {
        expected = weight * pull;
      } else {
        expected = many.reduction_of(i).transpose() * (weight * pull);
      }
      const Real scale = weight * size_of_pull<Type>(z) * (1 + many.reduction_of(i).norm());
      CHECK((outcome.written[i] - expected).cwiseAbs().maxCoeff() < 1e-13 * flatness<Type>(z) * scale);
    }
    CHECK(outcome.energy == doctest::Approx(energy).epsilon(1e-12));
  }
}
TEST_CASE_TEMPLATE_APPLY(as_projected, Kernelled);

TEST_CASE_TEMPLATE_DEFINE("a kernel leaves only what is not for it, and the end of a run", Type, leaves) {
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    Random random;
    Many<Type> many = samples<Type>(random, 300);
    const Outcome<Type> outcome = run(*kernels, many);
    int left = 0;
    for (std::size_t i = 0; i < 296; ++i) {  // a vector has eight lanes at most
      if (outcome.is_done[i]) continue;
      ++left;
      const Rows<Type> z = many.z(i);
      CAPTURE(z);
      if constexpr (has_potential<Type>) {
        CHECK_FALSE(z.allFinite());
      } else if constexpr (keeps_product<Type>) {
        CHECK(Samples<Type>::distance(std::vector<Real>(many.field(i), many.field(i) + 2), z) > 0);
      } else if constexpr (Type::rows == 3) {
        const bool is_clamped = many.field(i)[0] != many.field(i)[1];
        CHECK((is_clamped || z.determinant() < 1e-3 * std::pow(z.norm(), 3)));
      } else if constexpr (Type::rows == 2) {
        const bool is_clamped = many.field(i)[0] != many.field(i)[1];
        CHECK((is_clamped || z.row(0).cross(z.row(1)).norm() < 2e-3 * z.squaredNorm()));
      } else {
        REQUIRE(Type::fields == 8);  // on the other side of its normal
        CHECK(z.dot(Eigen::Map<const Eigen::RowVector3d>(many.field(i) + 5)) * many.field(i)[4] < 0);
      }
    }
    CHECK(left < 296);
  }
}
TEST_CASE_TEMPLATE_APPLY(leaves, Kernelled);

TEST_CASE_TEMPLATE_DEFINE("what stands beside a constraint does not matter to it", Type, alone) {
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    Random random;
    Many<Type> many = samples<Type>(random, 64);
    for (const std::size_t odd : std::array<std::size_t, 3>{3, 21, 40}) {  // not finite, or a point
      for (Index j = 0; j < Many<Type>::n; ++j) {
        const Index vertex = many.stencil[Many<Type>::n * odd + static_cast<std::size_t>(j)];
        many.positions.row(vertex).setConstant(odd == 40 ? 1 : not_a_number);
      }
    }
    const std::size_t count = many.count();
    for (std::size_t i = 0; i < count; ++i) many.repeat((7 * i + 5) % count);
    const Outcome<Type> outcome = run(*kernels, many);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t from = (7 * i + 5) % count;
      CHECK(outcome.is_done[count + i] == outcome.is_done[from]);
      if (outcome.is_done[from] && from != 3 && from != 21) {
        CHECK(outcome.written[count + i] == outcome.written[from]);
      }
      if (Type::fields > 0 && (from == 3 || from == 21)) CHECK_FALSE(outcome.is_done[from]);
    }
    if (Type::fields > 0) CHECK(std::isfinite(outcome.energy));
  }
}
TEST_CASE_TEMPLATE_APPLY(alone, Kernelled);

TEST_CASE("rotations of tetrahedra are known to rounding, from rest to stretches that differ by a factor of eight") {
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    for (const Real spread : {0.0, 1e-9, 1e-3, 0.1, 0.5, 1.0}) {
      CAPTURE(spread);
      Random random;
      Many<TetrahedronStrainProjection> many;
      for (int i = 0; i < 640; ++i) {
        many.add(random, {1, 1}, 1, Vec3::Zero());
        Eigen::Map<Eigen::Matrix<Real, 3, 4, Eigen::RowMajor>> A(many.reduction.data() + 12 * i);
        A.setZero();
        for (int row = 0; row < 3; ++row) A(row, 0) = -1, A(row, row + 1) = 1;
        const Mat3 R = random.rotation(), V = random.rotation();
        const Vec3 stretches = (spread * random.vector(1)).array().exp();
        const Mat3 F = R * V * stretches.asDiagonal() * V.transpose();
        const Index* corners = many.stencil.data() + 4 * i;
        for (int row = 0; row < 3; ++row) {
          many.positions.row(corners[row + 1]) = many.positions.row(corners[0]) + F.col(row).transpose();
        }
      }
      const Outcome<TetrahedronStrainProjection> outcome = run(*kernels, many);
      for (std::size_t i = 0; i < many.count(); ++i) {
        REQUIRE(outcome.is_done[i]);
        const Mat3 F = many.z(i).transpose();
        const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
        const Mat3 pull = svd.matrixU() * svd.matrixV().transpose() - F;
        const Mat3 found = outcome.written[i].bottomRows<3>().transpose() / (many.stiffness * many.measure[i]);
        CHECK((found - pull).cwiseAbs().maxCoeff() < 1e-14);
        if (spread == 0) CHECK(outcome.written[i].isZero(0));  // what rests stays at rest, however it is turned
      }
    }
  }
}

TEST_CASE("a batch takes from a kernel what it does, and does the rest by itself") {
  Random random;
  const Many<TetrahedronStrainProjection> many = samples<TetrahedronStrainProjection>(random, 203);
  Batch<TetrahedronStrainProjection> batch(many.stiffness);
  for (std::size_t i = 0; i < many.count(); ++i) {
    batch.add(std::span(many.stencil).subspan(4 * i, 4), std::span(many.reduction).subspan(12 * i, 12), many.measure[i],
              {many.field(i), 2});
  }
  const auto count = static_cast<Index>(many.count());
  std::vector<Real> forces(12 * many.count());
  std::vector<Real> one_by_one(12 * many.count());
  const Real energy = batch.project_to_forces(many.positions, forces, 0, count);
  const Real expected = batch.ConstraintGroup::project_to_forces(many.positions, one_by_one, 0, count);
  CHECK(energy == doctest::Approx(expected).epsilon(1e-12));
  for (std::size_t i = 0; i < many.count(); ++i) {
    const Real scale = many.stiffness * many.measure[i] * (1 + many.z(i).norm()) * (1 + many.reduction_of(i).norm());
    for (std::size_t a = 12 * i; a < 12 * i + 12; ++a) CHECK(std::abs(forces[a] - one_by_one[a]) < 1e-9 * scale);
  }
}

TEST_CASE_TEMPLATE("the same of a part of a batch, wherever that begins, and in another order", Type,
                   EdgeStrainProjection, FibreStrainProjection, TriangleStrainProjection, TetrahedronStrainProjection) {
  constexpr std::size_t n = Many<Type>::n, size = n * Type::rows;
  constexpr std::size_t numbers = Type::rows == 1 ? 3 : 3 * n;
  Random random;
  const Many<Type> many = samples<Type>(random, 203);
  const auto add = [&](std::size_t i, Batch<Type>& to) {
    to.add(std::span(many.stencil).subspan(n * i, n), std::span(many.reduction).subspan(size * i, size),
           many.measure[i], {many.field(i), Type::fields});
  };
  const auto project = [&](const Batch<Type>& batch, std::span<Real> out, Index begin, Index end) {
    return Type::rows == 1 ? batch.project(many.positions, out, begin, end)
                           : batch.project_to_forces(many.positions, out, begin, end);
  };
  Batch<Type> batch(many.stiffness);
  for (std::size_t i = 0; i < many.count(); ++i) add(i, batch);
  const auto all = static_cast<Index>(many.count());
  for (const Index begin : {1, 7, 61, 100}) {
    CAPTURE(begin);
    Batch<Type> part(many.stiffness);
    for (auto i = static_cast<std::size_t>(begin); i < many.count(); ++i) add(i, part);
    std::vector<Real> forces(numbers * at(all - begin)), of_part(forces);
    CHECK(project(batch, forces, begin, all) == project(part, of_part, 0, all - begin));
    CHECK(forces == of_part);
  }
  std::vector<Index> backwards, same(at(static_cast<Index>(many.positions.rows())));
  for (Index i = all; i-- > 0;) backwards.push_back(i);
  for (std::size_t v = 0; v < same.size(); ++v) same[v] = static_cast<Index>(v);
  const auto other = batch.reordered(backwards, same);
  Batch<Type> expected(many.stiffness);
  for (std::size_t i = many.count(); i-- > 0;) add(i, expected);
  std::vector<Real> forces(numbers * many.count()), of_expected(forces);
  CHECK(project(dynamic_cast<const Batch<Type>&>(*other), forces, 0, all) == project(expected, of_expected, 0, all));
  CHECK(forces == of_expected);
}

TEST_CASE_TEMPLATE("no element near its area or volume at rest is left", Type, TriangleAreaProjection,
                   TetrahedronVolumeProjection) {
  constexpr int n = Type::vertices;
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    Random random;
    Many<Type> many;
    for (int i = 0; i < 640; ++i) {
      many.add(random, {1, 1}, 1, Vec3::Zero());
      Eigen::Map<Eigen::Matrix<Real, Type::rows, n, Eigen::RowMajor>> A(many.reduction.data() + Type::rows * n * i);
      A.setZero();
      for (int row = 0; row < Type::rows; ++row) A(row, 0) = -1, A(row, row + 1) = 1;
      const Mat3 F =
          random.rotation() + 0.15 * (Mat3() << random.vector(1), random.vector(1), random.vector(1)).finished();
      const Index* corners = many.stencil.data() + n * i;
      for (int row = 0; row < Type::rows; ++row) {
        many.positions.row(corners[row + 1]) = many.positions.row(corners[0]) + F.col(row).transpose();
      }
    }
    const Outcome<Type> outcome = run(*kernels, many);
    CHECK(std::ranges::all_of(outcome.is_done, [](bool is_done) { return is_done; }));
  }
}

}  // namespace test_kernels
