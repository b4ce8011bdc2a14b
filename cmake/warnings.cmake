# Warnings for Pliant's own targets; never passed on to those who link them.
add_library(pliant_warnings INTERFACE)
target_compile_options(pliant_warnings INTERFACE
  -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${PLIANT_WERROR}>:-Werror>)
