// ParaView's collection of frames, each a .vtu file.
#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/export/detail/export_formats.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/atomic_folder.h"
#include "pliant_io/mesh/detail/vtu_output.h"

namespace pliant {
namespace {

std::string vtu_frame_name(std::size_t frame) {
  return fmt::format("frame_{:05}.vtu", frame);
}

/// Whether vtu_frame_name() makes it.
bool is_vtu_frame(std::string_view name) {
  constexpr std::string_view head = "frame_", tail = ".vtu";
  if (name.size() < head.size() + 5 + tail.size() || !name.starts_with(head) || !name.ends_with(tail)) return false;
  return std::ranges::all_of(name.substr(head.size(), name.size() - head.size() - tail.size()),
                             [](char c) { return c >= '0' && c <= '9'; });
}

/// Which body each vertex is of.
std::vector<std::int32_t> body_numbers(const Animation& animation) {
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(animation.cache.vertex_count()), 0);
  for (std::size_t b = 0; b < animation.bodies.size(); ++b) {
    const Body& body = animation.bodies[b];
    std::fill_n(numbers.begin() + body.first_vertex, body.mesh.vertex_count(), static_cast<std::int32_t>(b));
  }
  return numbers;
}

void write_vtu_frames(const std::filesystem::path& folder, const Animation& animation,
                      const std::vector<std::size_t>& frames, const ExportOptions& options) {
  VtuCells cells;
  for (const Body& body : animation.bodies) cells.add(body.mesh, body.first_vertex);
  const std::string element = cells.element();
  const VtuArray bodies = vtu_array("body", 1, std::span<const std::int32_t>(body_numbers(animation)));
  Positions positions;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    animation.cache.sample(animation.times[frames[i]], positions);
    std::vector<VtuArray> arrays = {bodies};
    if (options.values) {
      for (const VertexValues& each : options.values(frames[i])) {
        arrays.push_back(vtu_array(each.name, each.components, std::span<const float>(each.numbers)));
      }
    }
    write_vtu_file(folder / vtu_frame_name(i), positions, {element, cells.count()}, arrays);
  }
}

}  // namespace

std::filesystem::path pvd_folder(const std::filesystem::path& path) {
  return path.parent_path() / (path.stem().string() + "_frames");
}

void write_pvd(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
               const ExportOptions& options) {
  const std::filesystem::path folder = pvd_folder(path);
  const std::string name = folder.filename().string();
  std::string attribute = xml_attribute_text(name);
  if (attribute.size() < name.size() || attribute.find('?') != attribute.npos) {
    fail_input("a name that XML cannot hold; give one of letters and digits");
  }
  AtomicFile file(path);
  AtomicFolder frame_folder(folder, is_vtu_frame);
  write_vtu_frames(frame_folder.temporary_path(), animation, frames, options);
  file.write(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    file.write(fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}/{}\"/>\n", animation.times[frames[i]],
                           attribute, vtu_frame_name(i)));
  }
  file.write("</Collection>\n</VTKFile>\n");
  frame_folder.commit();
  file.commit();
}

}  // namespace pliant
