// VTK's files of XML, in every way of writing numbers.
#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/mesh/shapes.h"
#include "pliant_io/files/base64.h"
#include "pliant_io/files/compression.h"
#include "tests/mesh/files.h"

namespace test_vtu {

using namespace pliant;
using namespace pliant_tests;

namespace {

Mesh vtu(const std::string& text) {
  return parse_mesh(text, "a", require_mesh_format("a.vtu"));
}

std::string refusal(const std::string& text) {
  return refusal_of(text, require_mesh_format("a.vtu"));
}

/// How a file keeps its arrays.
struct Coding {
  enum Place { ascii, binary, split_binary, appended_raw, appended_base64 } place = ascii;
  bool compressed = false;
  bool long_head = false;
  bool big_endian = false;
  std::size_t block = 16;
};

/// A file of one piece, put together as VTK and others do.
class VtuText {
 public:
  explicit VtuText(const Coding& coding) : coding_(coding) {}

  template <class Number>
  std::string array(const std::string& type, const std::string& attributes, const std::vector<Number>& numbers) {
    const std::string head = fmt::format("<DataArray type=\"{}\" {} ", type, attributes);
    std::string words;
    std::string bytes;
    for (const Number number : numbers) {
      words += fmt::format("{}\n", number);
      bytes += ordered(number);
    }
    if (coding_.place == Coding::ascii) return head + "format=\"ascii\">\n" + words + "</DataArray>\n";
    const auto [front, data] = encoded(bytes);
    if (coding_.place == Coding::binary || coding_.place == Coding::split_binary) {
      const bool is_split = coding_.compressed || coding_.place == Coding::split_binary;
      return head + "format=\"binary\">\n  " + (is_split ? base64(front) + base64(data) : base64(front + data)) +
             "\n</DataArray>\n";
    }
    std::string element = head + fmt::format("format=\"appended\" offset=\"{}\"/>\n", appended_.size());
    const bool is_raw = coding_.place == Coding::appended_raw;
    appended_ += is_raw ? front + data : coding_.compressed ? base64(front) + base64(data) : base64(front + data);
    return element;
  }

  std::string file(const std::string& piece) const {
    const std::string appended = coding_.place < Coding::appended_raw
                                     ? ""
                                     : fmt::format("<AppendedData encoding=\"{}\">\n _{}\n</AppendedData>\n",
                                                   coding_.place == Coding::appended_raw ? "raw" : "base64", appended_);
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"{}\"{}{}>\n"
        "<UnstructuredGrid>\n{}</UnstructuredGrid>\n{}</VTKFile>\n",
        coding_.big_endian ? "BigEndian" : "LittleEndian", coding_.long_head ? " header_type=\"UInt64\"" : "",
        coding_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "", piece, appended);
  }

 private:
  template <class Number>
  std::string ordered(Number number) const {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    if (coding_.big_endian) std::ranges::reverse(bytes);
    return bytes;
  }

  std::string count(std::size_t number) const {
    return coding_.long_head ? ordered(std::uint64_t{number}) : ordered(static_cast<std::uint32_t>(number));
  }

  std::pair<std::string, std::string> encoded(const std::string& bytes) const {
    if (!coding_.compressed) return {count(bytes.size()), bytes};
    std::string sizes;
    std::string data;
    std::size_t blocks = 0;
    for (std::size_t begin = 0; begin < bytes.size(); begin += coding_.block, ++blocks) {
      const std::string one = compressed(bytes.substr(begin, coding_.block));
      sizes += count(one.size());
      data += one;
    }
    return {count(blocks) + count(coding_.block) + count(bytes.size() % coding_.block) + sizes, data};
  }

  Coding coding_;
  std::string appended_;
};

const std::vector<double> coordinates = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
const Positions five = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}).vertices;

template <class Number>
std::vector<Number> as(const std::vector<double>& numbers) {
  std::vector<Number> result;
  result.reserve(numbers.size());
  for (const double number : numbers) result.push_back(static_cast<Number>(number));
  return result;
}

