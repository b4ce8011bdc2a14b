// Textures, weave and finishes, and surfaces that are drawn smoother than they are simulated.
#include <fstream>
#include <set>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "../support/temporary_folder.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/scene/scene.h"
#include "pliant_io/scene/scene_document.h"
#include "render/body_looks.h"
#include "render/capture.h"
#include "render/texture_image.h"
#include "studio.h"

namespace test_textures {

using namespace pliant_render;
using namespace pliant_tests;
using pliant::BodyAppearance;
using pliant::BodyId;
using pliant::Color;
using pliant::Finish;
using pliant::Mapping;

namespace {

const Color gray{0.6, 0.6, 0.6};

/// Four quarters: red and green above, blue and black below; twice as wide as high.
Image quarters() {
  Image image{16, 8, {}};
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool is_left = x < 8, is_above = y < 4;
      image.pixels.push_back(is_left && is_above ? 255 : 0);
      image.pixels.push_back(!is_left && is_above ? 255 : 0);
      image.pixels.push_back(is_left && !is_above ? 255 : 0);
    }
  }
  return image;
}

struct TexturedStudio : Studio {
  TemporaryFolder folder;
  std::string file = (folder.path() / "quarters.png").string();

  TexturedStudio() { write_png(file, quarters()); }

  std::optional<Image> draw_with(const BodyAppearance& appearance, const pliant::Material* material = nullptr) const {
    RenderMesh render_mesh = make_render_mesh(bodies);
    std::map<BodyId, pliant::Material> materials;
    if (material != nullptr) materials.emplace(BodyId{0}, *material);
    render_mesh.looks = body_looks(bodies, {{BodyId{0}, appearance}}, materials);
    try {
      return PictureMaker(std::move(render_mesh), options).draw(frame, {});
    } catch (const pliant::Error& error) {
      MESSAGE("skipped: ", std::string(error.what()));
      return {};
    }
  }
};

/// Which of red, green and blue a color is; 'k' for none of them, 'w' for all alike.
char name_of(const Rgb& color) {
  const int most = std::max({color[0], color[1], color[2]}), least = std::min({color[0], color[1], color[2]});
  if (most < 60) return 'k';
  if (most - least < 25) return 'w';
  return most == color[0] ? 'r' : most == color[1] ? 'g' : 'b';
}

/// The color at a place on the square, from (0, 0) below left to (1, 1).
char seen(const Image& image, double x, double z) {
  const double to_v = 1 / (3 * std::tan(20 * 3.14159265358979 / 180));
  return name_of(at(image, 0.75 * to_v * (x - 0.5), to_v * (z - 0.5)));
}

pliant::Scene scene_in(const TemporaryFolder& folder, const std::string& appearance,
                       std::vector<std::string> set = {}) {
  return pliant::parse_scene(R"({ "pliant": 1, "steps": 1, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
      "mesh": { "shape": "grid", "columns": 3, "rows": 3 }, "appearance": )" +
                                 appearance + "} ] }",
                             folder.path(), "textured", {.set = std::move(set)});
}

}  // namespace

TEST_CASE("a texture fills the unit square of texture coordinates, its first row on top") {
  const TexturedStudio studio;
  const std::optional<Image> image = studio.draw_with({.texture = studio.file});
  if (!image) return;
  CHECK(seen(*image, 0.25, 0.75) == 'r');
  CHECK(seen(*image, 0.75, 0.75) == 'g');
  CHECK(seen(*image, 0.25, 0.25) == 'b');
  CHECK(seen(*image, 0.75, 0.25) == 'k');
  // Half as large it is there four times.
  const std::optional<Image> half = studio.draw_with({.texture = studio.file, .texture_size = 0.5});
  for (const double x : {0.0, 0.5}) {
    for (const double z : {0.0, 0.5}) {
      CHECK(seen(*half, x + 0.125, z + 0.375) == 'r');
      CHECK(seen(*half, x + 0.375, z + 0.375) == 'g');
      CHECK(seen(*half, x + 0.125, z + 0.125) == 'b');
    }
  }
}

