#include <doctest/doctest.h>

#include "pliant_io/scene/nearest_names.h"

namespace test_nearest_names {
namespace {

using pliant::did_you_mean;
using pliant::near_names;
using pliant::suggestion_text;

TEST_CASE("what is near is suggested: slips, beginnings, capitals") {
  CHECK(did_you_mean("veiw", {"run", "view"}) == "; did you mean 'view'?");
  CHECK(did_you_mean("chek", {"check", "bench"}) == "; did you mean 'check'?");
  CHECK(did_you_mean("CHAIN", {"chain"}) == "; did you mean 'chain'?");
  CHECK(did_you_mean("s", {"sweep", "scenes"}) == "; did you mean 'sweep' or 'scenes'?");
  CHECK(did_you_mean("stiffnes", {"stiffness", "stencils"}) == "; did you mean 'stiffness'?");
}

TEST_CASE("at most three, the nearest first") {
  CHECK(did_you_mean("curtain", {"curtain_x", "curtains", "certain", "curtain_w", "rope"}) ==
        "; did you mean 'curtains', 'curtain_x' or 'curtain_w'?");
  CHECK(did_you_mean("certan", {"curtains", "certain"}) == "; did you mean 'certain'?");
}

TEST_CASE("nothing, where nothing is near") {
  CHECK(did_you_mean("xylophone", {"run", "view", "check"}).empty());
  CHECK(did_you_mean("ab", {"cd", "a"}).empty());
  CHECK(did_you_mean("", {"run"}).empty());
  CHECK(did_you_mean("run", {}).empty());
}

TEST_CASE("suggestions name what is near, and nothing else") {
  using Names = std::vector<std::string_view>;
  const Names names = {"bar", "chain", "curtain", "flag", "flap", "flat", "flake", "edge_strain"};
  CHECK(near_names("flg", names) == Names{"flag"});
  CHECK(near_names("curtian", names) == Names{"curtain"});
  CHECK(near_names("edge", names) == Names{"edge_strain"});
  CHECK(near_names("fla", names) == Names{"flag", "flap", "flat"});
  CHECK(near_names("FLAG", names) == Names{"flag", "flap", "flat"});
  CHECK(near_names("e", names) == Names{"edge_strain"});
  CHECK(near_names("wind", names).empty());
  CHECK(near_names("", names).empty());
  CHECK(suggestion_text("colums", {"rows", "columns"}) == "did you mean 'columns'? (known: rows, columns)");
  CHECK(suggestion_text("fla", names).starts_with("did you mean 'flag', 'flap' or 'flat'? (known: bar, "));
  CHECK(suggestion_text("size", {"rows", "columns"}) == "known: rows, columns");
  CHECK(suggestion_text("size", {}) == "there is none");
  CHECK(suggestion_text("x", Names(30, "name")).ends_with("name, ..."));
  CHECK(suggestion_text("d", {"a", "b", "c", "d", "e", "f", "g", "h", "i"}) ==
        "did you mean 'd'? (known: a, b, c, d, e, f, g, h, ...)");
}

}  // namespace
}  // namespace test_nearest_names
