// Frames on disk, read back by code of the test's own.
#include <cstring>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/recorder/frame_writer.h"
#include "tests/support/temporary_folder.h"

namespace test_frame_writer {

namespace {

using namespace pliant;
using pliant_tests::TemporaryFolder;

Positions frame(Index vertices, Real first) {
  Positions positions(vertices, 3);
  for (Index i = 0; i < positions.size(); ++i) positions.data()[i] = first + i / 7.0;
  return positions;
}

std::string header_of(const std::string& file) {
  REQUIRE(file.size() >= 128);
  return file.substr(10, 118);
}

TEST_CASE("an npy file byte for byte") {
  const TemporaryFolder folder;
  const auto writer = make_npy_writer(folder.path(), 5);
  const auto read = [&] { return TemporaryFolder::read(folder.path() / "frames.npy"); };
  const std::string expected_start("\x93NUMPY\x01\x00\x76\x00", 10);

  // It is whole at any moment, before the first frame too.
  CHECK(read().size() == 128);
  CHECK(header_of(read()).starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (0, 5, 3), }   "));

  for (int i = 0; i < 12; ++i) writer->add(frame(5, i));
  const std::string file = read();
  CHECK(file.substr(0, 10) == expected_start);
  CHECK(header_of(file).starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (12, 5, 3), }   "));
  CHECK(file[127] == '\n');
  REQUIRE(file.size() == 128 + 12 * 5 * 3 * 8);
  for (std::size_t i = 0; i < 12; ++i) {
    Positions found(5, 3);
    std::memcpy(found.data(), file.data() + 128 + i * 120, 120);
    CHECK(found == frame(5, static_cast<Real>(i)));
  }
}

TEST_CASE("a frame of another size is refused and leaves the file whole") {
  const TemporaryFolder folder;
  const auto writer = make_npy_writer(folder.path(), 2);
  writer->add(frame(2, 1));
  CHECK_THROWS_WITH_AS(writer->add(frame(3, 1)), doctest::Contains("3 vertices among frames of 2"), Error);
  CHECK(TemporaryFolder::read(folder.path() / "frames.npy").size() == 128 + 48);
}

TEST_CASE("an npy file that cannot be made is an output error") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("file", "");
  for (const std::filesystem::path& place : {folder.path() / "none" / "such", file}) {
    CHECK_THROWS_WITH_AS(make_npy_writer(place, 2), doctest::Contains("frames.npy: cannot be written: "), Error);
  }
}

TEST_CASE("OBJ frames of one body keep its polygons") {
  const TemporaryFolder folder;
  const auto file = folder.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng face\nf 1 2 3 4\n");
  const std::vector<Body> bodies = {{"quad", read_mesh(file), 0}};
  const auto writer = make_obj_writer(folder.path(), bodies);
  writer->add(frame(4, 0));
  writer->add(frame(4, 1));
  const Mesh second = read_mesh(folder.path() / "frame_00001.obj");
  CHECK(second.vertices == frame(4, 1));
  CHECK(second.faces.face_count() == 1);
  CHECK(second.groups.at(0).name == "face");
}

TEST_CASE("OBJ frames of several bodies are one file with an object each") {
  const TemporaryFolder folder;
  std::vector<Body> bodies = {{"sheet", grid({.columns = 3, .rows = 2}), 0},
                              {"bar", bar({.cells = {1, 1, 1}}), 6},
                              {"rope", chain({.links = 2}), 14}};
  const auto writer = make_obj_writer(folder.path(), bodies);
  writer->add(frame(17, 3));
  const Mesh all = read_mesh(folder.path() / "frame_00000.obj");
  CHECK(all.vertices == frame(17, 3));
  CHECK(all.triangles.size() == 4 + 12);
  CHECK(all.edges == std::vector<Edge>{{14, 15}, {15, 16}});
  REQUIRE(all.groups.size() == 2);  // a group without faces is not written
  CHECK(all.groups[0].name == "sheet");
  CHECK(all.groups[1].name == "bar");
  CHECK(all.groups[1].kind == FaceGroupKind::object);
  for (const Index face : all.groups[1].faces) {
    const Index first_corner = all.faces.offsets[static_cast<std::size_t>(face)];
    CHECK(all.faces.vertices[static_cast<std::size_t>(first_corner)] >= 6);
  }
}

}  // namespace

}  // namespace test_frame_writer
