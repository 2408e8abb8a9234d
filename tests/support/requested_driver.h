// Checks that tests draw on the OpenGL driver that the run requests (scripts/on_zink.sh).
#pragma once

#include <string>

namespace si::test {

/// Returns the driver that the run requests by $SI_TEST_DRIVER, a part of GL_RENDERER. Empty: any driver is accepted.
std::string requested_driver();

/// Returns GL_RENDERER of the current context; empty without a context.
std::string current_driver();

/// Fails the running test if the current context is not on requested_driver(). Otherwise a run whose driver does not
/// load would pass on another driver.
void expect_requested_driver();

}  // namespace si::test
