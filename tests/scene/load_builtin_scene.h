#pragma once
#include <algorithm>
#include <string_view>

#include <doctest/doctest.h>

#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/scene.h"

namespace pliant_tests {

inline pliant::Scene load_builtin_scene(std::string_view name) {
  const auto scenes = pliant::builtin_scenes();
  const auto found = std::ranges::find(scenes, name, &pliant::BuiltinScene::name);
  REQUIRE(found != scenes.end());
  return pliant::parse_scene(found->text, "", found->name);
}

}  // namespace pliant_tests