TEST_CASE("by places at rest a texture has its width in meters and its own proportions, from the lowest corner") {
  TexturedStudio studio;
  const BodyAppearance appearance{.texture = studio.file, .texture_size = 1, .mapping = Mapping::rest};
  const std::optional<Image> image = studio.draw_with(appearance);
  if (!image) return;
  for (const double z : {0.0, 0.5}) {  // half as high as wide
    CHECK(seen(*image, 0.25, z + 0.375) == 'r');
    CHECK(seen(*image, 0.75, z + 0.375) == 'g');
    CHECK(seen(*image, 0.25, z + 0.125) == 'b');
    CHECK(seen(*image, 0.75, z + 0.125) == 'k');
  }
  // It goes with the body.
  for (Vec3f& p : studio.frame.positions) p.x() *= 0.5F;
  const std::optional<Image> narrow = studio.draw_with(appearance);
  CHECK(seen(*narrow, 0.375, 0.375) == 'r');
  CHECK(seen(*narrow, 0.625, 0.375) == 'g');
}

TEST_CASE("with a back color the texture is on the front alone, and where it is transparent the color shows") {
  TexturedStudio studio;
  const BodyAppearance both{.front = gray, .texture = studio.file};
  BodyAppearance one = both;
  one.back = gray;
  const std::optional<Image> front = studio.draw_with(one);
  if (!front) return;
  const bool is_front = seen(*front, 0.25, 0.75) == 'r';
  studio.options.appearance.camera.position = pliant::Vec3(0, 3, 0);
  const std::optional<Image> back = studio.draw_with(one);
  CHECK((seen(*back, 0.75, 0.75) == 'r') != is_front);  // mirrored from behind
  CHECK(seen(*(is_front ? back : front), 0.25, 0.25) == 'w');
  CHECK(seen(*studio.draw_with(both), 0.75, 0.75) == 'r');

  // A picture of one transparent pixel.
  constexpr std::array<unsigned char, 68> clear = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
      0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00, 0x00, 0x1f, 0x15, 0xc4, 0x89, 0x00,
      0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x60, 0x00, 0x02, 0x00, 0x00, 0x05, 0x00,
      0x01, 0xe9, 0xfa, 0xdc, 0xd8, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  pliant::write_file_atomically(studio.file, std::string(clear.begin(), clear.end()));
  CHECK(seen(*studio.draw_with(both), 0.75, 0.75) == 'w');
}

TEST_CASE("seams of texture coordinates split corners, and normals go on over them") {
  pliant::Mesh mesh = pliant::grid({.columns = 3, .rows = 2, .size = {2, 1}, .diagonals = pliant::Diagonals::forward});
  pliant::PolygonFaces& faces = mesh.faces;
  REQUIRE(!faces.texture_coordinates.empty());
  // The second half of the faces has the texture a second time: the middle column is a seam.
  const auto old = static_cast<pliant::Index>(mesh.texture_coordinates.rows());
  mesh.texture_coordinates.conservativeResize(2 * old, 2);
  mesh.texture_coordinates.bottomRows(old) = mesh.texture_coordinates.topRows(old).array() + 3;
  std::set<pliant::Index> right;
  for (pliant::Index face = 0; face < faces.face_count(); ++face) {
    for (auto c = faces.offsets[static_cast<std::size_t>(face)]; c < faces.offsets[static_cast<std::size_t>(face) + 1];
         ++c) {
      const auto corner = static_cast<std::size_t>(c);
      const auto first = static_cast<std::size_t>(faces.offsets[static_cast<std::size_t>(face)]);
      const pliant::Real lowest = mesh.vertices(faces.vertices[first], 0);
      if (lowest > 0.5 || mesh.vertices(faces.vertices[first + 1], 0) > 1.5 ||
          mesh.vertices(faces.vertices[first + 2], 0) > 1.5) {
        faces.texture_coordinates[corner] += old;
      }
    }
  }
  mesh.vertices(0, 2) = 0.3;  // not flat
  const RenderMesh render_mesh = make_render_mesh({{"sheet", mesh, 0}});
  REQUIRE(!render_mesh.copies.empty());
  REQUIRE(render_mesh.texture_coordinates.size() == 6 + render_mesh.copies.size());
  const std::vector<Vec3f> normals = corner_normals(render_mesh, to_floats(mesh.vertices));
  for (std::size_t copy = 0; copy < render_mesh.copies.size(); ++copy) {
    const std::uint32_t vertex = render_mesh.copies[copy];
    CHECK(render_mesh.normals_from[copy] == vertex);
    CHECK(normals[6 + copy] == normals[vertex]);
    CHECK((render_mesh.texture_coordinates[6 + copy] - render_mesh.texture_coordinates[vertex]).norm() > 2);
  }
  for (std::size_t corner = 0; corner < render_mesh.corners.size(); ++corner) {
    const std::uint32_t number = render_mesh.corners[corner];
    CHECK((number < 6 ? number : render_mesh.copies[number - 6]) == render_mesh.triangles[corner]);
  }
}

