#include "tests/support/named_driver.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace si::test {

std::string named_driver() {
    const char* name = std::getenv("SI_TEST_DRIVER");
    return name ? name : "";
}

void expect_named_driver() {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    ASSERT_NE(renderer, nullptr);
    ASSERT_NE(std::string(renderer).find(named_driver()), std::string::npos)
        << "this run is meant for " << named_driver() << " (SI_TEST_DRIVER), the context is on " << renderer;
}

}  // namespace si::test
