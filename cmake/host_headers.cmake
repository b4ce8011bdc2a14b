# For another platform than this machine's: of the third-party packages those without a library of their own, Debian's
# headers. Each is linked to a folder of its own in the build tree, since beside the rest of /usr/include they would
# bring the headers of another C library. find_package finds them there.
set(host_headers "${PROJECT_BINARY_DIR}/packages")
set(PLIANT_HOST_PREFIX "/usr" CACHE PATH "Where the headers of Eigen, fmt, nlohmann-json and doctest are")

# pliant_header_package(PACKAGE TARGET FOLDER): the headers of FOLDER below the prefix's include/ are TARGET.
function(pliant_header_package package target folder)
  set(source "${PLIANT_HOST_PREFIX}/include/${folder}")
  if(NOT EXISTS "${source}")
    message(FATAL_ERROR "Pliant: no ${source}; install the Debian packages that scripts/test_portable.sh lists")
  endif()
  cmake_path(GET folder FILENAME name)
  file(MAKE_DIRECTORY "${host_headers}/${package}")
  file(CREATE_LINK "${source}" "${host_headers}/${package}/${name}" SYMBOLIC)
  pliant_header_target(${package} ${target})
  target_include_directories(${target} SYSTEM INTERFACE "${host_headers}/${package}")
endfunction()

# A package that has TARGET alone, found by find_package in whatever version is asked for.
function(pliant_header_target package target)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  string(TOLOWER "${package}" file)
  file(WRITE "${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${file}-config.cmake" "")
  file(WRITE "${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${file}-config-version.cmake" "set(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
endfunction()

pliant_header_package(Eigen3 Eigen3::Eigen eigen3/Eigen)
pliant_header_package(fmt fmt::fmt fmt)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
pliant_header_package(nlohmann_json nlohmann_json::nlohmann_json nlohmann)
pliant_header_package(doctest doctest::doctest doctest)
