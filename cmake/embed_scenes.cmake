# Writes the C++ source of a function that returns scenes, std::span<const pliant::BuiltinScene> NAMESPACE::FUNCTION().
#   cmake -Dscenes=FILE|FILE|... -Dfolder=FOLDER -Dheader=HEADER -Dnamespace=NAMESPACE -Dfunction=FUNCTION
#     -Doutput=FILE.cpp -P embed_scenes.cmake
# A scene's name is its path below the folder, without ".json".
# A scene becomes a sequence of raw string literals, which the compiler joins. They are cut at line ends, below the
# 16 kB that every compiler accepts, and never inside a character.
cmake_minimum_required(VERSION 3.25)

set(piece_bytes 15000)

# Sets `result` to C++ string literals that hold the text of `file`.
function(to_literals file result)
  file(READ "${file}" text)
  set(literals "")
  string(LENGTH "${text}" left)
  while(left GREATER 0)
    string(SUBSTRING "${text}" 0 ${piece_bytes} piece)
    if(left GREATER piece_bytes)
      string(FIND "${piece}" "\n" last_line_end REVERSE)
      if(last_line_end EQUAL -1)
        message(FATAL_ERROR "${file}: a line is longer than ${piece_bytes} bytes; break it, or shorten the scene")
      endif()
      math(EXPR length "${last_line_end} + 1")
      string(SUBSTRING "${piece}" 0 ${length} piece)
    endif()
    string(LENGTH "${piece}" length)
    string(SUBSTRING "${text}" ${length} -1 text)
    string(LENGTH "${text}" left)
    string(APPEND literals "\n        R\"scene(${piece})scene\"sv")
  endwhile()
  set(${result} "${literals}" PARENT_SCOPE)
endfunction()

string(REPLACE "|" ";" scenes "${scenes}")
list(SORT scenes)
list(LENGTH scenes scene_count)

set(entries "")
foreach(scene IN LISTS scenes)
  cmake_path(RELATIVE_PATH scene BASE_DIRECTORY "${folder}" OUTPUT_VARIABLE name)
  string(REGEX REPLACE "\\.json$" "" name "${name}")
  to_literals("${scene}" literals)
  string(APPEND entries "    pliant::BuiltinScene{\"${name}\",${literals}},\n")
endforeach()

file(WRITE "${output}" "// Made by cmake/embed_scenes.cmake.
#include \"${header}\"

#include <array>
#include <string_view>

namespace ${namespace} {
namespace {

using namespace std::string_view_literals;  // whose lengths compilers need not count

constexpr std::array<pliant::BuiltinScene, ${scene_count}> scenes{
${entries}};

}  // namespace

std::span<const pliant::BuiltinScene> ${function}() { return scenes; }

}  // namespace ${namespace}
")
