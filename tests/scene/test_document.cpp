// Documents hold what was written, say where it stands, and refuse everything else.
#include <cstdint>
#include <limits>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant_io/scene/document.h"

namespace test_document {

namespace {

using pliant::Document;
using Json = nlohmann::json;
using Kind = Document::Kind;

/// The document as the general library would have read it.
Json to_json(const Document& document, Document::Place place) {
  switch (document.kind(place)) {
    case Kind::null:
      return nullptr;
    case Kind::boolean:
      return document.boolean(place);
    case Kind::integer:
    case Kind::wide_integer:
      return document.integer(place);
    case Kind::real:
      return document.real(place);
    case Kind::text:
      return document.text(place);
    case Kind::bytes: {
      const std::string_view bytes = document.text(place);
      return Json::binary(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
    }
    case Kind::list: {
      Json list = Json::array();
      for (std::size_t i = 0; i < document.size(place); ++i)
        list.push_back(to_json(document, document.entry(place, i)));
      return list;
    }
    case Kind::object: {
      Json object = Json::object();
      for (std::size_t i = 0; i < document.size(place); ++i) {
        object[std::string(document.text(document.key(place, i)))] = to_json(document, document.member(place, i));
      }
      return object;
    }
  }
  return {};
}

std::string message_of(auto&& read) {
  try {
    read();
  } catch (const pliant::Error& error) {
    CHECK(error.kind() == pliant::ErrorKind::input);
    return error.what();
  }
  return "(no error)";
}

std::string json_message(std::string_view text) {
  return message_of([&] { pliant::parse_json(text, "s.json"); });
}

std::string cbor_message(std::string_view bytes) {
  return message_of([&] { pliant::parse_cbor(bytes, "c.cbor"); });
}

std::string cbor_of(const Json& json) {
  const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
  return {bytes.begin(), bytes.end()};
}

constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t smallest = std::numeric_limits<std::int64_t>::min();

/// Values of all kinds, across the limits of words and blocks.
Json samples() {
  Json json = {{"empty", {Json::object(), Json::array(), "", nullptr}},
               {"flags", {true, false}},
               {"whole",
                {0, -1, 1, largest, smallest, (std::int64_t{1} << 59) - 1, std::int64_t{1} << 59,
                 -(std::int64_t{1} << 59), -(std::int64_t{1} << 59) - 1}},
               {"real", {0.5, -0.0, 1e-320, 1.7976931348623157e308, 5e-324}},
               {"", {{"nested", {{"deep", {{1, {2, {3}}}, Json::object()}}}}}}};
  for (int i = 0; i < 2000; ++i) {
    json["many"].push_back({{fmt::format("key {}", i), i * 0.25}});
    json["texts"].push_back(std::string(static_cast<std::size_t>(i), static_cast<char>('a' + i % 26)));
  }
  return json;
}

TEST_CASE("a document holds what was written") {
  const Json json = samples();
  const std::string text = json.dump();
  const Document document = pliant::parse_json(text, "s.json");
  CHECK(to_json(document, document.root()) == json);
  const Document from_cbor = pliant::parse_cbor(cbor_of(json), "c.cbor");
  CHECK(to_json(from_cbor, from_cbor.root()) == json);
  Json with_bytes = {{"state", Json::binary({0, 255, 10, 13})}};
  const Document bytes = pliant::parse_cbor(cbor_of(with_bytes), "c.cbor");
  CHECK(to_json(bytes, bytes.root()) == with_bytes);
}

void check_paths(const Document& document, Document::Place place, const std::string& path, int& checked) {
  CHECK(document.path_of(place) == path);
  ++checked;
  const Kind kind = document.kind(place);
  if (kind != Kind::list && kind != Kind::object) return;
  for (std::size_t i = 0; i < document.size(place); ++i) {
    if (kind == Kind::list) {
      check_paths(document, document.entry(place, i), fmt::format("{}[{}]", path, i), checked);
    } else {
      const std::string key(document.text(document.key(place, i)));
      check_paths(document, document.member(place, i), path.empty() ? key : fmt::format("{}.{}", path, key), checked);
    }
  }
}

TEST_CASE("every value knows its path") {
  const Document document = pliant::parse_json(
      R"({"a": [[], {}, [1, [2.5, {"x": 1e3}], "t"], {"b": {"c": [0]}}], "d": null, "e": [[[[7]]]]})", "s.json");
  int checked = 0;
  check_paths(document, document.root(), "", checked);
  CHECK(checked == 21);
}

TEST_CASE("a slip of syntax names line and column, whatever ends the lines") {
  CHECK(json_message("").starts_with("s.json:1:1: "));
  CHECK(json_message("{\n \"a\" 1}").starts_with("s.json:2:6: "));
  CHECK(json_message("{\r\n \"a\" 1}").starts_with("s.json:2:6: "));
  CHECK(json_message("{\r \"a\" 1}").starts_with("s.json:2:6: "));
  CHECK(json_message("{\r\r\n\n \"a\" 1}").starts_with("s.json:4:6: "));
  CHECK(json_message("\xEF\xBB\xBF{\"a\" 1}").starts_with("s.json:1:6: "));
  CHECK(json_message("{\"\xC3\xA4\xC3\xB6\" 1}").starts_with("s.json:1:7: "));
  CHECK(json_message("{} x").starts_with("s.json:1:4: "));
  CHECK(json_message("{} {}").starts_with("s.json:1:4: "));
  CHECK(json_message("[1, 2,]").starts_with("s.json:1:7: "));
  CHECK(json_message("[1, /* no */ 2]").starts_with("s.json:1:5: "));
  CHECK(json_message("[01]").starts_with("s.json:1:3: "));
  CHECK(json_message("[NaN]").starts_with("s.json:1:2: "));
}

TEST_CASE("long runs of blanks are read, and counted") {
  const std::string blanks = std::string(5000, ' ') + std::string(3000, '\n');
  CHECK(json_message(blanks + "[1," + blanks + "2]" + blanks) == "(no error)");
  CHECK(json_message(blanks + "[1," + blanks + "  x]").starts_with("s.json:6001:3: "));
  CHECK(json_message("[\"" + std::string(5000, ' ') + "\\\"\", " + std::string(5000, ' ') + "x]")
            .starts_with("s.json:1:10008: "));
  const Document document = pliant::parse_json("[\"" + std::string(5000, ' ') + "\"]", "s.json");
  CHECK(document.size(document.entry(document.root(), 0)) == 5000);
  CHECK(json_message("[\"" + blanks + "\"]").starts_with("s.json:1:5003: "));
}

TEST_CASE("a byte of 0 is refused wherever it stands") {
  using namespace std::string_literals;
  CHECK(json_message("{\"a\":\0 1}"s).starts_with("s.json:1:6: a byte of 0"));
  CHECK(json_message("{}\0"s).starts_with("s.json:1:3: a byte of 0"));
  CHECK(json_message("{}\n\0rest"s).starts_with("s.json:2:1: a byte of 0"));
  CHECK(json_message("\xFF\xFE{\0}\0"s).starts_with("s.json:1:"));
}

TEST_CASE("a byte order mark is none of the text") {
  const Document document = pliant::parse_json("\xEF\xBB\xBF[1]", "s.json");
  CHECK(document.size(document.root()) == 1);
}

TEST_CASE("bytes that are no UTF-8, and control characters, reach no terminal") {
  for (const std::string_view text :
       {"{\"\x80\": 1}", "[\"\xC0\xAF\"]", "[\"a\x1B[31m\"]", "\x1B", "[\"\xED\xA0\x80\"]"}) {
    const std::string message = json_message(text);
    CHECK(message.starts_with("s.json:1:"));
    for (const char c : message) CHECK(static_cast<unsigned char>(c) >= ' ');
    CHECK(message.find('\x7f') == message.npos);
    CHECK_NOTHROW(static_cast<void>(Json(message).dump()));  // throws on what is no UTF-8
  }
}

TEST_CASE("a key may stand once in an object") {
  CHECK(json_message(R"({"a": {"k": 1, "l": 2, "k": 3}})") ==
        "s.json: a: the key 'k' stands here twice; remove one of the two");
  CHECK(json_message(R"([1, {"k": 1, "k": 3}])") ==
        "s.json: [1]: the key 'k' stands here twice; remove one of the two");
  CHECK(json_message(R"({"k": 1, "k": 1})") == "s.json: the key 'k' stands here twice; remove one of the two");
  CHECK(json_message(R"({"k": {"k": 1}, "\u006b": 1})").find("stands here twice") != std::string::npos);
  std::string many = "{";
  for (int i = 0; i < 300000; ++i) many += fmt::format("\"{}\":0,", i);
  CHECK(json_message(many + "\"x\":1}") == "(no error)");
  CHECK(json_message(many + "\"77\":1}").find("the key '77'") != std::string::npos);
}

TEST_CASE("numbers beyond the range of doubles, and levels without end") {
  CHECK(json_message("[1, {\"a\": [0, 1e999]}]").starts_with("s.json: [1].a[1]: 1e999 is beyond the range"));
  CHECK(json_message(std::string(64, '[') + std::string(64, ']')) == "(no error)");
  CHECK(json_message(std::string(65, '[') + std::string(65, ']')).find("more than 64 levels") != std::string::npos);
  CHECK(json_message(std::string(1000000, '[')).find("more than 64 levels") != std::string::npos);
  const std::string long_name(10000, 'x');
  std::string nested;
  for (int i = 0; i < 100; ++i) nested += "{\"" + long_name + "\":";
  CHECK(json_message(nested).size() < 1000);
}

TEST_CASE("damaged CBOR is refused") {
  using namespace std::string_literals;
  CHECK(cbor_message(std::string(1000000, '\x81')).find("more than 64 levels") != std::string::npos);
  CHECK(cbor_message(std::string(1000000, '\x9F')).find("more than 64 levels") != std::string::npos);
  CHECK(cbor_message(std::string(1000000, '\xBF')).starts_with("c.cbor: "));
  CHECK(cbor_message(std::string(1000000, '\x7F')).find("a string in pieces") != std::string::npos);
  CHECK(cbor_message("\x81"s + std::string(1000000, '\x5F')).find("a string in pieces") != std::string::npos);
  CHECK(cbor_message("\x9B\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s).starts_with("c.cbor: "));
  CHECK(cbor_message("\x5B\x7F\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s).starts_with("c.cbor: "));
  CHECK(cbor_message("\xFB\x7F\xF0\0\0\0\0\0\0"s).find("not finite") != std::string::npos);
  CHECK(cbor_message("\xF9\x7E\0"s).find("not finite") != std::string::npos);
  CHECK(cbor_message("\xA2\x61k\x01\x61k\x02"s).find("the key 'k' stands here twice") != std::string::npos);
  const std::string sound = cbor_of(samples());
  CHECK(cbor_message(sound + '\0').starts_with("c.cbor: "));
  const std::string small = cbor_of({{"a", {1, 2.5, "text"}}, {"b", nullptr}});
  for (std::size_t length = 0; length < small.size(); ++length) {
    CHECK(cbor_message(small.substr(0, length)).starts_with("c.cbor: "));
  }
}

}  // namespace

}  // namespace test_document
