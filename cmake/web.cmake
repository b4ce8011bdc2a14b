# What is special where Emscripten compiles to WebAssembly, besides host_headers.cmake.
target_compile_definitions(doctest::doctest INTERFACE DOCTEST_CONFIG_NO_POSIX_SIGNALS)
# Threads would need a page that is served with headers of its own (COOP and COEP). Without them the standard library's
# are there, and starting one fails.
pliant_header_target(Threads Threads::Threads)

# Exceptions are those of WebAssembly itself, not calls to JavaScript. The header is what the standard library lacks.
add_compile_options(-fwasm-exceptions "SHELL:-include \"${PROJECT_SOURCE_DIR}/web/support/standard_library.h\"")
add_link_options(-fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB)

# Vectors of 128 bits, which every browser has had since the spring of 2023. The page says so where they are missing.
# Not by the compiler itself from single numbers in a row (SLP): what clang 14 makes of the collision code so lets a
# vertex through a sheet.
add_compile_options(-msimd128 -fno-slp-vectorize)
