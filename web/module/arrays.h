#pragma once
// Numbers of C++ as typed arrays of JavaScript, copied.
#include <vector>

#include <emscripten/val.h>

#include "render/vectors.h"

namespace pliant_web {

/// `type`: the name of the typed array whose elements these are: "Uint32Array".
template <class Number>
emscripten::val typed_array(const char* type, const Number* numbers, std::size_t count) {
  return emscripten::val::global(type).new_(emscripten::val(emscripten::typed_memory_view(count, numbers)));
}

inline emscripten::val array_of(const std::vector<std::uint32_t>& numbers) {
  return typed_array("Uint32Array", numbers.data(), numbers.size());
}
inline emscripten::val array_of(const std::vector<float>& numbers) {
  return typed_array("Float32Array", numbers.data(), numbers.size());
}
inline emscripten::val array_of(const std::vector<pliant_render::Vec3f>& points) {
  return typed_array("Float32Array", points.empty() ? nullptr : points.front().data(), 3 * points.size());
}
inline emscripten::val array_of(const std::vector<std::array<std::uint8_t, 4>>& bytes) {
  return typed_array("Uint8Array", bytes.empty() ? nullptr : bytes.front().data(), 4 * bytes.size());
}

/// A plain array of the numbers of a vector.
template <class Vector>
emscripten::val numbers_of(const Vector& vector) {
  emscripten::val list = emscripten::val::array();
  for (Eigen::Index i = 0; i < vector.size(); ++i) list.call<void>("push", static_cast<double>(vector[i]));
  return list;
}

}  // namespace pliant_web
