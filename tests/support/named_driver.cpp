#include "tests/support/named_driver.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace si::test {

std::string named_driver() {
    const char* name = std::getenv("SI_TEST_DRIVER");
    return name ? name : "";
}

std::string driver_at_hand() {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return renderer ? renderer : "";
}

void expect_named_driver() {
    const std::string driver = driver_at_hand();
    ASSERT_FALSE(driver.empty());
    ASSERT_NE(driver.find(named_driver()), std::string::npos)
        << "this run is meant for " << named_driver() << " (SI_TEST_DRIVER), the context is on " << driver;
}

}  // namespace si::test