/// Five points, a triangle, a quadrilateral and a line, with a map.
template <class Coordinate, class Integer>
std::string mixed_file(const Coding& coding, const std::string& real, const std::string& integer) {
  VtuText text(coding);
  return text.file(
      "<Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">\n<PointData Scalars=\"w\">\n" +
      text.array(real, "Name=\"w\"", as<Coordinate>({1, 2, 3, 4, 5})) +
      text.array(real, "Name=\"v\" NumberOfComponents=\"3\"", as<Coordinate>(coordinates)) +
      "</PointData>\n<CellData></CellData>\n<Points>\n" +
      text.array(real, "Name=\"Points\" NumberOfComponents=\"3\"", as<Coordinate>(coordinates)) +
      "</Points>\n<Cells>\n" + text.array(integer, "Name=\"connectivity\"", as<Integer>({0, 1, 2, 0, 1, 4, 2, 3, 4})) +
      text.array(integer, "Name=\"offsets\"", as<Integer>({3, 7, 9})) +
      text.array(std::string("UInt8"), "Name=\"types\"", std::vector<std::uint8_t>{5, 9, 3}) + "</Cells>\n</Piece>\n");
}

void check_mixed(const Mesh& mesh) {
  CHECK(mesh.vertices == five);
  CHECK(mesh.faces.vertices == std::vector<Index>{0, 1, 2, 0, 1, 4, 2});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 4}, {0, 4, 2}});
  CHECK(mesh.edges == std::vector<Edge>{{3, 4}});
  REQUIRE(mesh.maps.size() == 1);
  CHECK(mesh.maps[0].name == "w");
  CHECK(mesh.maps[0].values == std::vector<Real>{1, 2, 3, 4, 5});
}

/// A file of text whose parts can be put in.
std::string ascii_file(const std::string& points, const std::string& corners, const std::string& ends,
                       const std::string& types, int cells = 1) {
  return fmt::format(
      "<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"4\" NumberOfCells=\"{}\">\n"
      "<Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">{}</DataArray>\n</Points>\n"
      "<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">{}</DataArray>\n"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">{}</DataArray>\n"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">{}</DataArray>\n"
      "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
      cells, points, corners, ends, types);
}

const std::string four = "0 0 0 1 0 0 0 1 0 0 0 1";

}  // namespace

TEST_CASE("a .vtu file in every encoding, order of bytes and size of counts") {
  for (const auto place :
       {Coding::ascii, Coding::binary, Coding::split_binary, Coding::appended_raw, Coding::appended_base64}) {
    for (int bits = 0; bits < 8; ++bits) {
      const Coding coding{place, (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
      CAPTURE(place);
      CAPTURE(bits);
      check_mixed(vtu(mixed_file<double, std::int64_t>(coding, "Float64", "Int64")));
      check_mixed(vtu(mixed_file<float, std::int32_t>(coding, "Float32", "Int32")));
      check_mixed(vtu(mixed_file<std::int16_t, std::uint64_t>(coding, "Int16", "UInt64")));
      check_mixed(vtu(mixed_file<std::uint8_t, std::uint32_t>(coding, "UInt8", "UInt32")));
      check_mixed(vtu(mixed_file<std::int8_t, std::uint16_t>(coding, "Int8", "UInt16")));
    }
  }
  check_mixed(vtu(mixed_file<double, std::int64_t>({Coding::binary, true, true, false, 1 << 20}, "Float64", "Int64")));
}

TEST_CASE("every truncation of a .vtu file is refused, however its numbers are kept") {
  for (const auto place : {Coding::ascii, Coding::binary, Coding::appended_raw, Coding::appended_base64}) {
    for (const bool is_compressed : {false, true}) {
      const std::string text = mixed_file<float, std::int32_t>({place, is_compressed}, "Float32", "Int32");
      for (std::size_t length = 0; length + 1 < text.size(); ++length) {
        const std::string message = refusal(text.substr(0, length));
        if (message.empty()) FAIL("cut at " << length);
        CHECK(message.find('\n') == std::string::npos);
      }
    }
  }
}

TEST_CASE("tetrahedra of a .vtu file, without what borders them; every kind of mesh is written and read back") {
  const Mesh mesh = vtu(ascii_file(four, "0 1 2 3 0 1 3 2 0 1 2 0 1", "4 8 11 13", "10 10 5 3", 4));
  CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 1, 2, 3}});
  CHECK(mesh.triangles.empty());
  CHECK(mesh.edges.empty());
  Mesh mapped = grid({});
  mapped.maps = {{"a <&\"'> \xC3\xA4", std::vector<Real>(static_cast<std::size_t>(mapped.vertex_count()), 1.0 / 3)}};
  for (const Mesh& each : {bar({.cells = {2, 1, 1}}), chain({}), mapped, mesh_of({{1, 2, 3}})}) {
    const Mesh once = written_and_read(each, "b.vtu");
    check_same_elements(once, each);
    REQUIRE(once.maps.size() == each.maps.size());
    if (!once.maps.empty()) CHECK(once.maps[0].name == each.maps[0].name);
    check_same(written_and_read(once, "b.vtu"), once);
  }
}

