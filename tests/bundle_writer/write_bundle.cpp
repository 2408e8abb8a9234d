// The program of write_bundle.c, compiled as C++.
#include "tests/bundle_writer/write_bundle.c"
