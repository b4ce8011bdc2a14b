#include "pliant_io/export/detail/gltf_materials.h"

#include <cmath>

namespace pliant {

std::array<double, 3> light_of(const std::array<Real, 3>& color) {
  const auto light = [](double share) {
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  return {light(color[0]), light(color[1]), light(color[2])};
}

nlohmann::ordered_json gltf_material(const GltfLook& look, Sides sides) {
  const auto& [red, green, blue] = look.light;
  nlohmann::ordered_json surface = {{"baseColorFactor", {red, green, blue, 1}}};
  if (look.texture) surface["baseColorTexture"] = {{"index", *look.texture}};
  surface["metallicFactor"] = look.finish.is_metal ? 1 : 0;
  surface["roughnessFactor"] = look.finish.roughness;
  return {{"pbrMetallicRoughness", std::move(surface)}, {"doubleSided", sides == Sides::both}};
}

nlohmann::ordered_json gltf_material_of_body(std::size_t body) {
  constexpr std::array<std::array<double, 3>, 6> lights = {{{0.28, 0.45, 0.69},
                                                            {0.77, 0.36, 0.22},
                                                            {0.33, 0.56, 0.38},
                                                            {0.80, 0.64, 0.26},
                                                            {0.52, 0.40, 0.62},
                                                            {0.45, 0.45, 0.45}}};
  return gltf_material({lights[body % lights.size()]}, Sides::both);
}

}  // namespace pliant
