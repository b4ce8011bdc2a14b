#pragma once
// What surfaces of glTF are made of, and how its colors are counted, which USD does alike.
#include <array>
#include <optional>

#include <nlohmann/json.hpp>

#include "pliant_io/export/export.h"

namespace pliant {

enum class Sides { one, both };

/// The light that shares of red, green and blue stand for (sRGB, IEC 61966-2-1); materials have light (glTF 2.0,
/// Sec. 3.9.2).
std::array<double, 3> light_of(const std::array<Real, 3>& color);

inline constexpr std::array<double, 3> collider_light = {0.32, 0.38, 0.46};

/// What glTF knows of a surface.
struct GltfLook {
  std::array<double, 3> light{};         ///< the texture is multiplied by it
  std::optional<std::size_t> texture{};  ///< of the document
  SurfaceFinish finish{};
};
nlohmann::ordered_json gltf_material(const GltfLook& look, Sides sides);

/// A muted color of its own for each of the first bodies.
nlohmann::ordered_json gltf_material_of_body(std::size_t body);

}  // namespace pliant
