# Every third-party package, once.

# What the algorithm links, and with it every program that uses the installed library: pliantConfig.cmake makes the same
# calls. Eigen and Threads are part of the interface; fmt is only linked.
set(pliant_library_packages "Eigen3 3.4" "fmt 9" "Threads")

# What pliant::io links besides.
set(pliant_io_packages "")
if(PLIANT_VTU)
  set(pliant_io_packages "ZLIB" "pugixml 1.12")
endif()

# CHOLMOD and OpenBLAS. CHOLMOD's Supernodal, Modify and MatrixOps modules are under the GPL (the others under the
# LGPL), so a program that is linked with this back end and given to others falls under the GPL. Without it Pliant
# factorizes with Eigen, which is slower, and all of it is under permissive or file-wise (MPL) licenses.
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
find_package(CHOLMOD QUIET)
option(PLIANT_CHOLMOD "Factorize with SuiteSparse's CHOLMOD as well as with Eigen; has GPL modules" ${CHOLMOD_FOUND})
if(PLIANT_CHOLMOD)
  list(APPEND pliant_library_packages "CHOLMOD")
endif()
message(STATUS "Pliant: CHOLMOD back end: ${PLIANT_CHOLMOD}")

set(needed_packages ${pliant_library_packages})
if(PLIANT_BUILD_IO)
  list(APPEND needed_packages ${pliant_io_packages})
endif()
foreach(package IN LISTS needed_packages)
  separate_arguments(package UNIX_COMMAND "${package}")
  find_package(${package} REQUIRED)
endforeach()

# Headers that pliant::io's own sources include; nothing of them shows in the interface.
if(PLIANT_BUILD_IO)
  find_package(nlohmann_json 3.11 REQUIRED)
endif()

# What pliant::viewer links besides: windows, with their mouse and keys; OpenGL, with and without a display; what is drawn
# flat on it; WebP decodes the pictures of the list of scenes. Each module of pkg-config has its own name in capitals.
set(pliant_viewer_packages "glfw3 3.3")
set(pliant_viewer_modules "epoxy>=1.5" "egl" "imgui" "libwebp>=1.0")
if(PLIANT_BUILD_VIEWER)
  foreach(package IN LISTS pliant_viewer_packages)
    separate_arguments(package UNIX_COMMAND "${package}")
    find_package(${package} REQUIRED)
  endforeach()
  find_package(PkgConfig REQUIRED)
  foreach(module IN LISTS pliant_viewer_modules)
    string(REGEX REPLACE ">=.*" "" name "${module}")
    string(TOUPPER "${name}" name)
    pkg_check_modules(${name} REQUIRED IMPORTED_TARGET "${module}")
  endforeach()
  # Headers that encode PNG files.
  pkg_check_modules(STB REQUIRED IMPORTED_TARGET stb)
endif()
if(PLIANT_BUILD_CLI)
  find_package(CLI11 2.1 REQUIRED)
endif()
# The Python module is for the system's Python where there is one, whatever else stands first in PATH.
if(PLIANT_BUILD_PYTHON)
  if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python3_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python3 3.9 QUIET COMPONENTS Interpreter Development.Module)
  set(PYTHON_EXECUTABLE "${Python3_EXECUTABLE}")
  find_package(pybind11 2.10 QUIET)
  if(NOT Python3_Development.Module_FOUND OR NOT pybind11_FOUND)
    message(STATUS "Pliant: no Python module, which needs pybind11 2.10 and Python's headers (pybind11-dev, python3-dev)")
    set(PLIANT_BUILD_PYTHON OFF)
  endif()
endif()
if(PLIANT_BUILD_TESTS)
  find_package(doctest 2.4 REQUIRED)
endif()
if(PLIANT_BUILD_STUDIES)
  find_package(tinyobjloader QUIET)
endif()
