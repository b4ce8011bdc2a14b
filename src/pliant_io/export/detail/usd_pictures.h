#pragma once
// What surfaces of USD look like: materials of UsdPreviewSurface, and the files of their pictures.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pliant_io/export/detail/usd_text.h"
#include "pliant_io/export/export.h"
#include "pliant_io/files/atomic_folder.h"

namespace pliant {

/// The files of pictures that an .usda refers to, in usd_folder(), each once.
class UsdPictures {
 public:
  /// path: of the .usda
  explicit UsdPictures(const std::filesystem::path& path) : path_(path) {}

  /// What the text of the .usda calls the file of that picture.
  /// @throws Error (input): the name of the .usda cannot stand in a reference.
  std::string reference(const SurfaceImage& image);

  /// Writes all of them and gives the folder its name; without any there is none. To be called once, last.
  /// @throws Error (output): the folder cannot be written, or holds other files.
  void commit();

 private:
  std::filesystem::path path_;
  std::vector<const SurfaceImage*> images_;
};

/// A material with that front. `place` is the path of the prim that it is in, `picture` the reference to its image or
/// empty.
void write_usd_material(UsdText& text, const std::string& place, const SurfaceLook& look, const std::string& picture);
/// The path of that material.
std::string usd_material(const std::string& place);

}  // namespace pliant
