// The example in C is C++ as well.
#include "dump_to_png.c"
