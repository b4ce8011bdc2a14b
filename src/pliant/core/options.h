#pragma once
// What the options of constraints and forces are made of.
//
// Every type lists its options once, in a static function `visit`; validation, scene files, the table of the docs and
// every other interface are written over that list.
#include <array>
#include <cmath>
#include <concepts>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/core/error.h"
#include "pliant/core/types.h"

namespace pliant {

/// Lists of different lengths, one after the other: list i is values[offsets[i] .. offsets[i + 1]).
template <class T>
struct Ragged {
  std::vector<Index> offsets = {0};
  std::vector<T> values;

  Ragged() = default;
  Ragged(std::initializer_list<std::initializer_list<T>> lists) {
    for (const auto& list : lists) add(list);
  }
  void add(std::span<const T> list) {
    values.insert(values.end(), list.begin(), list.end());
    offsets.push_back(static_cast<Index>(values.size()));
  }
  void add(std::initializer_list<T> list) { add(std::span<const T>(list.begin(), list.size())); }
  Index size() const { return static_cast<Index>(offsets.size()) - 1; }
  bool empty() const { return size() == 0; }
  std::span<const T> operator[](Index i) const {
    const auto begin = static_cast<std::size_t>(offsets[static_cast<std::size_t>(i)]);
    return std::span<const T>(values).subspan(
        begin, static_cast<std::size_t>(offsets[static_cast<std::size_t>(i) + 1]) - begin);
  }
};

using Stencils = Ragged<Index>;  ///< vertex indices of each constraint, within its body

/// A number for all constraints of a group, or one for each, or (empty) the one that follows from the rest positions.
/// Or one for each vertex of the body: then a constraint has the mean of its vertices'.
class Values {
 public:
  Values() = default;
  Values(Real value) : values_{value} {}
  Values(std::vector<Real> values) : values_(std::move(values)), each_(true) {}
  static Values of_vertices(std::vector<Real> values) {
    Values result(std::move(values));
    result.of_vertices_ = true;
    return result;
  }

  bool empty() const { return values_.empty(); }
  /// True unless one is for all: there is one for each constraint, or for each vertex.
  bool each() const { return each_; }
  /// True when there is one for each vertex.
  bool of_vertices() const { return of_vertices_; }
  Real operator[](Index i) const { return values_[each_ ? static_cast<std::size_t>(i) : 0]; }
  const std::vector<Real>& list() const { return values_; }

 private:
  std::vector<Real> values_;
  bool each_ = false;
  bool of_vertices_ = false;
};

/// A point or a direction for all constraints of a group, or one for each, or none.
class Points {
 public:
  Points() = default;
  Points(const Vec3& point) : points_{point} {}
  Points(std::vector<Vec3> points) : points_(std::move(points)), each_(true) {}

  bool empty() const { return points_.empty(); }
  bool each() const { return each_; }
  const Vec3& operator[](Index i) const { return points_[each_ ? static_cast<std::size_t>(i) : 0]; }
  const std::vector<Vec3>& list() const { return points_; }

 private:
  std::vector<Vec3> points_;
  bool each_ = false;
};

/// Vertices of a body: all, or those of a list. A constraint is made where its whole stencil is selected.
struct Selection {
  Selection() = default;
  Selection(std::vector<Index> indices) : everything(false), vertices(std::move(indices)) {}
  Selection(std::initializer_list<Index> indices) : everything(false), vertices(indices) {}

  bool everything = true;
  std::vector<Index> vertices;
};

/// Numbers an option may take.
struct Range {
  Real min = -std::numeric_limits<Real>::max();
  Real max = std::numeric_limits<Real>::max();
  bool excludes_min = false;
};
inline constexpr Range any_number{};
inline constexpr Range positive{0, std::numeric_limits<Real>::max(), true};
inline constexpr Range not_negative{0};

/// One option of a type: its key in scene files, its unit, and what it does.
struct OptionInfo {
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
  Range range = any_number;
  std::string_view word = {};  ///< that scene files may have in place of a whole number; it stands for `number_of_word`
  int number_of_word = 0;
};

/// What is wrong with a number that is not finite or out of its range, and what to give: "-1 is out of range; give a
/// finite number above 0 [s]".
std::optional<std::string> range_error(const OptionInfo& info, Real number);

namespace detail {

void check_number(std::string_view type, const OptionInfo& info, Real number, std::size_t index, bool is_list);

struct OptionChecker {
  std::string_view type;

  void operator()(const OptionInfo& info, const Index& number) const {
    check_number(type, info, static_cast<Real>(number), 0, false);
  }
  void operator()(const OptionInfo& info, const Real& number) const { check_number(type, info, number, 0, false); }
  void operator()(const OptionInfo& info, const std::optional<Real>& number) const {
    if (number) check_number(type, info, *number, 0, false);
  }
  void operator()(const OptionInfo& info, const Values& values) const { check(info, values.list(), values.each()); }
  void operator()(const OptionInfo& info, const Ragged<Real>& lists) const { check(info, lists.values, true); }
  void operator()(const OptionInfo& info, const Vec3& point) const {
    for (const Real x : point) check_number(type, info, x, 0, false);
  }
  template <class Number, std::size_t n>
  void operator()(const OptionInfo& info, const std::array<Number, n>& numbers) const {
    for (std::size_t i = 0; i < n; ++i) check_number(type, info, static_cast<Real>(numbers[i]), i, true);
  }
  void operator()(const OptionInfo& info, const Points& points) const {
    for (std::size_t i = 0; i < points.list().size(); ++i) {
      for (const Real x : points.list()[i]) check_number(type, info, x, i, points.each());
    }
  }
  template <class Other>
  void operator()(const OptionInfo&, const Other&) const {}  // enumerations and indices: checked by their builders

 private:
  void check(const OptionInfo& info, const std::vector<Real>& numbers, bool is_list) const {
    for (std::size_t i = 0; i < numbers.size(); ++i) check_number(type, info, numbers[i], i, is_list);
  }
};

}  // namespace detail

/// Throws Error(input), naming type, option, index and range, unless every number is finite and in its range.
template <class Options>
void check_options(std::string_view type, const Options& options) {
  Options::visit(options, detail::OptionChecker{type});
}

}  // namespace pliant
