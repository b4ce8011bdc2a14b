# What is special where GCC compiles for Windows. There it takes an inline function that it has compiled for the one
# that is called, though the linker may choose that of another source, compiled with other options: what it knows of the
# registers and the alignment of the stack from the one does not hold for the other, and loops end early. So GCC must not
# rely on it.
add_compile_options(-fno-ipa-ra -fno-ipa-stack-alignment)