TEST_CASE("pieces of a .vtu file follow each other") {
  const std::string one = ascii_file(four, "0 1 2", "3", "5");
  const std::size_t begin = one.find("<Piece"), end = one.find("</UnstructuredGrid>");
  const Mesh mesh = vtu(one.substr(0, end) + one.substr(begin, end - begin) + one.substr(end));
  CHECK(mesh.vertex_count() == 8);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {4, 5, 6}});
}

TEST_CASE("a map that is not finite is left out, and one of a name that there is already") {
  const std::string text = ascii_file(four, "0 1 2", "3", "5");
  const auto with = [&](const std::string& arrays) {
    std::string changed = text;
    return changed.insert(text.find("<Cells>"), "<PointData>" + arrays + "</PointData>\n");
  };
  const auto array = [](const std::string& name, const std::string& numbers) {
    return fmt::format("<DataArray type=\"Float32\" Name=\"{}\" format=\"ascii\">{}</DataArray>", name, numbers);
  };
  const Mesh mesh = vtu(with(array("a", "1 2 nan 4") + array("b", "1 2 3 4") + array("b", "4 3 2 1")));
  REQUIRE(mesh.maps.size() == 1);
  CHECK(mesh.maps[0].values == std::vector<Real>{1, 2, 3, 4});
  CHECK(refusal(with(array("a", "1 2 3"))).starts_with("a:7: array \"a\": 3 numbers in place of 4;"));
}

TEST_CASE("a malformed .vtu file is refused with its place") {
  const auto check = [](const std::string& text, const std::string& start) {
    const std::string message = refusal(text);
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find("; ") != std::string::npos);
  };
  check("", "a:1: this is not well-formed XML");
  check("<a>\n<b>\n</a>\n", "a:3: this is not well-formed XML: Start-end tags mismatch;");
  check("<a/>", "a: no element VTKFile;");
  check("<VTKFile type=\"PolyData\"/>", "a:1: a dataset of type \"PolyData\"; save an UnstructuredGrid");
  check("\n<VTKFile type=\"UnstructuredGrid\"/>", "a:2: no element UnstructuredGrid;");
  check("<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\"><UnstructuredGrid/></VTKFile>",
        "a:1: compressed by \"vtkLZ4DataCompressor\"; save it compressed by zlib");
  check("<VTKFile type=\"UnstructuredGrid\" header_type=\"Int8\"><UnstructuredGrid/></VTKFile>",
        "a:1: header_type \"Int8\";");
  check("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid/></VTKFile>", "a: no points;");
  check(ascii_file("0 0 0", "0 1 2", "3", "5"), "a:5: array \"\": 3 numbers in place of 12;");
  check(ascii_file(four + " 1", "0 1 2", "3", "5"), "a:5: array \"\": 13 numbers in place of 12;");
  check(ascii_file("0 0 0 1 0 0 0 1 0 0 0 inf", "0 1 2", "3", "5"), "a:5: a coordinate of vertex 3 is not finite;");
  check(ascii_file("0 0 0 1 0 0 0 1 0 0 0 x", "0 1 2", "3", "5"), "a:5: array \"\": \"x\" is not a number;");
  check(ascii_file(four, "0 1 4", "3", "5"), "a:8: array \"connectivity\": vertex 4 is out of range; use 0 to 3");
  check(ascii_file(four, "0 1 -1", "3", "5"), "a:8: array \"connectivity\": vertex -1 is out of range;");
  check(ascii_file(four, "0 1 2", "4", "5"), "a:9: array \"offsets\": end 4 is out of range; use 0 to 3");
  check(ascii_file(four, "0 1 2", "3", "5 5"), "a:7: 1 cells with 1 offsets and 2 types;");
  check(ascii_file(four, "0 1 2", "3 2", "5 5", 2), "a:7: cell 1: its offset is 2 behind one of 3;");
  check(ascii_file(four, "0 1 2", "3", "12"), "a:7: cell 0: a hexahedron (type 12);");
  check(ascii_file(four, "0 1 2", "3", "10"), "a:7: cell 0: 3 corners for a cell of type 10, which has 4;");
  check(ascii_file(four, "0 1 1", "3", "5"), "a:7: cell 0: a face with vertex 1 at two corners;");
  check(ascii_file(four, "0 1 2", "3", "5", 2000000000), "a:7: 2000000000 cells with 1 offsets");
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = ascii_file(four, "0 1 2", "3", "5");
    return text.replace(text.find(from), from.size(), to);
  };
  check(changed("NumberOfPoints=\"4\"", "NumberOfPoints=\"2000000000\""), "a:3: 2000000000 points, more than");
  check(changed("NumberOfPoints=\"4\"", "NumberOfPoints=\"-4\""), "a:3: NumberOfPoints: -4,");
  check(changed("NumberOfPoints=\"4\"", ""), "a:3: NumberOfPoints: \"\" is not an index;");
  check(changed("\"connectivity\"", "\"c\""), "a:7: cells without an array \"connectivity\";");
  check(changed("\"Float32\"", "\"String\""), "a:5: array \"\": type \"String\"; save numbers");
  check(changed("\"Int64\"", "\"Float32\""), "a:8: array \"connectivity\": floats;");
  check(changed("NumberOfComponents=\"3\"", ""), "a:5: points that have not 3 coordinates;");
  check(changed("format=\"ascii\"", "format=\"raw\""), "a:5: array \"\": format \"raw\";");
  check(changed("format=\"ascii\"", "format=\"appended\" offset=\"9\""), "a:5: offset: 9, where there is room for");
  check(changed("format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1", "format=\"binary\">////////AAAA"),
        "a:5: array \"\": 4294967295 bytes announced,");
  check(changed("format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1", "format=\"binary\">!"),
        "a:5: array \"\": no count of bytes");
  check(std::string("<a>\0</a>", 8), "a:1: a NUL byte;");
}

