#include <doctest/doctest.h>

#include "viewer/panels/tour.h"

namespace test_tour {

using namespace pliant_viewer;

TourSight sight() {
  pliant_render::Viewpoint viewpoint;
  viewpoint.eye = {0, -3, 1};
  return {.undone_next = "pin", .camera = OrbitCamera(viewpoint, Vec3f::UnitZ())};
}

TEST_CASE("the tour goes on when what it asks for was done, and by nothing else") {
  Tour tour;
  CHECK_FALSE(tour.is_on());
  TourSight now = sight();
  tour.watch(now);
  CHECK_FALSE(tour.is_on());
  tour.begin();
  tour.watch(now);
  now.camera.zoom(0.5F);
  now.edits = 3;
  tour.watch(now);
  CHECK(tour.step() == 0);  // what belongs to other steps
  now.is_pulling = now.is_busy = true;
  tour.watch(now);
  CHECK(tour.step() == 0);  // not let go yet
  now.is_pulling = now.is_busy = false;
  tour.watch(now);
  CHECK(tour.step() == 1);

  tour.watch(now);
  CHECK(tour.step() == 1);
  now.camera.orbit({0.1F, 0});
  now.is_busy = true;
  tour.watch(now);
  CHECK(tour.step() == 1);
  now.is_busy = false;
  tour.watch(now);
  CHECK(tour.step() == 2);

  tour.watch(now);
  now.is_pulling = true;
  tour.watch(now);
  now.is_pulling = false;
  tour.watch(now);
  CHECK(tour.step() == 2);
  now.edits = 4;
  now.undone_next = "cloth: silk";
  tour.watch(now);
  CHECK(tour.step() == 2);
  now.edits = 5;
  now.undone_next = "unpin";
  tour.watch(now);
  CHECK(tour.step() == 3);

  now.is_handling = true;
  tour.watch(now);
  CHECK(tour.step() == 3);
  now.is_handling = false;
  tour.watch(now);
  CHECK(tour.step() == 4);

  tour.watch(now);
  now.redone_next = "unpin";  // takes back what was there before
  now.undone_next = "";
  tour.watch(now);
  CHECK(tour.step() == 4);
  now = {.edits = 6, .undone_next = "move 9 vertices", .camera = now.camera};
  tour.watch(now);
  now = {.edits = 6, .redone_next = "move 9 vertices", .camera = now.camera};
  tour.watch(now);
  CHECK(tour.step() == 4);  // a pin is no slider
  now = {.edits = 7, .undone_next = "bend: stiffness", .camera = now.camera};
  tour.watch(now);
  CHECK(tour.step() == 4);
  now = {.edits = 7, .redone_next = "bend: stiffness", .camera = now.camera};
  tour.watch(now);
  CHECK(tour.step() == Tour::step_count);
  tour.watch(now);
  CHECK(tour.step() == Tour::step_count);  // until it is closed
  tour.skip();
  CHECK_FALSE(tour.is_on());
}

TEST_CASE("each step can be skipped, and the tour ended and begun again") {
  Tour tour;
  tour.skip();
  CHECK_FALSE(tour.is_on());
  tour.begin();
  for (int step = 0; step <= Tour::step_count; ++step) {
    CHECK(tour.step() == step);
    tour.skip();
  }
  CHECK_FALSE(tour.is_on());
  tour.begin();
  tour.skip();
  tour.end();
  CHECK_FALSE(tour.is_on());
  tour.begin();
  CHECK(tour.step() == 0);
}

}  // namespace test_tour
