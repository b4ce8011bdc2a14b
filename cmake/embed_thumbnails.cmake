# Writes the C++ source of pliant_viewer::thumbnail_file(), which returns the pictures of scenes as they stand in files.
#   cmake -Dpictures=FILE.webp|FILE.webp|... -Doutput=FILE.cpp -P embed_thumbnails.cmake
cmake_minimum_required(VERSION 3.25)

string(REPLACE "|" ";" pictures "${pictures}")
list(SORT pictures)

set(arrays "")
set(entries "")
foreach(picture IN LISTS pictures)
  cmake_path(GET picture STEM name)
  file(READ "${picture}" bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(MAKE_C_IDENTIFIER "of_${name}" array)
  string(APPEND arrays "constexpr unsigned char ${array}[] = {${bytes}};\n")
  string(APPEND entries "  if (scene == \"${name}\") return ${array};\n")
endforeach()

file(WRITE "${output}" "// Made by cmake/embed_thumbnails.cmake.
#include \"viewer/panels/thumbnails.h\"

namespace pliant_viewer {
namespace {

${arrays}
}  // namespace

std::span<const unsigned char> thumbnail_file([[maybe_unused]] std::string_view scene) {
${entries}  return {};
}

}  // namespace pliant_viewer
")
