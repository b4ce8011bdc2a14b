#include "pliant_io/export/detail/gltf_document.h"

#include <bit>
#include <limits>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/version.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/base64.h"

namespace pliant {
namespace {

static_assert(std::endian::native == std::endian::little, "buffers are written as they lie in memory");

std::string gltf_text(const nlohmann::ordered_json& json) {
  // Names may hold bytes that are not UTF-8; they must not cost the file.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void append_word(std::string& bytes, std::uint32_t word) {
  bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

/// A chunk of a binary file (Sec. 4.4.3); `filler` makes its size a multiple of 4.
void write_chunk(AtomicFile& file, std::string_view type, std::string_view data, char filler) {
  const std::size_t padding = (4 - data.size() % 4) % 4;
  std::string head;
  append_word(head, static_cast<std::uint32_t>(data.size() + padding));
  head += type;
  file.write(head);
  file.write(data);
  file.write(std::string(padding, filler));
}

}  // namespace

GltfDocument::GltfDocument() {
  json_["asset"] = {{"version", "2.0"}, {"generator", fmt::format("pliant {}", version)}};
  json_["scene"] = 0;
  json_["scenes"] = {{{"nodes", Json::array()}}};
}

std::size_t GltfDocument::add(const char* list, Json item) {
  json_[list].push_back(std::move(item));
  return json_[list].size() - 1;
}

std::size_t GltfDocument::add_vectors(const std::vector<Vector>& vectors, bool has_bounds) {
  Json accessor = accessor_of(vectors.data(), vectors.size() * sizeof(Vector), Target::vertices);
  describe(accessor, ComponentType::single, vectors.size(), "VEC3");
  if (has_bounds) {
    Vector low = vectors.front();
    Vector high = vectors.front();
    for (const Vector& v : vectors) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    accessor["min"] = {low[0], low[1], low[2]};
    accessor["max"] = {high[0], high[1], high[2]};
  }
  return add("accessors", std::move(accessor));
}

std::size_t GltfDocument::add_texture_coordinates(const std::vector<std::array<float, 2>>& pairs) {
  Json accessor = accessor_of(pairs.data(), pairs.size() * sizeof(pairs[0]), Target::vertices);
  describe(accessor, ComponentType::single, pairs.size(), "VEC2");
  return add("accessors", std::move(accessor));
}

std::size_t GltfDocument::add_indices(const std::vector<Index>& indices) {
  Json accessor = accessor_of(indices.data(), indices.size() * sizeof(Index), Target::indices);
  describe(accessor, ComponentType::unsigned_int, indices.size(), "SCALAR");
  return add("accessors", std::move(accessor));
}

std::size_t GltfDocument::add_times(const std::vector<float>& times) {
  Json accessor = accessor_of(times.data(), times.size() * sizeof(float), Target::none);
  describe(accessor, ComponentType::single, times.size(), "SCALAR");
  accessor["min"] = {times.front()};
  accessor["max"] = {times.back()};
  return add("accessors", std::move(accessor));
}

std::size_t GltfDocument::add_scalars(const std::vector<float>& numbers) {
  Json accessor = accessor_of(numbers.data(), numbers.size() * sizeof(float), Target::none);
  describe(accessor, ComponentType::single, numbers.size(), "SCALAR");
  return add("accessors", std::move(accessor));
}

std::size_t GltfDocument::add_numbers(const std::vector<Vector>& vectors) {
  Json accessor = accessor_of(vectors.data(), vectors.size() * sizeof(Vector), Target::none);
  describe(accessor, ComponentType::single, vectors.size(), "VEC3");
  return add("accessors", std::move(accessor));
}

std::size_t GltfDocument::add_numbers(const std::vector<std::array<float, 4>>& vectors) {
  Json accessor = accessor_of(vectors.data(), vectors.size() * sizeof(vectors[0]), Target::none);
  describe(accessor, ComponentType::single, vectors.size(), "VEC4");
  return add("accessors", std::move(accessor));
}

std::size_t GltfDocument::add_texture(const SurfaceImage& image) {
  if (!json_.contains("samplers")) {
    enum { linear = 9729, linear_between_mipmaps = 9987, repeat = 10497 };  // Sec. 5.26
    add("samplers",
        {{"magFilter", +linear}, {"minFilter", +linear_between_mipmaps}, {"wrapS", +repeat}, {"wrapT", +repeat}});
  }
  const std::size_t view = add_bytes(image.bytes.data(), image.bytes.size(), Target::none);
  buffer_.resize((buffer_.size() + 3) / 4 * 4);  // numbers follow
  const bool is_png = image.format == SurfaceImage::Format::png;
  const std::size_t source =
      add("images", {{"name", image.name}, {"mimeType", is_png ? "image/png" : "image/jpeg"}, {"bufferView", view}});
  return add("textures", {{"sampler", 0}, {"source", source}});
}

void GltfDocument::write_text(const std::filesystem::path& path) {
  add("buffers", {{"byteLength", buffer_.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer_)}});
  AtomicFile file(path);
  file.write(gltf_text(json_) + '\n');
  file.commit();
}

void GltfDocument::write_binary(const std::filesystem::path& path) {
  add("buffers", {{"byteLength", buffer_.size()}});
  AtomicFile file(path);
  const std::string json = gltf_text(json_);
  constexpr std::size_t heads = 12 + 8 + 8;
  const std::size_t size = heads + (json.size() + 3) / 4 * 4 + (buffer_.size() + 3) / 4 * 4;
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    fail_input(fmt::format("{}: {} bytes are past the 4 GiB of a GLB file; reduce --max-keyframes, or write USD",
                           path.string(), size));
  }
  std::string head = "glTF";
  append_word(head, 2);
  append_word(head, static_cast<std::uint32_t>(size));
  file.write(head);
  write_chunk(file, "JSON", json, ' ');
  write_chunk(file, std::string_view("BIN\0", 4), buffer_, '\0');
  file.commit();
}

std::size_t GltfDocument::add_bytes(const void* data, std::size_t size, Target target) {
  Json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}};
  if (target != Target::none) view["target"] = static_cast<int>(target);
  buffer_.append(static_cast<const char*>(data), size);
  return add("bufferViews", std::move(view));
}

GltfDocument::Json GltfDocument::accessor_of(const void* data, std::size_t size, Target target) {
  return {{"bufferView", add_bytes(data, size, target)}};
}

void GltfDocument::describe(Json& accessor, ComponentType component, std::size_t count, const char* type) {
  accessor["componentType"] = static_cast<int>(component);
  accessor["count"] = count;
  accessor["type"] = type;
}

}  // namespace pliant
