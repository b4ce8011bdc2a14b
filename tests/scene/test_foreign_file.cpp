// For a file that is not a scene, the error says what it looks like.
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/temporary_folder.h"

namespace test_foreign_file {

namespace {

using namespace std::string_literals;
using pliant_tests::TemporaryFolder;

std::string message_of(const std::filesystem::path& file) {
  try {
    pliant::load_scene(file);
  } catch (const pliant::Error& error) {
    CHECK(error.kind() == pliant::ErrorKind::input);
    return error.what();
  }
  return "(no error)";
}

}  // namespace

TEST_CASE("pictures, documents and texts are told to be no scene, with what can be opened") {
  const TemporaryFolder folder;
  struct Kind {
    const char* name;
    std::string bytes;
    const char* what;
  };
  const std::vector<Kind> kinds = {{"a.png", "\x89PNG\r\n\x1a\n\0\0\0\rIHDR"s, "a PNG picture"},
                                   {"b.JPG", "\xff\xd8\xff\xe0"s, "a JPEG picture"},
                                   {"c.docx", "PK\x03\x04\x14\0"s, "an office document"},
                                   {"d.pdf", "%PDF-1.7"s, "a PDF document"},
                                   {"e.txt", "To whom it may concern"s, "a text that does not begin with '{'"},
                                   {"f", "\x01\x02\0\x03"s, "no text"},
                                   {"g.svg", "<svg></svg>"s, "an XML or HTML file"},
                                   {"h.dat", ""s, "an empty file"}};
  for (const Kind& kind : kinds) {
    CAPTURE(kind.name);
    const auto file = folder.write(kind.name, kind.bytes);
    const std::string message = message_of(file);
    CAPTURE(message);
    CHECK(message.starts_with(file.string() + ": this looks like "));
    CHECK(message.find(kind.what) != message.npos);
    for (const char* ending : {"(.json)", ".obj", ".msh", "(.pliant)", "(.session)"}) {
      CHECK(message.find(ending) != message.npos);
    }
    CHECK(message.find("JSON;") == message.npos);
    CHECK(message.find('\n') == message.npos);
  }
}

TEST_CASE("a scene file with a slip keeps its line and column, whatever it is called") {
  const TemporaryFolder folder;
  for (const char* name : {"a.json", "b.JSON", "c.scene", "d"}) {
    const auto file = folder.write(name, "{\n  \"pliant\": 1,\n  \"bodies\" []\n}");
    CHECK(message_of(file).starts_with(file.string() + ":3:12: "));
  }
  const auto text = folder.write("e.json", "bodies");
  CHECK(message_of(text).starts_with(text.string() + ":1:1: "));
  const auto marked = folder.write("f", "\n  { \"pliant\": 2 }");
  CHECK(message_of(marked).find("version") != std::string::npos);
}

}  // namespace test_foreign_file
