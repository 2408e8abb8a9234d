// Implementation of shadow_bundle.h, compiled as C99 for the tests that call it from C++.
#define SHADOW_BUNDLE_IMPLEMENTATION
#include "assets/bundle/shadow_bundle.h"
