#pragma once
// The JSON of a glTF file and the one buffer that its accessors and images refer to (glTF 2.0; section numbers are its
// own).
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "pliant/core/types.h"
#include "pliant_io/export/export.h"

namespace pliant {

class GltfDocument {
 public:
  using Json = nlohmann::ordered_json;
  using Vector = Eigen::Vector3f;

  GltfDocument();

  Json& operator[](const char* key) { return json_[key]; }

  /// Appends to a list of the document; returns the index there, as all that follow do of accessors.
  std::size_t add(const char* list, Json item);

  std::size_t add_vectors(const std::vector<Vector>& vectors, bool has_bounds);
  std::size_t add_texture_coordinates(const std::vector<std::array<float, 2>>& pairs);
  std::size_t add_indices(const std::vector<Index>& indices);
  std::size_t add_times(const std::vector<float>& times);
  std::size_t add_scalars(const std::vector<float>& numbers);
  /// Vectors that are not those of vertices, as an animation has them.
  std::size_t add_numbers(const std::vector<Vector>& vectors);
  std::size_t add_numbers(const std::vector<std::array<float, 4>>& vectors);

  /// A texture of its own, whose picture lies in the buffer and is repeated in both directions.
  std::size_t add_texture(const SurfaceImage& image);

  /// Writes the file, as text with its buffer in it or as a binary file. To be called once, last.
  /// @throws Error (output): it cannot be written; Error (input): it is too large for a binary file.
  void write_text(const std::filesystem::path& path);
  void write_binary(const std::filesystem::path& path);

 private:
  /// Numbers that the specification gives to what they name (Sec. 5.1.3, 5.11.5).
  enum class ComponentType { unsigned_int = 5125, single = 5126 };
  enum class Target { none = 0, vertices = 34962, indices = 34963 };

  std::size_t add_bytes(const void* data, std::size_t size, Target target);
  /// An accessor of numbers of four bytes each.
  Json accessor_of(const void* data, std::size_t size, Target target);
  static void describe(Json& accessor, ComponentType component, std::size_t count, const char* type);

  Json json_;
  std::string buffer_;
};

}  // namespace pliant
