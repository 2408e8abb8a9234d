#include "tests/support/requested_driver.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace si::test {

std::string requested_driver() {
    const char* name = std::getenv("SI_TEST_DRIVER");
    return name ? name : "";
}

std::string current_driver() {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return renderer ? renderer : "";
}

void expect_requested_driver() {
    const std::string driver = current_driver();
    ASSERT_FALSE(driver.empty());
    ASSERT_NE(driver.find(requested_driver()), std::string::npos)
        << "this run is meant for " << requested_driver() << " (SI_TEST_DRIVER), the context is on " << driver;
}

}  // namespace si::test
