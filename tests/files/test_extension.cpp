#include <doctest/doctest.h>

#include "pliant_io/export/animation_format.h"
#include "pliant_io/files/extension.h"
#include "pliant_io/mesh/mesh_format.h"
#include "pliant_io/mesh/point_cache_format.h"

namespace test_extension {

using namespace pliant;

TEST_CASE("an extension in small letters, without its point") {
  CHECK(small_extension("a/b.OBJ") == "obj");
  CHECK(small_extension("b.tar.Gz") == "gz");
  CHECK(small_extension(std::filesystem::path(u8"b.Ä")) == "Ä");
  for (const char* path : {"", "a", "a.", ".obj", "a.b/c"}) CHECK(small_extension(path).empty());
}

TEST_CASE("a format is found by its extension, in capitals too, and another is none") {
  CHECK(point_cache_format("a.PC2")->name == "pc2");
  CHECK(animation_format("a.Glb")->name == "glb");
  CHECK(mesh_format("a.STL")->name == "stl");
  for (const char* path : {"a", "a.", "a.abc", "pc2", ".glb"}) {
    CHECK_FALSE(point_cache_format(path).has_value());
    CHECK_FALSE(animation_format(path).has_value());
    CHECK_FALSE(mesh_format(path).has_value());
  }
  for (const PointCacheFormat& format : point_cache_formats()) CHECK(animation_format("a." + std::string(format.name)));
  CHECK(point_cache_extensions() == ".pc2, .mdd, .npy");
  CHECK(animation_extensions() == "gltf, glb, usda, pvd, pc2, mdd, npy");
}

}  // namespace test_extension
