#include <doctest/doctest.h>

#include "pliant_io/scene/nearest_names.h"

namespace test_nearest_names {
namespace {

using pliant::did_you_mean;

TEST_CASE("what is near is suggested: slips, beginnings, capitals") {
  CHECK(did_you_mean("veiw", {"run", "view"}) == "; did you mean 'view'?");
  CHECK(did_you_mean("chek", {"check", "bench"}) == "; did you mean 'check'?");
  CHECK(did_you_mean("CHAIN", {"chain"}) == "; did you mean 'chain'?");
  CHECK(did_you_mean("s", {"sweep", "scenes"}) == "; did you mean 'sweep' or 'scenes'?");
  CHECK(did_you_mean("stiffnes", {"stiffness", "stencils"}) == "; did you mean 'stiffness'?");
}

TEST_CASE("at most three, the nearest first") {
  CHECK(did_you_mean("curtain", {"curtain_x", "curtains", "certain", "curtain_w", "rope"}) ==
        "; did you mean 'curtain_x', 'curtains' or 'curtain_w'?");
  CHECK(did_you_mean("certan", {"curtains", "certain"}) == "; did you mean 'certain'?");
}

TEST_CASE("nothing, where nothing is near") {
  CHECK(did_you_mean("xylophone", {"run", "view", "check"}).empty());
  CHECK(did_you_mean("ab", {"cd", "a"}).empty());
  CHECK(did_you_mean("", {"run"}).empty());
  CHECK(did_you_mean("run", {}).empty());
}

}  // namespace
}  // namespace test_nearest_names
