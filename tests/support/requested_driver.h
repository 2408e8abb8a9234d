// Runs of the tests on a driver that is not the machine's own (scripts/on_zink.sh).
#pragma once

#include <string>

namespace si::test {

/// The driver that this run is meant to be on (SI_TEST_DRIVER, a part of GL_RENDERER); empty when any will do.
std::string requested_driver();

/// GL_RENDERER of the current context.
std::string current_driver();

/// Fails the running test when the current context is not on requested_driver(): a driver that does not come up, and
/// another that takes its place, would else pass for it.
void expect_requested_driver();

}  // namespace si::test
