#include "run_looks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "commands.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/recorder/run_files.h"
#include "pliant_io/scene/texture_file.h"
#include "render/body_looks.h"
#include "render/picture_places.h"
#include "render/render_mesh.h"
#include "render/texture_image.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;
using pliant::BodyAppearance;
using pliant::Color;
using pliant::SurfaceImage;
using pliant::SurfaceLook;

std::array<pliant::Real, 3> shares_of(const Color& color) {
  return {color.red, color.green, color.blue};
}

/// What a view gives of both; none where it gives neither.
std::optional<SurfaceLook> look_of_view(const pliant::ViewSettings& view) {
  if (!view.front && !view.back) return {};
  const pliant::BodyTones& plain = pliant::body_tones.front();
  return SurfaceLook{{shares_of(view.front.value_or(plain.front))}, {shares_of(view.back.value_or(plain.back))}};
}

pliant::SurfaceFinish surface_finish(pliant::Finish finish) {
  switch (finish) {
    case pliant::Finish::cloth:
      return {false, 0.9};
    case pliant::Finish::glossy:
      return {false, 0.35};
    case pliant::Finish::metal:
      return {true, 0.35};
    case pliant::Finish::automatic:
    case pliant::Finish::matte:
      break;
  }
  return {false, 0.8};
}

void warn_of_texture(const std::string& body, std::string_view reason) {
  print_to_stderr(fmt::format("warning: {}: its texture is left out, and it has plain colors: {}\n",
                              pliant::printable(body), pliant::printable_place(reason, message_limit)));
}

/// A texture's file with the size of its picture.
struct TextureFile {
  std::shared_ptr<const SurfaceImage> image;
  std::array<int, 2> size{};  ///< [pixels]
};

/// @throws pliant::Error (input)
TextureFile read_texture(const std::string& path) {
  std::string bytes = pliant::read_texture_file(path);
  const std::array<int, 2> size = pliant_render::texture_size(bytes, path);
  const bool is_png = pliant::texture_format(bytes) == pliant::TextureFormat::png;
  const auto format = is_png ? SurfaceImage::Format::png : SurfaceImage::Format::jpeg;
  return {std::make_shared<SurfaceImage>(SurfaceImage{fs::path(path).stem().string(), format, std::move(bytes)}), size};
}

/// The same as a picture on this color, where it is transparent; other programs would show what lies under that.
/// @throws pliant::Error (input)
std::shared_ptr<const SurfaceImage> opaque(const std::shared_ptr<const SurfaceImage>& image, const Color& base) {
  if (image->format != SurfaceImage::Format::png) return image;
  const pliant_render::TextureImage seen = pliant_render::decode_texture(image->bytes, image->name);
  pliant_render::Image flat{seen.width, seen.height, {}};
  bool is_opaque = true;
  const std::array<pliant::Real, 3> shares = shares_of(base);
  for (std::size_t i = 0; i + 3 < seen.pixels.size(); i += 4) {
    const pliant::Real alpha = seen.pixels[i + 3] / 255.0;
    is_opaque = is_opaque && seen.pixels[i + 3] == 255;
    for (std::size_t k = 0; k < 3; ++k) {
      flat.pixels.push_back(
          static_cast<std::uint8_t>(std::lround(alpha * seen.pixels[i + k] + (1 - alpha) * 255 * shares[k])));
    }
  }
  if (is_opaque) return image;
  return std::make_shared<SurfaceImage>(SurfaceImage{image->name, SurfaceImage::Format::png, encode_png(flat)});
}

/// The looks of one body after the other; pictures are shared.
class LookMaker {
 public:
  explicit LookMaker(const pliant::Scene& scene) : scene_(scene) {}

  /// `mesh` is that of the body as it is exported.
  SurfaceLook look(pliant::BodyId id, const BodyAppearance& appearance, pliant::Mesh& mesh) {
    const auto number = static_cast<std::size_t>(id);
    const pliant::Body& body = scene_.simulation.body(id);
    const pliant::BodyTones& tones = pliant_render::open_tones(number);
    const Color front = appearance.front.value_or(tones.front);
    const Color back = appearance.back.value_or(appearance.front ? front : tones.back);
    SurfaceLook look{{shares_of(front)}, {shares_of(back)}};
    look.finish = surface_finish(finish(id, appearance));
    if (mesh.faces.face_count() == 0 || mesh.vertex_count() != body.mesh.vertex_count()) return look;
    std::array<int, 2> size{};
    if (!appearance.texture.empty()) {
      const TextureFile* const texture = texture_of(body.name, appearance.texture);
      if (texture == nullptr) return look;
      size = texture->size;
      look.front.image = opaque_of(*texture, appearance.texture, front);
      if (!appearance.back) look.back.image = look.front.image;
    } else if (appearance.pattern != pliant::Pattern::none) {
      look.front.image = pattern_of(appearance.pattern, front, appearance.pattern_color);
      look.back.image = pattern_of(appearance.pattern, back, appearance.pattern_color);
    } else {
      return look;
    }
    pliant_render::lay_picture(mesh, body.mesh.vertices, appearance, size);
    return look;
  }

