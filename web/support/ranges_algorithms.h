#pragma once
// The algorithms of std::ranges that Pliant uses, for a standard library that has std::ranges' concepts and not its
// algorithms: libc++ before version 15. They call the algorithms of namespace std, on ranges with iterators of one type
// for both ends, and return what those return.
#include <algorithm>
#include <functional>
#include <iterator>
#include <ranges>
#include <utility>

namespace std::ranges {

/// What a projection makes of a predicate, and of a comparison.
template <class Predicate, class Projection>
auto projected_predicate(Predicate& predicate, Projection& projection) {
  return [&](auto&& item) -> bool { return std::invoke(predicate, std::invoke(projection, item)); };
}
template <class Compare, class First, class Second>
auto projected_comparison(Compare& compare, First& first, Second& second) {
  return [&](auto&& a, auto&& b) -> bool {
    return std::invoke(compare, std::invoke(first, std::forward<decltype(a)>(a)),
                       std::invoke(second, std::forward<decltype(b)>(b)));
  };
}

// ---- an iterator or a yes or no, of a predicate
template <range R, class Predicate, class Projection = identity>
bool all_of(R&& r, Predicate predicate, Projection projection = {}) {
  return std::all_of(begin(r), end(r), projected_predicate(predicate, projection));
}
template <range R, class Predicate, class Projection = identity>
bool any_of(R&& r, Predicate predicate, Projection projection = {}) {
  return std::any_of(begin(r), end(r), projected_predicate(predicate, projection));
}
template <range R, class Predicate, class Projection = identity>
bool none_of(R&& r, Predicate predicate, Projection projection = {}) {
  return std::none_of(begin(r), end(r), projected_predicate(predicate, projection));
}
template <range R, class Predicate, class Projection = identity>
auto find_if(R&& r, Predicate predicate, Projection projection = {}) {
  return std::find_if(begin(r), end(r), projected_predicate(predicate, projection));
}
template <range R, class Predicate, class Projection = identity>
auto count_if(R&& r, Predicate predicate, Projection projection = {}) {
  return std::count_if(begin(r), end(r), projected_predicate(predicate, projection));
}

// ---- the same of a value
template <input_iterator I, class Value, class Projection = identity>
I find(I first, I last, const Value& value, Projection projection = {}) {
  return std::find_if(first, last, [&](auto&& item) -> bool { return std::invoke(projection, item) == value; });
}
template <range R, class Value, class Projection = identity>
auto find(R&& r, const Value& value, Projection projection = {}) {
  return ranges::find(begin(r), end(r), value, std::move(projection));
}
template <range R, class Value, class Projection = identity>
auto count(R&& r, const Value& value, Projection projection = {}) {
  return std::count_if(begin(r), end(r), [&](auto&& item) -> bool { return std::invoke(projection, item) == value; });
}

// ---- of two ranges
template <range R, range Other, class Equal = equal_to, class First = identity, class Second = identity>
bool equal(R&& r, Other&& other, Equal same = {}, First first = {}, Second second = {}) {
  return std::equal(begin(r), end(r), begin(other), end(other), projected_comparison(same, first, second));
}
template <range R, range Other>
bool includes(R&& r, Other&& other) {
  return std::includes(begin(r), end(r), begin(other), end(other));
}
template <range R, range Other>
auto find_first_of(R&& r, Other&& other) {
  return std::find_first_of(begin(r), end(r), begin(other), end(other));
}
template <range R, range Other>
bool lexicographical_compare(R&& r, Other&& other) {
  return std::lexicographical_compare(begin(r), end(r), begin(other), end(other));
}
template <range R, range Other, class Out>
auto set_difference(R&& r, Other&& other, Out out) {
  return std::set_difference(begin(r), end(r), begin(other), end(other), out);
}

// ---- of neighbors, and of what is sorted
template <range R, class Equal = equal_to, class Projection = identity>
auto adjacent_find(R&& r, Equal same = {}, Projection projection = {}) {
  return std::adjacent_find(begin(r), end(r), projected_comparison(same, projection, projection));
}
template <range R, class Compare = less, class Projection = identity>
bool is_sorted(R&& r, Compare compare = {}, Projection projection = {}) {
  return std::is_sorted(begin(r), end(r), projected_comparison(compare, projection, projection));
}
template <range R, class Value, class Compare = less, class Projection = identity>
auto lower_bound(R&& r, const Value& value, Compare compare = {}, Projection projection = {}) {
  identity as_it_is;
  return std::lower_bound(begin(r), end(r), value, projected_comparison(compare, projection, as_it_is));
}
template <range R, class Value, class Compare = less, class Projection = identity>
auto upper_bound(R&& r, const Value& value, Compare compare = {}, Projection projection = {}) {
  identity as_it_is;
  return std::upper_bound(begin(r), end(r), value, projected_comparison(compare, as_it_is, projection));
}
template <range R, class Value, class Compare = less, class Projection = identity>
bool binary_search(R&& r, const Value& value, Compare compare = {}, Projection projection = {}) {
  const auto found = ranges::lower_bound(r, value, compare, projection);
  return found != end(r) && !std::invoke(compare, value, std::invoke(projection, *found));
}

// ---- order
template <range R, class Compare = less, class Projection = identity>
void sort(R&& r, Compare compare = {}, Projection projection = {}) {
  std::sort(begin(r), end(r), projected_comparison(compare, projection, projection));
}
template <range R, class Compare = less, class Projection = identity>
void stable_sort(R&& r, Compare compare = {}, Projection projection = {}) {
  std::stable_sort(begin(r), end(r), projected_comparison(compare, projection, projection));
}
template <random_access_iterator I, class Compare = less, class Projection = identity>
void nth_element(I first, I nth, I last, Compare compare = {}, Projection projection = {}) {
  std::nth_element(first, nth, last, projected_comparison(compare, projection, projection));
}
template <range R, class Compare = less, class Projection = identity>
void nth_element(R&& r, iterator_t<R> nth, Compare compare = {}, Projection projection = {}) {
  ranges::nth_element(begin(r), nth, end(r), std::move(compare), std::move(projection));
}
template <range R, class Compare = less>
void push_heap(R&& r, Compare compare = {}) {
  std::push_heap(begin(r), end(r), compare);
}
template <range R, class Compare = less>
void pop_heap(R&& r, Compare compare = {}) {
  std::pop_heap(begin(r), end(r), compare);
}
template <range R>
void reverse(R&& r) {
  std::reverse(begin(r), end(r));
}
template <range R, class Random>
void shuffle(R&& r, Random&& random) {
  std::shuffle(begin(r), end(r), random);
}

// ---- the least and the largest
template <range R, class Compare = less, class Projection = identity>
auto min_element(R&& r, Compare compare = {}, Projection projection = {}) {
  return std::min_element(begin(r), end(r), projected_comparison(compare, projection, projection));
}
template <range R, class Compare = less, class Projection = identity>
auto max_element(R&& r, Compare compare = {}, Projection projection = {}) {
  return std::max_element(begin(r), end(r), projected_comparison(compare, projection, projection));
}
template <range R>
auto minmax_element(R&& r) {
  return std::minmax_element(begin(r), end(r));
}
template <range R>
range_value_t<R> min(R&& r) {
  return *std::min_element(begin(r), end(r));
}
template <range R>
range_value_t<R> max(R&& r) {
  return *std::max_element(begin(r), end(r));
}

// ---- what writes
template <range R, class Out>
Out copy(R&& r, Out out) {
  return std::copy(begin(r), end(r), out);
}
template <range R, class Out>
Out move(R&& r, Out out) {
  return std::move(begin(r), end(r), out);
}
template <range R, class Out, class Predicate>
Out copy_if(R&& r, Out out, Predicate predicate) {
  return std::copy_if(begin(r), end(r), out, std::ref(predicate));
}
template <range R, class Out, class Function>
Out transform(R&& r, Out out, Function function) {
  return std::transform(begin(r), end(r), out, std::ref(function));
}
template <range R, class Value>
void fill(R&& r, const Value& value) {
  std::fill(begin(r), end(r), value);
}
template <range R, class Value>
void replace(R&& r, const Value& old_value, const Value& new_value) {
  std::replace(begin(r), end(r), old_value, new_value);
}
template <range R, class Predicate, class Value>
void replace_if(R&& r, Predicate predicate, const Value& value) {
  std::replace_if(begin(r), end(r), std::ref(predicate), value);
}
template <range R, class Function>
void for_each(R&& r, Function function) {
  std::for_each(begin(r), end(r), std::ref(function));
}

}  // namespace std::ranges
