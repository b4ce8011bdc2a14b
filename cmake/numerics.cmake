# Floating-point rules for Pliant's own targets, the same for every compiler. Contraction is off: whether a·b + c is
# rounded once or twice must not be a compiler's choice. Nothing reads errno after a mathematical function.
add_library(pliant_numerics INTERFACE)
target_compile_options(pliant_numerics INTERFACE -ffp-contract=off -fno-math-errno)