  /// The files that were read.
  std::vector<fs::path> textures() const {
    std::vector<fs::path> paths;
    for (const auto& [path, texture] : textures_) paths.emplace_back(path);
    return paths;
  }

 private:
  pliant::Finish finish(pliant::BodyId id, const BodyAppearance& appearance) const {
    const pliant::Mesh& mesh = scene_.simulation.body(id).mesh;
    const auto material = scene_.materials.find(id);
    return pliant_render::finish_of(appearance,
                                    material == scene_.materials.end() ? std::string() : material->second.name,
                                    !mesh.triangles.empty() && mesh.tetrahedra.empty());
  }

  /// Null, after a warning, where it cannot be read.
  const TextureFile* texture_of(const std::string& body, const std::string& path) {
    const auto known = textures_.find(path);
    if (known != textures_.end()) return &known->second;
    try {
      return &textures_.emplace(path, read_texture(path)).first->second;
    } catch (const pliant::Error& error) {
      if (error.kind() != pliant::ErrorKind::input) throw;
      warn_of_texture(body, error.what());
      return nullptr;
    }
  }

  std::shared_ptr<const SurfaceImage> opaque_of(const TextureFile& texture, const std::string& path,
                                                const Color& base) {
    std::shared_ptr<const SurfaceImage>& image = opaque_[{path, shares_of(base)}];
    if (!image) image = opaque(texture.image, base);
    return image;
  }

  std::shared_ptr<const SurfaceImage> pattern_of(pliant::Pattern pattern, const Color& base, const Color& second) {
    std::shared_ptr<const SurfaceImage>& image = patterns_[{pattern, shares_of(base), shares_of(second)}];
    if (!image) {
      image = std::make_shared<SurfaceImage>(
          SurfaceImage{std::string(choice_names(pattern)[static_cast<std::size_t>(pattern)]), SurfaceImage::Format::png,
                       encode_png(pliant_render::pattern_image(pattern, base, second))});
    }
    return image;
  }

  using Shares = std::array<pliant::Real, 3>;
  const pliant::Scene& scene_;
  std::map<std::string, TextureFile> textures_;
  std::map<std::pair<std::string, Shares>, std::shared_ptr<const SurfaceImage>> opaque_;
  std::map<std::tuple<pliant::Pattern, Shares, Shares>, std::shared_ptr<const SurfaceImage>> patterns_;
};

}  // namespace

bool mentions(const pliant::SceneSource& source, std::string_view word) {
  const auto has_word = [&](const std::string& text) { return text.find(word) != text.npos; };
  return std::ranges::any_of(source.texts, has_word, &pliant::SceneText::text) ||
         std::ranges::any_of(source.overrides.set, has_word);
}

RunLooks looks_of_scene(const pliant::Scene& scene, pliant::Animation& animation) {
  RunLooks looks;
  looks.of_bodies.assign(animation.bodies.size(), look_of_view(scene.view));
  LookMaker maker(scene);
  for (const auto& [id, appearance] : scene.appearances) {
    const pliant::Body& body = scene.simulation.body(id);
    const auto found = std::ranges::find(animation.bodies, body.name, &pliant::Body::name);
    if (found == animation.bodies.end()) continue;
    looks.of_bodies[static_cast<std::size_t>(found - animation.bodies.begin())] =
        maker.look(id, appearance, found->mesh);
  }
  looks.textures = maker.textures();
  for (const auto& [name, appearance] : scene.collider_appearances) {
    const pliant_render::ColliderLook seen = pliant_render::collider_look(appearance);
    const pliant::SurfaceSide side{{seen.tone.x(), seen.tone.y(), seen.tone.z()}};
    looks.of_colliders.emplace(name, SurfaceLook{side, side, surface_finish(seen.finish)});
  }
  return looks;
}

RunLooks looks_of_run(const fs::path& folder, pliant::Animation& animation) {
  const fs::path checkpoint = folder / pliant::checkpoint_name;
  std::error_code ignored;
  RunLooks looks;
  if (!fs::exists(checkpoint, ignored)) return looks;
  try {
    pliant::Scene known = pliant::read_checkpoint(checkpoint);
    looks.of_bodies.assign(animation.bodies.size(), look_of_view(known.view));
    if (!mentions(known.source, "appearance")) return looks;
    const pliant::ViewSettings view = known.view;
    pliant::Scene scene = pliant::parse_scene(std::move(known.source));
    scene.view = view;
    looks = looks_of_scene(scene, animation);
  } catch (const pliant::Error& error) {
    if (error.kind() != pliant::ErrorKind::input) throw;
    print_to_stderr("warning: the colors that the scene gives its bodies and colliders are not known: " +
                    pliant::printable_place(error.what(), message_limit) + "\n");
  }
  return looks;
}

}  // namespace pliant_cli
