#include <doctest/doctest.h>

#include "pliant/core/printable.h"

namespace test_printable {

using namespace pliant;

TEST_CASE("what commands a terminal or turns the direction of writing becomes a blank, and what is no UTF-8 a mark") {
  CHECK(printable("a\x1b[31m\n\x7f") == "a [31m  ");
  CHECK(printable("\u0085\u009b31m") == "  31m");
  CHECK(printable("\x9b\xff\xc3(") == std::string(3, '?') + "(");
  CHECK(printable("\u061c\u200e\u200f\u2028\u2029\u202a\u202e\u2066\u2069\ufeff") == std::string(10, ' '));
  CHECK(printable("ä€\u061b\u061d\U0001f600") == "ä€\u061b\u061d\U0001f600");
}

TEST_CASE("what is long is cut between characters") {
  CHECK(printable("aäb", 4) == "aäb");
  CHECK(printable("aäb", 3) == "aä...");
  CHECK(printable("aäb", 2) == "a...");
}

}  // namespace test_printable
