#include <string>

#include <doctest/doctest.h>

#include "pliant_io/files/base64.h"

namespace test_base64 {

using pliant::base64;

TEST_CASE("base64 is that of RFC 4648, Sec. 10") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("fooba") == "Zm9vYmE=");
  CHECK(base64("foobar") == "Zm9vYmFy");
}

TEST_CASE("base64 takes any bytes, and uses all of its digits") {
  CHECK(base64(std::string(3, '\0')) == "AAAA");
  CHECK(base64("\xff\xff\xff") == "////");
  CHECK(base64("\xfb\xef\xbe") == "++++");
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  const std::string text = base64(all);
  CHECK(text.size() == 344);
  for (const char digit : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")) {
    CHECK(text.find(digit) != std::string::npos);
  }
}

TEST_CASE("what base64 makes is read back, and nothing else is") {
  std::string bytes;
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    CHECK(pliant::bytes_of_base64(pliant::base64(bytes)) == bytes);
    bytes += static_cast<char>(7 * i);
  }
  for (const char* text : {"Z", "Zg=", "====", "Z===", "Zg=a", "Zm9v\n", "Zm 9", "Z=9v", "Zm9vZg==Zg=="}) {
    CAPTURE(text);
    CHECK_FALSE(pliant::bytes_of_base64(text).has_value());
  }
}

}  // namespace test_base64
