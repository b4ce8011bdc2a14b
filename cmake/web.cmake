# What is special where Emscripten compiles to WebAssembly. Of the third-party packages only those without a library of
# their own can be used there: Debian's headers, each linked to a folder of its own in the build tree, since beside the
# rest of /usr/include they would bring the headers of another C library. find_package finds them there.
set(web_include "${PROJECT_BINARY_DIR}/packages")
set(PLIANT_HOST_PREFIX "/usr" CACHE PATH "Where the headers of Eigen, fmt, nlohmann-json and doctest are")

# pliant_web_package(PACKAGE TARGET FOLDER): the headers of FOLDER below the prefix's include/ are TARGET.
function(pliant_web_package package target folder)
  set(source "${PLIANT_HOST_PREFIX}/include/${folder}")
  if(NOT EXISTS "${source}")
    message(FATAL_ERROR "Pliant: no ${source}; install the Debian packages that scripts/build_web.sh lists")
  endif()
  cmake_path(GET folder FILENAME name)
  file(MAKE_DIRECTORY "${web_include}/${package}")
  file(CREATE_LINK "${source}" "${web_include}/${package}/${name}" SYMBOLIC)
  pliant_web_target(${package} ${target})
  target_include_directories(${target} SYSTEM INTERFACE "${web_include}/${package}")
endfunction()

# A package that has TARGET alone, found by find_package in whatever version is asked for.
function(pliant_web_target package target)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  string(TOLOWER "${package}" file)
  file(WRITE "${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${file}-config.cmake" "")
  file(WRITE "${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${file}-config-version.cmake" "set(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
endfunction()

pliant_web_package(Eigen3 Eigen3::Eigen eigen3/Eigen)
pliant_web_package(fmt fmt::fmt fmt)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
pliant_web_package(nlohmann_json nlohmann_json::nlohmann_json nlohmann)
pliant_web_package(doctest doctest::doctest doctest)
target_compile_definitions(doctest::doctest INTERFACE DOCTEST_CONFIG_NO_POSIX_SIGNALS)
# Threads would need a page that is served with headers of its own (COOP and COEP). Without them the standard library's
# are there, and starting one fails.
pliant_web_target(Threads Threads::Threads)

# Exceptions are those of WebAssembly itself, not calls to JavaScript. The header is what the standard library lacks.
add_compile_options(-fwasm-exceptions "SHELL:-include \"${PROJECT_SOURCE_DIR}/web/support/standard_library.h\"")
add_link_options(-fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB)

# Vectors of 128 bits, which every browser has had since the spring of 2023. The page says so where they are missing.
add_compile_options(-msimd128)
