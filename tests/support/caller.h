// Place in a test from which a helper was called. Debian 12's clang has no std::source_location.
#pragma once

namespace si {

/// Source file and line of a call, for failures that name the test's line in place of the helper's.
struct Caller {
    const char* file = "";
    int line = 0;
    /// Returns the place of the call whose default argument this is.
    static constexpr Caller here(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
        return {file, line};
    }
};

}  // namespace si