TEST_CASE("finishes differ in pictures, and what is left open follows the material") {
  TexturedStudio studio;
  studio.options.appearance.camera.position = pliant::Vec3(-1, -2, 1.8);
  std::vector<Image> images;
  for (const Finish finish : {Finish::cloth, Finish::matte, Finish::glossy, Finish::metal}) {
    const std::optional<Image> image = studio.draw_with({.front = gray, .finish = finish});
    if (!image) return;
    for (const Image& other : images) CHECK(image->pixels != other.pixels);
    images.push_back(*image);
  }
  const BodyAppearance open{.front = gray};
  CHECK(difference(*studio.draw_with(open), images[0]) == 0);  // a sheet is cloth
  const pliant::Material* steel = pliant::find_builtin_material("steel_sheet");
  CHECK(difference(*studio.draw_with(open, steel), images[3]) == 0);
  CHECK(finish_of({}, "foam", false) == Finish::matte);
  CHECK(finish_of({}, "silicone", false) == Finish::glossy);
  CHECK(finish_of({.finish = Finish::cloth}, "steel_sheet", true) == Finish::cloth);
}

TEST_CASE("a weave is seen close up, and not where a thread is smaller than a pixel") {
  TexturedStudio studio;
  const BodyAppearance plain{.front = gray, .weave = 0.0}, woven{.front = gray, .weave = 1e-3};
  const std::optional<Image> far = studio.draw_with(woven);
  if (!far) return;
  CHECK(difference(*far, *studio.draw_with(plain)) == 0);
  studio.options.appearance.camera.position = pliant::Vec3(0, -0.03, 0);
  CHECK(difference(*studio.draw_with(woven), *studio.draw_with(plain)) > 0.3);
  const pliant::Material* wool = pliant::find_builtin_material("wool");
  CHECK(difference(*studio.draw_with({.front = gray}, wool), *studio.draw_with({.front = gray})) > 0.1);
}

TEST_CASE("scenes name textures from their folder, and save them from the root") {
  const TemporaryFolder folder;
  write_png(folder.path() / "print.png", quarters());
  const pliant::Scene scene = scene_in(folder, R"({ "texture": "print.png", "mapping": "rest", "finish": "glossy" })");
  const std::string& path = scene.appearances.at(BodyId{0}).texture;
  CHECK(std::filesystem::equivalent(path, folder.path() / "print.png"));
  CHECK(std::filesystem::path(path).is_absolute());
  CHECK(scene.files.empty());  // no step depends on it
  CHECK(scene.warnings.empty());
  CHECK(contains(pliant::SceneDocument(scene).text(), path));
  CHECK(make_render_mesh(scene).looks.textures.at(0) == path);
  CHECK(scene_in(folder, R"({ "texture": "" })").appearances.at(BodyId{0}).texture.empty());
}

