#pragma once
// The text of a scene, to be changed and written again: what it includes and what was set over it stand in it, so that
// one file has all of it but its meshes, maps and motions.
//
//     SceneDocument document(scene);
//     document.set("settings.iterations", "40");
//     document.set(scene.places.at("skin") + ".stiffness", "800");
//     write_file_atomically("mine/curtain.json", document.text("mine"));
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "pliant_io/scene/scene.h"

namespace pliant {

class SceneDocument {
 public:
  /// Of a scene that was read, as it was read: nothing that was changed since is in it. Names of files are absolute.
  /// @throws Error (input) where the name of a file is not UTF-8.
  explicit SceneDocument(const Scene& scene);
  ~SceneDocument();
  SceneDocument(const SceneDocument& other);
  SceneDocument(SceneDocument&&) noexcept;
  SceneDocument& operator=(SceneDocument other) noexcept;

  // Paths are as those of SceneOverrides::set, "bodies[0].constraints[bend].stiffness"; Scene::places has some. Values
  // are JSON. A path that leads nowhere and a value that is not JSON throw Error(input).

  /// The value there; "" where there is none.
  std::string get(std::string_view path) const;
  /// Puts a value there; objects that are missing on the way are made.
  void set(std::string_view path, std::string_view value);
  /// Puts a value behind the last one of a list, which is made where it is missing.
  void append(std::string_view path, std::string_view value);
  /// Takes out a key with its value, or an entry of a list by its index; does nothing where there is none.
  void remove(std::string_view path);

  /// As a scene file, laid out to be read. Files in this folder or below it are named from there, others by their
  /// whole paths; without a folder all are.
  std::string text(const std::filesystem::path& folder = {}) const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace pliant
