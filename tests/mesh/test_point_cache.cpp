// Point caches, from bytes put together here.
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant_io/mesh/point_cache_format.h"
#include "tests/support/temporary_folder.h"

namespace test_point_cache {

namespace {

using namespace pliant;
using pliant_tests::TemporaryFolder;

template <typename Number>
std::string little(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

template <typename Number>
std::string big(Number number) {
  const std::string bytes = little(number);
  return {bytes.rbegin(), bytes.rend()};
}

/// Coordinate `axis` of a vertex in a frame: exact in single precision.
Real coordinate(int frame, int vertex, int axis) {
  return 100 * frame + 8 * vertex + axis + 0.25;
}

std::string pc2(std::int32_t vertices, std::int32_t frames, float start = 0, float rate = 1) {
  std::string bytes("POINTCACHE2\0", 12);
  bytes += little(std::int32_t{1}) + little(vertices) + little(start) + little(rate) + little(frames);
  for (int f = 0; f < frames; ++f) {
    for (int i = 0; i < 3 * vertices; ++i) bytes += little(static_cast<float>(coordinate(f, i / 3, i % 3)));
  }
  return bytes;
}

std::string mdd(std::int32_t vertices, const std::vector<float>& times) {
  std::string bytes = big(static_cast<std::int32_t>(times.size())) + big(vertices);
  for (const float time : times) bytes += big(time);
  for (int f = 0; f < static_cast<int>(times.size()); ++f) {
    for (int i = 0; i < 3 * vertices; ++i) bytes += big(static_cast<float>(coordinate(f, i / 3, i % 3)));
  }
  return bytes;
}

template <typename Number>
std::string npy(int vertices, int frames, const std::string& dictionary) {
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += little(static_cast<std::uint16_t>(dictionary.size())) + dictionary;
  for (int f = 0; f < frames; ++f) {
    for (int i = 0; i < 3 * vertices; ++i) bytes += little(static_cast<Number>(coordinate(f, i / 3, i % 3)));
  }
  return bytes;
}

PointCacheFormat format(const std::string& name) {
  return point_cache_format("a." + name).value();
}

void check_positions(const PointCache& cache, int vertices, int frames) {
  REQUIRE(cache.vertex_count() == vertices);
  REQUIRE(cache.frame_count() == frames);
  Positions whole;
  Positions sampled;
  for (int f = 0; f < frames; ++f) {
    cache.frame(f, whole);
    cache.sample(cache.time(f), sampled);
    for (int v = 0; v < vertices; ++v) {
      const Vec3 expected(coordinate(f, v, 0), coordinate(f, v, 1), coordinate(f, v, 2));
      CHECK(cache.position(f, v) == expected);
      CHECK(row(whole, v) == expected);
      CHECK(row(sampled, v) == expected);
    }
  }
}

TEST_CASE("PC2: positions, and times from start, rate and frames per second") {
  const PointCache cache = PointCache::parse(pc2(3, 4, 5, 0.5F), "a.pc2", format("pc2"), {.frames_per_second = 10});
  check_positions(cache, 3, 4);
  for (int f = 0; f < 4; ++f) CHECK(cache.time(f) == (5 + 0.5 * f) / 10);
  CHECK(PointCache::parse(pc2(1, 2), "a", format("pc2")).time(1) == 1.0 / 24);
}

TEST_CASE("MDD: positions and its own times") {
  const PointCache cache = PointCache::parse(mdd(2, {0.5F, 0.75F, 2}), "a.mdd", format("mdd"));
  check_positions(cache, 2, 3);
  CHECK(cache.time(0) == 0.5);
  CHECK(cache.time(1) == 0.75);
  CHECK(cache.time(2) == 2);
}

TEST_CASE("NPY: single and double precision") {
  const std::string both = "'fortran_order': False, 'shape': (3, 2, 3), }\n";
  check_positions(PointCache::parse(npy<double>(2, 3, "{'descr': '<f8', " + both), "a", format("npy")), 2, 3);
  check_positions(PointCache::parse(npy<float>(2, 3, "{'descr': '<f4', " + both), "a", format("npy")), 2, 3);
  const PointCache cache = PointCache::parse(npy<float>(2, 3, "{'shape':(3,2,3),'fortran_order':False,'descr':'<f4'}"),
                                             "a", format("npy"), {.frames_per_second = 2});
  check_positions(cache, 2, 3);
  CHECK(cache.time(2) == 1);
  Positions between;
  cache.sample(0.125, between);  // positions are linear in the frame
  CHECK(row(between, 1) == Vec3(25 + 8.25, 25 + 9.25, 25 + 10.25));
  cache.sample(-3, between);
  CHECK(row(between, 0) == cache.position(0, 0));
  cache.sample(1e9, between);
  CHECK(row(between, 0) == cache.position(2, 0));
}

TEST_CASE("files are read by their extension") {
  const TemporaryFolder folder;
  check_positions(PointCache::read(folder.write("a.PC2", pc2(2, 2))), 2, 2);
  check_positions(PointCache::read(folder.write("a.mdd", mdd(2, {0, 1}))), 2, 2);
  CHECK_THROWS_WITH_AS(PointCache::read(folder.write("a.abc", pc2(2, 2))), doctest::Contains("known: .pc2, .mdd, .npy"),
                       Error);
  CHECK_THROWS_WITH_AS(PointCache::read(folder.path() / "none.pc2"), doctest::Contains("no such file"), Error);
}

TEST_CASE("what a run was writing when it was cut off is passed over, but not in an MDD file") {
  check_positions(PointCache::parse(pc2(2, 3) + std::string(17, 'x'), "a", format("pc2")), 2, 3);
  CHECK_THROWS_AS(PointCache::parse(mdd(2, {0, 1}) + "x", "a", format("mdd")), Error);
}

TEST_CASE("a file cut anywhere is refused") {
  const std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 3), }";
  const std::array files = {pc2(2, 2), mdd(2, {0, 1}), npy<double>(2, 2, dictionary)};
  for (std::size_t format = 0; format < files.size(); ++format) {
    for (std::size_t size = 0; size < files[format].size(); ++size) {
      CAPTURE(size);
      CHECK_THROWS_AS(PointCache::parse(files[format].substr(0, size), "a", point_cache_formats()[format]), Error);
    }
  }
}

TEST_CASE("counts that do not fit, values that are not finite, times that do not rise") {
  const auto refuse = [](std::string bytes, const PointCacheFormat& format, const char* message) {
    CHECK_THROWS_WITH_AS(PointCache::parse(std::move(bytes), "a.bin", format), doctest::Contains(message), Error);
  };
  const auto with = [](std::string bytes, std::size_t place, const std::string& replacement) {
    return bytes.replace(place, replacement.size(), replacement);
  };
  constexpr auto largest = std::numeric_limits<std::int32_t>::max();
  constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
  for (const std::int32_t count : {-1, 0, largest, std::numeric_limits<std::int32_t>::min()}) {
    refuse(with(pc2(2, 2), 16, little(count)), format("pc2"), "a.bin: header");
    refuse(with(pc2(2, 2), 28, little(count)), format("pc2"), "a.bin: header");
    refuse(with(mdd(2, {0, 1}), 0, big(count)), format("mdd"), "a.bin: header");
    refuse(with(mdd(2, {0, 1}), 4, big(count)), format("mdd"), "a.bin: header");
  }
  refuse(with(pc2(2, 2), 12, little(std::int32_t{2})), format("pc2"), "version 2");
  refuse(with(pc2(2, 2), 32 + 24 + 12, little(not_a_number)), format("pc2"), "frame 1, vertex 1");
  refuse(pc2(2, 2, 0, 0), format("pc2"), "frame 1: its time");
  refuse(pc2(2, 2, not_a_number), format("pc2"), "frame 0: its time is not finite");
  refuse(mdd(2, {1, 1}), format("mdd"), "not after");
  refuse(mdd(2, {0, std::numeric_limits<float>::infinity()}), format("mdd"), "not finite");
  // So slow that there is no number for the time between the two frames.
  CHECK_THROWS_WITH_AS(PointCache::parse(pc2(2, 2, -1e38f, 2e38f), "a", format("pc2"), {1e-270}),
                       doctest::Contains("than numbers go; give"), Error);
  refuse("POINTCACHE", format("pc2"), "POINTCACHE2");
  for (const char* dictionary :
       {"{'descr': '>f8', 'fortran_order': False, 'shape': (2, 2, 3)}", "{'descr': '|O', 'fortran_order': False}",
        "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 2, 3)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 3, 1)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 4)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (-2, 2, 3)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999, 2, 3)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (4611686018427387904, 2, 3)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (", "{'descr'", ""}) {
    CAPTURE(dictionary);
    refuse(npy<double>(2, 2, dictionary), format("npy"), "a.bin: header");
  }
  CHECK_THROWS_AS(PointCache::parse(pc2(1, 1), "a", format("pc2"), {.frames_per_second = 0}), Error);
  CHECK_THROWS_AS(PointCache::parse(pc2(1, 1), "a", format("pc2"), {.frames_per_second = not_a_number}), Error);
}

TEST_CASE("frames that are there already, and other times") {
  const std::vector<Positions> frames = {Positions{{0, 0, 0}}, Positions{{1, 0, 0}}, Positions{{5, 0, 0}}};
  PointCache cache = PointCache::from_frames(frames, {0, 1, 3});
  Positions positions;
  cache.sample(2, positions);
  CHECK(row(positions, 0) == Vec3(3, 0, 0));
  cache.set_times({10, 20});
  CHECK(cache.frame_count() == 2);
  cache.sample(15, positions);
  CHECK(row(positions, 0) == Vec3(0.5, 0, 0));
  for (const std::vector<Real>& times : {std::vector<Real>{}, {1, 2, 3}, {1, 1}, {2, 1}}) {
    CHECK_THROWS_AS(cache.set_times(times), Error);
  }
  CHECK_THROWS_AS(PointCache::from_frames({}, {}), Error);
  CHECK_THROWS_AS(PointCache::from_frames(std::vector<Positions>{Positions(1, 3), Positions(2, 3)}, {0, 1}), Error);
}

}  // namespace

}  // namespace test_point_cache
