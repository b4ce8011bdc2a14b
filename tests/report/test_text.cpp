#include <doctest/doctest.h>

#include "report/text.h"

namespace test_text {

using namespace pliant_report;

TEST_CASE("text for pages has no markup, no control characters and no bytes that are not UTF-8") {
  CHECK(escaped("a < b & c > \"d'") == "a &lt; b &amp; c &gt; &quot;d&#39;");
  CHECK(escaped(std::string_view("\0\x1b\n\x7f", 4)) == "    ");
  CHECK(escaped("\xc3(\xff\xed\xa0\x80") == "?(????");
  CHECK(escaped("\xEF\xBF\xBE\xEF\xBF\xBFä‖𝛴") == "??ä‖𝛴");
}

TEST_CASE("wide texts are wrapped at blanks, and words that are wider are cut between characters") {
  const std::vector<std::string> lines = wrapped("the number of iterations by the size of the mesh", 110);
  CHECK(lines.size() > 2);
  std::string joined;
  for (const std::string& line : lines) {
    CHECK(text_width(line) <= 110);
    joined += (joined.empty() ? "" : " ") + line;
  }
  CHECK(joined == "the number of iterations by the size of the mesh");
  joined.clear();
  for (const std::string& line : wrapped("ääääääääää", 30)) {
    CHECK(text_width(line) <= 30);
    CHECK(line.size() % 2 == 0);
    joined += line;
  }
  CHECK(joined == "ääääääääää");
  CHECK(wrapped("", 10) == std::vector<std::string>{""});
}

TEST_CASE("a text that is shortened fits and says that it goes on") {
  CHECK(shortened("short", 100) == "short");
  const std::string text = shortened("a text that does not fit", 60);
  CHECK(text_width(text) <= 60);
  CHECK(text.ends_with("…"));
  CHECK(text.starts_with("a te"));
}

}  // namespace test_text