TEST_CASE("what a compressed .vtu file claims is held against its size") {
  const auto file = [](const std::string& data) {
    std::string text = ascii_file(four, "0 1 2", "3", "5");
    const std::string from = "format=\"ascii\">" + four;
    text.replace(text.find(from), from.size(), "format=\"binary\">" + data);
    return text.replace(text.find('>'), 1, " compressor=\"vtkZLibDataCompressor\">");
  };
  const auto head = [](std::vector<std::uint32_t> numbers) {
    std::string bytes(4 * numbers.size(), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return base64(bytes);
  };
  const std::string zeros = compressed(std::string(48, '\0'));
  const auto size = static_cast<std::uint32_t>(zeros.size());
  CHECK(refusal(file(head({1, 48, 0, size}) + base64(zeros))) == "");
  const auto check = [&](const std::string& data, const std::string& part) {
    const std::string message = refusal(file(data));
    CAPTURE(message);
    CHECK(message.starts_with("a:5: array \"\": " + part));
  };
  check(head({1, 47, 0, size}) + base64(zeros), "compressed block 0 is damaged;");
  check(head({1, 49, 0, size}) + base64(zeros), "compressed block 0 is damaged;");
  check(head({1, 48, 0, size}) + base64(zeros.substr(0, 5)), "");
  check(head({1, 48, 0, size}) + base64(std::string(zeros.size(), 'x')), "compressed block 0 is damaged;");
  check(head({4000000000, 48, 0, size}), "4000000000 compressed blocks,");
  check(head({1, 4000000000, 0, size}) + base64(zeros), "a block of");
  check(head({1, 48, 0, 4000000000}) + base64(zeros), "4000000000 bytes announced,");
  // A bomb that is one: 64 MB of zeros in 64 KB.
  const std::string bomb = compressed(std::string(64 << 20, '\0'));
  check(head({1, 64 << 20, 0, static_cast<std::uint32_t>(bomb.size())}) + base64(bomb),
        "67108864 bytes, more than a file of this size holds;");
}

}  // namespace test_vtu
