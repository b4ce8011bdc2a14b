#include <doctest/doctest.h>

#include "pliant_io/files/csv.h"

namespace test_csv {

using namespace pliant;

TEST_CASE("a field of a table has quotes where it needs them") {
  CHECK(csv_field("") == "");
  CHECK(csv_field("a b;c'd\t") == "a b;c'd\t");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("\"") == "\"\"\"\"");
  CHECK(csv_field("say \"yes\"") == "\"say \"\"yes\"\"\"");
  CHECK(csv_field("a\nb") == "\"a\nb\"");
  CHECK(csv_field("a\r") == "\"a\r\"");
}

}  // namespace test_csv
