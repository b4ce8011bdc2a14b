// Texts of scenes and CBOR of checkpoints that cannot be read say why and where; what is sound is read whole.
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/checkpoint_bytes.h"

namespace test_json_text {

namespace {

using Json = nlohmann::json;

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
  return message_of([&] { pliant::parse_scene(text, {}, "s.json"); });
}

std::string cbor_message(std::string_view content) {
  const std::string bytes = pliant_tests::checkpoint_bytes(content, 4);
  return message_of([&] { pliant::parse_checkpoint(bytes, "c.pliant"); });
}

std::string cbor_of(const Json& json) {
  const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
  return {bytes.begin(), bytes.end()};
}

/// A scene whose name and first mass are these texts of JSON.
std::string scene_with(const std::string& name, const std::string& mass = "1") {
  return R"({"pliant": 1, "name": )" + name +
         R"(, "bodies": [{"mesh": {"vertices": [[0, 0, 0], [1, 0, 0]], "edges": [[0, 1]]}, "mass": {"total": )" + mass +
         "}}]}";
}

TEST_CASE("texts and numbers are read as they are written") {
  const auto read = [](const std::string& name, const std::string& mass) {
    return pliant::parse_scene(scene_with(name, mass), {}, "s.json");
  };
  CHECK(read(R"("a\u00e4\n\"")", "1").name == "a\xC3\xA4\n\"");
  CHECK(read("\"" + std::string(5000, ' ') + "\"", "1").name.size() == 5000);
  for (const double mass : {0.5, 1e-300, 1.0 / 3, 1e90}) {
    CAPTURE(mass);
    CHECK(read("\"a\"", fmt::format("{}", mass)).simulation.state().masses[0] == mass / 2);
  }
  CHECK(read("\"a\"", "18446744073709551615").simulation.state().masses[0] == 0x1p63);
  CHECK(json_message("\xEF\xBB\xBF" + scene_with("\"a\"")) == "(no error)");
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
  CHECK(json_message(blanks + scene_with(blanks + "\"a\"" + blanks) + blanks) == "(no error)");
  CHECK(json_message(blanks + "[1," + blanks + "  x]").starts_with("s.json:6001:3: "));
  CHECK(json_message("[\"" + std::string(5000, ' ') + "\\\"\", " + std::string(5000, ' ') + "x]")
            .starts_with("s.json:1:10008: "));
  CHECK(json_message("[\"" + blanks + "\"]").starts_with("s.json:1:5003: "));
}

TEST_CASE("a byte of 0 is refused wherever it stands") {
  using namespace std::string_literals;
  CHECK(json_message("{\"a\":\0 1}"s).starts_with("s.json:1:6: a byte of 0"));
  CHECK(json_message("{}\0"s).starts_with("s.json:1:3: a byte of 0"));
  CHECK(json_message("{}\n\0rest"s).starts_with("s.json:2:1: a byte of 0"));
  CHECK(json_message("\xFF\xFE{\0}\0"s).starts_with("s.json:1:"));
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
  CHECK(json_message(many + "\"x\":1}").find("the key 'pliant' is missing") != std::string::npos);
  CHECK(json_message(many + "\"77\":1}").find("the key '77'") != std::string::npos);
}

TEST_CASE("numbers beyond the range of doubles, and levels without end") {
  CHECK(json_message("[1, {\"a\": [0, 1e999]}]").starts_with("s.json: [1].a[1]: 1e999 is beyond the range"));
  CHECK(json_message(std::string(64, '[') + std::string(64, ']')) == "s.json: found a list; give an object {...}");
  CHECK(json_message(std::string(65, '[') + std::string(65, ']')).find("more than 64 levels") != std::string::npos);
  CHECK(json_message(std::string(1000000, '[')).find("more than 64 levels") != std::string::npos);
  const std::string long_name(10000, 'x');
  std::string nested;
  for (int i = 0; i < 100; ++i) nested += "{\"" + long_name + "\":";
  CHECK(json_message(nested).size() < 1000);
}

TEST_CASE("a text with too many bytes or values is refused, one at the limit is not") {
  const auto text = [](std::size_t size) {
    const std::string before = scene_with("\"a\"");
    return before + std::string(size - before.size(), ' ');
  };
  constexpr std::size_t limit = std::size_t{32} << 20U;
  CHECK(json_message(text(limit)) == "(no error)");
  CHECK(json_message(text(limit + 1)) == "s.json: is larger than 32 MB; put meshes and maps into files of their own");
  std::string values = "[0";
  for (int i = 0; i < 10'000'000; ++i) values += ",0";
  CHECK(json_message(values + "]").find("more than 10000000 values; put meshes") != std::string::npos);
}

TEST_CASE("damaged CBOR is refused") {
  using namespace std::string_literals;
  CHECK(cbor_message(std::string(1000000, '\x81')).find("more than 64 levels") != std::string::npos);
  CHECK(cbor_message(std::string(1000000, '\x9F')).find("more than 64 levels") != std::string::npos);
  CHECK(cbor_message(std::string(1000000, '\xBF')).starts_with("c.pliant: "));
  CHECK(cbor_message(std::string(1000000, '\x7F')).find("a string in pieces") != std::string::npos);
  CHECK(cbor_message("\x81"s + std::string(1000000, '\x5F')).find("a string in pieces") != std::string::npos);
  CHECK(cbor_message("\x9B\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s).starts_with("c.pliant: "));
  CHECK(cbor_message("\x5B\x7F\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s).starts_with("c.pliant: "));
  CHECK(cbor_message("\xFB\x7F\xF0\0\0\0\0\0\0"s).find("not finite") != std::string::npos);
  CHECK(cbor_message("\xF9\x7E\0"s).find("not finite") != std::string::npos);
  CHECK(cbor_message("\xA2\x61k\x01\x61k\x02"s).find("the key 'k' stands here twice") != std::string::npos);
  CHECK(cbor_message("\x9A\x00\xA0\x00\x00"s + std::string(10485760, '\x80')).find("more than 10000000 values") !=
        std::string::npos);
  const std::string small = cbor_of({{"a", {1, 2.5, "text"}}, {"b", nullptr}});
  CHECK(cbor_message(small).find("the key 'source' is missing") != std::string::npos);
  CHECK(cbor_message(small + '\0').find("damaged") != std::string::npos);
  for (std::size_t length = 0; length < small.size(); ++length) {
    CHECK(cbor_message(small.substr(0, length)).find("damaged") != std::string::npos);
  }
}

}  // namespace

}  // namespace test_json_text
