// "--vary PATH=a,b,c": what separates values, ranges, and what is refused.
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "sweep/variation.h"

namespace test_variation {

namespace {

using namespace pliant_sweep;
using Texts = std::vector<std::string>;

std::string message_of(auto&& f) {
  try {
    f();
  } catch (const pliant::Error& error) {
    CHECK(error.kind() == pliant::ErrorKind::input);
    CHECK(std::string_view(error.what()).find('\n') == std::string_view::npos);
    return error.what();
  }
  return "(no error)";
}

Texts values_of(const std::string& text) {
  return read_variation("a.b=" + text).values;
}

std::string slip(const std::string& text) {
  return message_of([&] { read_variation(text); });
}

TEST_CASE("commas separate values outside of brackets, braces and quotes") {
  CHECK(read_variation("bodies[a=1].x=1,2").path == "bodies[a");  // as --set divides it
  CHECK(values_of("1,2.5,-3e-4") == Texts{"1", "2.5", "-3e-4"});
  CHECK(values_of(" 1 , 2 ") == Texts{"1", "2"});
  CHECK(values_of("[0,1,0],[[1,2],[3]]") == Texts{"[0,1,0]", "[[1,2],[3]]"});
  CHECK(values_of(R"({"a":[1,2],"b":3},null)") == Texts{R"({"a":[1,2],"b":3})", "null"});
  CHECK(values_of(R"("a,b","c\",d",e)") == Texts{R"("a,b")", R"("c\",d")", "e"});
  CHECK(values_of(R"("[",2)") == Texts{R"("[")", "2"});
  CHECK(values_of("1],2") == Texts{"1]", "2"});
  CHECK(values_of("[1,2") == Texts{"[1,2"});
  CHECK(values_of(R"("")") == Texts{R"("")"});
}

TEST_CASE("ranges have their ends exactly, and round values between them") {
  CHECK(values_of("1:9:5") == Texts{"1", "3", "5", "7", "9"});
  CHECK(values_of("0.1:0.5:5") == Texts{"0.1", "0.2", "0.3", "0.4", "0.5"});
  CHECK(values_of("1e-2:1e2:5log") == Texts{"1e-2", "0.1", "1", "10", "1e2"});
  CHECK(values_of("2:-2:3") == Texts{"2", "0", "-2"});
  CHECK(values_of("0,1:2:2,5") == Texts{"0", "1", "2", "5"});
  CHECK(values_of("\"1:9:5\"") == Texts{"\"1:9:5\""});
  CHECK(values_of("a:b:c") == Texts{"a:b:c"});
  for (const std::string range : {"1:9", "1:9:", "1:9:1", "1:9:0", "1:9:2.5", "1:9:-3", "1:x:3", "1:9:3lin", "1:9:3:4",
                                  "0:9:3log", "-1:9:3log", "1:9:99999999999999999999", "1:9:10001", "1:inf:3"}) {
    CAPTURE(range);
    CHECK(slip("a=" + range).find("is not a range") != std::string::npos);
  }
}

TEST_CASE("slips of a variation") {
  CHECK(slip("a").find("there is no '='") != std::string::npos);
  CHECK(slip("=1").find("there is no path") != std::string::npos);
  CHECK(slip("a= ").find("there are no values") != std::string::npos);
  CHECK(slip("a=1,,2").find("a value without text") != std::string::npos);
  CHECK(slip("a=1,").find("a value without text") != std::string::npos);
  CHECK(slip("a=1,2,1").find("the value 1 comes twice") != std::string::npos);
  CHECK(slip("a=[1,2],[1, 2]").find("comes twice") != std::string::npos);
  CHECK(slip("a=b,\"b\"").find("comes twice") != std::string::npos);
  CHECK(slip("a=" + std::string(100'000, 'x')) == "(no error)");
  CHECK(slip("a=" + std::string(100'000, '[')) == "(no error)");
  CHECK(slip("\x1b[31m=1,1").find('\x1b') == std::string::npos);
}

TEST_CASE("the last variation changes fastest") {
  const auto product = product_of({{"a", {"1", "2"}}, {"b", {"x", "y", "z"}}});
  CHECK(product == std::vector<Combination>{{"1", "x"}, {"1", "y"}, {"1", "z"}, {"2", "x"}, {"2", "y"}, {"2", "z"}});
  CHECK(message_of([] { product_of({}); }).find("--vary is missing") != std::string::npos);
  CHECK(message_of([] { product_of({{"a", {}}}); }).find("no runs") != std::string::npos);
  CHECK(message_of([] { product_of({{"a", {"1"}}, {"a", {"2"}}}); }).find("comes twice") != std::string::npos);
  const Texts many(101, "1");
  CHECK(message_of([&] { product_of({{"a", many}, {"b", many}}); }).find("more than 10000") != std::string::npos);
  CHECK(product_of({{"a", Texts(100, "1")}, {"b", Texts(100, "1")}}).size() == max_runs);
}

TEST_CASE("values that mean the same are known as the same") {
  CHECK(canonical_value("[1, 2]") == canonical_value("[1,2]"));
  CHECK(canonical_value("0.10") == canonical_value("1e-1"));
  CHECK(canonical_value("a b") == canonical_value("\"a b\""));
  CHECK(canonical_value("1") != canonical_value("\"1\""));
  CHECK(canonical_value(R"(["]"])") != canonical_value(R"(["["])"));
  // Brackets in texts do not count; what is nested deeper than any scene goes is a text.
  const std::string deep = std::string(3'000'000, '[') + std::string(3'000'000, ']');
  CHECK(canonical_value(deep) == '"' + deep + '"');
  const std::string hidden = "[\"" + std::string(3'000'000, ']') + "\\\"]\"," + deep + "]";
  CHECK(canonical_value(hidden).starts_with("\"["));
  CHECK(canonical_value("[\"" + std::string(3'000, '[') + "\"]").starts_with("[\""));
  CHECK(canonical_value("[1") != canonical_value("[1]"));
  CHECK(number_of("1e3") == 1000.0);
  for (const char* text : {"", "x", "1x", "0x10", "nan", "inf", "1e999", "[1]", " 1"}) CHECK(!number_of(text));
}

TEST_CASE("a table has texts without the quotes of JSON") {
  CHECK(plain_value("\"bdf2\"") == "bdf2");
  CHECK(plain_value(R"("a \"b\", c")") == R"(a "b", c)");
  for (const char* text : {"bdf2", "0.10", "[1, 2]", R"(["a"])", "true", "\"", "\"open", ""}) {
    CHECK(plain_value(text) == text);
  }
}

}  // namespace

}  // namespace test_variation