TEST_CASE("textures that are missing, broken, too large or of another kind are told with their names") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& appearance) { return error_of([&] { scene_in(folder, appearance); }); };
  const auto warning = [&](const std::string& appearance) {
    const pliant::Scene scene = scene_in(folder, appearance);
    REQUIRE(scene.warnings.size() == 1);
    return scene.warnings.front();
  };
  CHECK(contains(warning(R"({ "texture": "none.png" })"), "bodies[0].appearance.texture"));
  CHECK(contains(warning(R"({ "texture": "none.png" })"), "none.png: no such file"));
  const pliant::Scene set = scene_in(folder, "{}", {"bodies[0].appearance.texture=none.png"});
  CHECK(contains(set.warnings.at(0), "texture=none.png: none.png: no such file"));
  CHECK(contains(refused(R"({ "texture": 3 })"), "bodies[0].appearance.texture"));
  std::ofstream(folder.path() / "text.png") << "no picture";
  CHECK(contains(warning(R"({ "texture": "text.png" })"), "PNG or JPEG"));
  CHECK(contains(refused(R"({ "texture_size": 0 })"), "texture_size"));
  CHECK(contains(refused(R"({ "weave": -1 })"), "weave"));
  CHECK(contains(refused(R"({ "finish": "chrome" })"), "metal"));

  const std::string whole = encode_png(quarters());
  CHECK(decode_texture(whole, "a.png").pixels.size() == 4u * 16 * 8);
  CHECK(texture_size(whole, "a.png") == std::array{16, 8});
  CHECK(contains(error_of([&] { decode_texture(whole.substr(0, 40), "a.png"); }), "a.png"));
  std::string large = whole;
  large[18] = 0x40;  // 16,400 pixels wide
  CHECK(contains(error_of([&] { texture_size(large, "a.png"); }), "8192"));
  for (std::size_t i = 8; i < whole.size(); ++i) {  // whatever a byte is, there is a picture or a message
    std::string spoilt = whole;
    spoilt[i] = static_cast<char>(spoilt[i] ^ 0x55);
    try {
      const TextureImage image = decode_texture(spoilt, "a.png");
      CHECK(!image.pixels.empty());
    } catch (const pliant::Error& error) {
      CHECK(contains(error.what(), "a.png"));
    }
  }
}

TEST_CASE("a body whose texture has gone has its plain color, and it is told why") {
  TexturedStudio studio;
  if (!studio.draw_with({.texture = studio.file})) return;
  std::filesystem::remove(studio.file);
  CHECK(seen(*studio.draw_with({.front = gray, .texture = studio.file}), 0.25, 0.75) == 'w');
  RenderMesh render_mesh = make_render_mesh(studio.bodies);
  render_mesh.looks = body_looks(studio.bodies, {{BodyId{0}, {.texture = studio.file}}});
  CHECK(contains(PictureMaker(std::move(render_mesh), studio.options).texture_error(), "quarters.png"));
}

TEST_CASE("what colors tell does not depend on the finish or the weave") {
  TexturedStudio studio;
  studio.options.appearance.color = pliant::ColorBy::speed;
  studio.options.appearance.camera.position = pliant::Vec3(0, -0.06, 0);
  studio.frame.values.assign(81, 0.5F);
  const std::optional<Image> matte = studio.draw_with({.finish = Finish::matte, .weave = 0.0});
  if (!matte) return;
  CHECK(difference(*matte, *studio.draw_with({.finish = Finish::metal, .weave = 1e-3})) == 0);
}

TEST_CASE("a surface that is drawn smoother is rounder, keeps its texture, and has the wireframe that it had") {
  TexturedStudio studio;
  for (std::size_t i = 0; i < studio.frame.positions.size(); ++i) {  // pleats
    Vec3f& p = studio.frame.positions[i];
    p.y() = 0.1F * static_cast<float>(i % 9 % 2);
  }
  const BodyAppearance appearance{.texture = studio.file};
  const std::optional<Image> coarse = studio.draw_with(appearance);
  if (!coarse) return;
  studio.options.appearance.subdivision = 2;
  const std::optional<Image> fine = studio.draw_with(appearance);
  CHECK(difference(*coarse, *fine) > 0.01);
  CHECK(seen(*fine, 0.3, 0.7) == 'r');
  CHECK(seen(*fine, 0.7, 0.7) == 'g');
  CHECK(seen(*fine, 0.3, 0.3) == 'b');
  studio.options.appearance.wireframe = true;
  const std::optional<Image> lines = studio.draw_with(appearance);
  CHECK(difference(*lines, *fine) > 0.02);
  CHECK(difference(*lines, *fine) < 0.5);  // not four times as many
}

TEST_CASE("stripes are as straight on a surface that is drawn smoother, wherever its diagonals lie") {
  TexturedStudio studio;
  studio.bodies[0].mesh.triangles =
      pliant::grid({.columns = 9, .rows = 9, .diagonals = pliant::Diagonals::alternating}).triangles;
  const BodyAppearance appearance{.front = gray, .pattern = pliant::Pattern::stripes, .pattern_size = 0.23};
  const std::optional<Image> coarse = studio.draw_with(appearance);
  if (!coarse) return;
  CHECK(difference(*coarse, *studio.draw_with({.front = gray})) > 0.05);
  studio.options.appearance.subdivision = 2;
  CHECK(difference(*coarse, *studio.draw_with(appearance)) < 1e-3);
}

}  // namespace test_textures
