#include <cstdint>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant_io/mesh/vertex_map.h"
#include "tests/mesh/files.h"

namespace test_vertex_map {

using namespace pliant;
using namespace pliant_tests;

namespace {

std::string refusal(const std::string& bytes) {
  return error_of([&] { parse_vertex_map(bytes, "a"); });
}

/// As numpy.save writes it, of version 1 or 2.
template <class Number>
std::string npy(const std::string& type, const std::vector<Number>& numbers, const std::string& shape = "",
                char version = 1) {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type,
                                   shape.empty() ? fmt::format("({},)", numbers.size()) : shape);
  header.resize(119, ' ');
  header += '\n';
  std::string bytes = fmt::format("\x93NUMPY{}{}{}{}", version, '\0', static_cast<char>(header.size()), '\0');
  if (version > 1) bytes.append(2, '\0');
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
  return bytes;
}

}  // namespace

TEST_CASE("a map as text has one number a line") {
  const std::vector<Real> expected = {1, -0.5, 1e-3};
  for (const std::string text : {"1\n-.5\n1e-3\n", "# c\n1 # one\r\n\r\n -.5\r\n+1e-3",
                                 "\xEF\xBB\xBF"
                                 "1\r-0.5\r0.001"}) {
    CHECK(parse_vertex_map(text, "a") == expected);
  }
  CHECK(refusal("") == "a: no numbers; give one a line");
  CHECK(refusal("# 1\n").starts_with("a: no numbers;"));
  CHECK(refusal("1\n2 3\n").starts_with("a:2: \"3\" behind the number of the line;"));
  CHECK(refusal("1,2\n").starts_with("a:1: \"1,2\" is not a number;"));
  CHECK(refusal("weight\n1\n").starts_with("a:1: \"weight\" is not a number;"));
  CHECK(refusal("1\nnan\n").starts_with("a:2: \"nan\" is not finite;"));
  CHECK(refusal("1\n1e999\n").starts_with("a:2: \"1e999\" is not finite;"));
  CHECK(refusal(std::string("1\n\0\n", 4)).starts_with("a:2: a NUL byte;"));
}

TEST_CASE("a map as a NumPy array, of any type of number") {
  const std::vector<Real> expected = {1, 0, 100};
  for (const char version : {'\1', '\2'}) {
    CHECK(parse_vertex_map(npy<double>("<f8", {1, 0, 100}, "", version), "a") == expected);
    CHECK(parse_vertex_map(npy<float>("<f4", {1, 0, 100}, "", version), "a") == expected);
  }
  CHECK(parse_vertex_map(npy<std::int64_t>("<i8", {1, 0, 100}), "a") == expected);
  CHECK(parse_vertex_map(npy<std::int32_t>("<i4", {1, 0, 100}), "a") == expected);
  CHECK(parse_vertex_map(npy<std::int16_t>("<i2", {1, 0, 100}), "a") == expected);
  CHECK(parse_vertex_map(npy<std::int8_t>("|i1", {-1, 0, 100}), "a") == std::vector<Real>{-1, 0, 100});
  CHECK(parse_vertex_map(npy<std::uint64_t>("<u8", {1, 0, 100}), "a") == expected);
  CHECK(parse_vertex_map(npy<std::uint32_t>("<u4", {1, 0, 100}), "a") == expected);
  CHECK(parse_vertex_map(npy<std::uint16_t>("<u2", {1, 0, 100}), "a") == expected);
  CHECK(parse_vertex_map(npy<std::uint8_t>("|b1", {1, 0, 1}), "a") == std::vector<Real>{1, 0, 1});
  const std::vector<double> many(100'000, 0.1);
  CHECK(parse_vertex_map(npy<double>("<f8", many), "a") == many);
  const TemporaryFolder folder;
  CHECK(read_vertex_map(folder.write("a.npy", npy<double>("<f8", {1, 0, 100}))) == expected);
}

TEST_CASE("arrays that are no map are refused") {
  const std::vector<double> four = {1, 2, 3, 4};
  CHECK(refusal(npy(">f8", four)).starts_with("a: an array of type '>f8'; save it as float64"));
  CHECK(refusal(npy("<c8", four)).starts_with("a: an array of type '<c8'"));
  CHECK(refusal(npy("|O", four)).starts_with("a: an array of type '|O'"));
  CHECK(refusal(npy("<f8", four, "(2, 2)")).starts_with("a: an array of shape (2, 2); save one of one dimension"));
  CHECK(refusal(npy("<f8", four, "()")).starts_with("a: an array of shape ()"));
  CHECK(refusal(npy("<f8", four, "(-4,)")).starts_with("a: header: 'shape' is"));
  CHECK(refusal(npy("<f8", four, "(99999999999999999999,)")).starts_with("a: header: 'shape' is"));
  CHECK(refusal(npy("<f8", four, "(5,)")).starts_with("a: an array of 5 numbers, but the data of 4;"));
  CHECK(refusal(npy("<f8", four, "(9999999999,)")).starts_with("a: an array of 9999999999 numbers,"));
  CHECK(refusal(npy<double>("<f8", {})).starts_with("a: an array of 0 numbers"));
  CHECK(refusal(npy<double>("<f8", {1, std::numeric_limits<double>::quiet_NaN()}))
            .starts_with("a: number 1 is not finite;"));
  const std::string whole = npy("<f8", four);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CHECK(refusal(whole.substr(0, length)).starts_with("a:"));
  }
}

}  // namespace test_vertex_map
