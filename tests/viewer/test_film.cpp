// Films of what a window shows: which moments become pictures, and the thread that writes them.
#include <thread>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "tests/support/temporary_folder.h"
#include "viewer/film_clock.h"
#include "viewer/film_thread.h"
#include "viewer/free_name.h"
#include "viewer/live_scene.h"
#include "viewer/playback.h"

namespace test_film {

using namespace pliant_viewer;
using pliant_tests::TemporaryFolder;

namespace {

pliant_render::Image gray(std::uint8_t shade) {
  return {4, 2, std::vector<std::uint8_t>(24, shade)};
}

pliant::Scene make_scene() {
  return pliant::parse_scene(R"({ "pliant": 1, "settings": { "time_step": 0.01 }, "bodies": [ {
    "name": "sheet", "mesh": { "shape": "grid", "columns": 4, "rows": 4 }, "mass": { "total": 1 } } ] })",
                             {}, "sheet");
}

void wait_until(const std::function<bool()>& is_so) {
  while (!is_so()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

TEST_CASE("each moment becomes as many pictures as its time asks for") {
  FilmClock clock(50);
  CHECK(clock.take_due(3, 1, 0) == 1);  // from wherever it begins
  CHECK(clock.take_due(3, 1, 0) == 0);  // it stands still
  CHECK(clock.take_due(3.01, 1, 0) == 0);
  CHECK(clock.is_due(3.02, 0));
  CHECK(clock.take_due(3.02, 1, 0) == 1);
  CHECK(clock.next_time() == doctest::Approx(3.04));
  CHECK(clock.take_due(3.1, 1, 0) == 4);      // nothing was shown in between
  CHECK(clock.take_due(3.12, 0.25, 0) == 1);  // slow motion, from here on
  CHECK(clock.take_due(3.125, 0.25, 0) == 1);
  CHECK(clock.take_due(3.14, 0.25, 0) == 3);
  CHECK(clock.pictures() == 11);
  CHECK(clock.length() == doctest::Approx(0.22));
}

TEST_CASE("sums of time steps lose no picture") {
  FilmClock clock(30);
  double time = 0;
  for (int step = 0; step < 60'000; ++step, time += 1.0 / 60) {
    const int due = clock.take_due(time, 1, 0);
    REQUIRE(due == (step % 2 == 0 ? 1 : 0));
  }
}

TEST_CASE("a cut goes on at once, forward or backward") {
  FilmClock clock(50);
  clock.take_due(1, 1, 0);
  CHECK(clock.take_due(0, 1, 1) == 1);
  CHECK(clock.take_due(0.005, 1, 1) == 0);
  CHECK(clock.take_due(8, 1, 2) == 1);
  CHECK(clock.next_time() == doctest::Approx(8.02));
}

TEST_CASE("pictures are written in their order, and as often as asked") {
  const TemporaryFolder folder;
  FilmThread film({.out = folder.path() / "sheet-1.png", .width = 4, .height = 2, .fps = 30, .frame_count = 100});
  for (std::uint8_t shade = 0; shade < 20; ++shade) film.add(gray(shade), shade == 3 ? 4 : 1);
  film.end();
  film.add(gray(99), 1);  // too late
  const std::string written = film.wait();
  CHECK(written.ends_with("sheet-1-0022.png"));
  CHECK(folder.file_count() == 23);
  for (int i = 0; i < 23; ++i) {
    const int shade = i < 3 ? i : i < 7 ? 3 : i - 3;
    const TemporaryFolder other;
    pliant_render::write_png(other.path() / "x.png", gray(static_cast<std::uint8_t>(shade)));
    CHECK(TemporaryFolder::read(folder.path() / fmt::format("sheet-1-{:04}.png", i)) ==
          TemporaryFolder::read(other.path() / "x.png"));
  }
}

TEST_CASE("a film that is left is completed, and one without pictures leaves nothing") {
  const TemporaryFolder folder;
  {
    FilmThread film({.out = folder.path() / "left.mp4", .width = 4, .height = 2, .fps = 30, .frame_count = 100});
    if (!film.hint().empty()) return;  // no ffmpeg
    for (int i = 0; i < 10; ++i) film.add(gray(100), 1);
  }
  CHECK(TemporaryFolder::read(folder.path() / "left.mp4").substr(4, 4) == "ftyp");
  FilmThread empty({.out = folder.path() / "empty.mp4", .width = 4, .height = 2, .fps = 30, .frame_count = 100});
  empty.end();
  CHECK(empty.wait().empty());
  CHECK(folder.file_count() == 1);
}

TEST_CASE("what cannot be written ends the film with its reason, and holds nobody up") {
  const TemporaryFolder folder;
  FilmThread film({.out = folder.path() / "gone" / "x.png", .width = 4, .height = 2, .fps = 30, .frame_count = 100});
  for (int i = 0; i < 100; ++i) film.add(gray(1), 1);
  CHECK(film.is_over());
  CHECK_THROWS_AS(film.wait(), pliant::Error);
}

TEST_CASE("names of films leave what is there alone, pictures of an earlier one too") {
  const TemporaryFolder folder;
  folder.write("sheet-1.mp4", "");
  folder.write("sheet-2-00000.png", "");
  CHECK(free_name(folder.path(), "scenes/sheet", {".mp4", "-00000.png"}) == folder.path() / "sheet-3.mp4");
  CHECK(free_name(folder.path(), "", {".svg"}, "plot") == folder.path() / "scene-plot-1.svg");
}

TEST_CASE("a simulation that is held stops at that time, takes single steps, and goes on") {
  LiveScene live(make_scene, 1, false, [] {});
  live.hold_at(0.2 - 1e-7);
  live.post([](CommandContext& context) { context.pacer.set_speed(Pacer::unlimited); });
  live.post([](CommandContext& context) { context.is_playing = true; });
  wait_until([&] { return live.newest().step == 20; });
  const auto step_after = [&](const LiveScene::Command& command) {
    const std::uint64_t number = live.post(command);
    wait_until([&] { return live.newest().commands >= number; });
    return live.shown().step;
  };
  for (int i = 0; i < 5; ++i) CHECK(step_after([](CommandContext&) {}) == 20);
  CHECK(live.shown().is_playing);
  live.post([](CommandContext& context) { context.single_steps = 1; });
  wait_until([&] { return live.newest().step == 21; });
  CHECK(step_after([](CommandContext&) {}) == 21);
  live.hold_at(0.3 - 1e-7);
  wait_until([&] { return live.newest().step == 30; });
  live.hold_at(std::numeric_limits<double>::infinity());
  wait_until([&] { return live.newest().step > 100; });
}

TEST_CASE("a run that is held waits at the first frame behind that time, and ends and loops as ever") {
  const pliant::Mesh mesh = pliant::grid({.columns = 3, .rows = 3});
  const std::vector<pliant::Positions> frames(5, mesh.vertices);
  Playback run(pliant_render::RunFrames(
                   pliant::animate(mesh, "run", pliant::PointCache::from_frames(frames, {0, 1000, 2000, 3000, 4000}))),
               {}, true);
  const Clock::time_point start = Clock::now();
  const auto time_after = [&](double seconds) {
    run.refresh(start + std::chrono::duration_cast<Clock::duration>(Seconds(seconds)));
    return run.frame().time;
  };
  time_after(0);
  run.hold_at(1500);
  CHECK(time_after(100'000) == 2000);
  run.hold_at(2500);
  CHECK(time_after(200'000) == 3000);
  const std::uint64_t cuts = run.cuts();
  run.hold_at(4500);  // no frame is behind that: it loops
  CHECK(time_after(300'000) == 0);
  CHECK(run.cuts() == cuts + 1);
  run.hold_at({});
  CHECK(time_after(2500) > 0);
}

}  // namespace test_film
