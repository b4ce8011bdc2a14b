# The Python module is a shared library that holds the static ones, whose code must run at any address then. Functions
# of Pliant are not replaced by those of other libraries, so they are inlined as in programs.
if(PLIANT_BUILD_PYTHON)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
endif()
if(CMAKE_POSITION_INDEPENDENT_CODE)
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
endif()
