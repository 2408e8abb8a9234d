// Reads and compares the texts of errors that tests provoke.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "renderer/base/error.h"
#include "tests/support/text.h"

namespace si::test {

/// Returns the text of the error that an action throws; empty if it throws none.
/// @tparam E type of the expected error; others pass through
template <class E = Error, class Action>
std::string error_text(const Action& action) {
    try {
        action();
    } catch (const E& e) {
        return e.what();
    }
    return {};
}

/// Returns success if a text contains all parts; the failure shows the text.
inline testing::AssertionResult mentions(std::string_view text, std::initializer_list<std::string_view> parts) {
    const std::string fault = lacking(text, parts);
    return fault.empty() ? testing::AssertionSuccess() : testing::AssertionFailure() << fault;
}

/// Returns success if an action throws an error whose text contains all parts.
/// @tparam E type of the expected error; others pass through
template <class E = Error, class Action>
testing::AssertionResult fails_with(const Action& action, std::initializer_list<std::string_view> parts) {
    const std::string text = error_text<E>(action);
    return text.empty() ? testing::AssertionFailure() << "no error" : mentions(text, parts);
}

}  // namespace si::test
