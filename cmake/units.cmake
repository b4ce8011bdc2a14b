# pliant_units(TARGET [SEPARATE FOLDER...]): the sources of a folder directly below the target's, with all folders in it,
# compile as one unit (CMAKE_UNITY_BUILD), so that headers are read once a folder and not once a file: a third of the time.
# Large folders further down are units of their own. Names in anonymous namespaces are therefore unique in a unit. A
# source that cannot share one is given SKIP_UNITY_BUILD_INCLUSION; -DCMAKE_UNITY_BUILD=OFF compiles each by itself.
function(pliant_units target)
  cmake_parse_arguments(PARSE_ARGV 1 units "" "" "SEPARATE")
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH place)
    cmake_path(RELATIVE_PATH place BASE_DIRECTORY "${folder}" OUTPUT_VARIABLE place)
    if(NOT place IN_LIST units_SEPARATE)
      string(REGEX REPLACE "/.*" "" place "${place}")
    endif()
    string(MAKE_C_IDENTIFIER "${place}" group)
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# pliant_quick_to_compile(TARGET [SMALL]): of what draws, asks or reports, whose time goes into the libraries. -O3 would
# make it a quarter longer to compile, and no faster. SMALL: what is sent to browsers is as small as can be there; with
# -Os clang leaves Eigen's functions of one line as calls, 30 to 100 times as slow where they compute.
function(pliant_quick_to_compile target)
  cmake_parse_arguments(PARSE_ARGV 1 quick "SMALL" "" "")
  set(level -O1)
  if(EMSCRIPTEN AND quick_SMALL)
    set(level -Os)
  endif()
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()
