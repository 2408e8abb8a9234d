// Runs the tests of a folder. SI_LEAVE_OUT names traits, separated by commas, whose tests are left out, by default
// "long", and in a list of tests what the quick run leaves out. SI_ONLY names the traits whose tests alone run.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/foreign_jobs.h"
#include "tests/support/missing_reason.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

struct Stated {
    Trait trait;
    std::string suite, name;
};

std::vector<Stated>& stated() {
    static std::vector<Stated> list;
    return list;
}

constexpr struct {
    const char* key;
    Trait trait;
} kTraits[] = {{"driver-independent", Trait::DriverIndependent},
               {"repeated", Trait::Repeated},
               {"system-allocator", Trait::SystemAllocator},
               {"product", Trait::Product},
               {"later", Trait::Later},
               {"slow", Trait::Slow},
               {"minutes", Trait::Minutes},
               {"frames", Trait::Frame},
               {"long", Trait::Long}};

/// Returns googletest's patterns for a suite by itself and as an instance of a parameter.
std::vector<std::string> patterns(const Stated& s) {
    const std::string name = s.name.empty() ? "*" : s.name;
    std::vector<std::string> out = {s.suite + "." + name, "*/" + s.suite + "." + name};
    if (!s.name.empty()) out.insert(out.end(), {s.suite + "." + name + "/*", "*/" + s.suite + "." + name + "/*"});
    return out;
}

bool is_of(const std::string& suite, const Stated& s) {
    return suite == s.suite || suite.ends_with("/" + s.suite);
}

bool means_a_test(const Stated& s) {
    const testing::UnitTest& all = *testing::UnitTest::GetInstance();
    for (int i = 0; i < all.total_test_suite_count(); ++i) {
        const testing::TestSuite& suite = *all.GetTestSuite(i);
        if (!is_of(suite.name(), s)) continue;
        for (int j = 0; j < suite.total_test_count(); ++j) {
            const std::string name = suite.GetTestInfo(j)->name();
            if (s.name.empty() || name == s.name || name.starts_with(s.name + "/")) return true;
        }
    }
    return false;
}

/// Joins the patterns of all tests with one of the traits that a variable names. @returns false for an unknown trait
bool add_patterns(const char* variable, std::string& to) {
    const char* value = std::getenv(variable);
    std::istringstream keys(value ? value : "");
    for (std::string key; std::getline(keys, key, ',');) {
        bool known = false;
        for (const auto& trait : kTraits) {
            if (key != trait.key) continue;
            known = true;
            for (const Stated& s : stated())
                if (s.trait == trait.trait)
                    for (const std::string& pattern : patterns(s)) to += (to.empty() ? "" : ":") + pattern;
        }
        if (!known) {
            std::fprintf(stderr, "%s=%s: no trait %s\n", variable, value, key.c_str());
            return false;
        }
    }
    return true;
}

/// Writes down tests that were skipped because something is missing, for the summary of test.sh. The listing happens at
/// the end of a test, because googletest holds its lock while it reports a part of one.
class LackingTests : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo& test) override {
        for (int i = 0; i < test.result()->total_part_count(); ++i) {
            const testing::TestPartResult& part = test.result()->GetTestPartResult(i);
            const std::string reason = part.message();
            if (!part.skipped() || !reason.starts_with(kMissingReason)) continue;
            const std::string file = SI_TEST_OUTPUT_DIR "/lacking-" + std::to_string(getpid()) + ".txt";
            std::ofstream(file, std::ios::app) << test.test_suite_name() << "." << test.name() << " " << reason << "\n";
        }
    }
};

}  // namespace

TraitOf::TraitOf(Trait trait, const char* suite, const char* name) {
    stated().push_back({trait, suite, name ? name : ""});
}

}  // namespace si::test

int main(int argc, char** argv) {
    using namespace si::test;
    si::foreign_child_main(argc, argv, all_foreign_jobs());
    testing::InitGoogleTest(&argc, argv);
    for (const Stated& s : stated())
        if (!means_a_test(s)) {
            std::fprintf(stderr, "a trait is stated of %s.%s: there is no such test\n", s.suite.c_str(),
                         s.name.c_str());
            return 1;
        }
    std::string filter = testing::GTEST_FLAG(filter), only, without;
    const bool lists = testing::GTEST_FLAG(list_tests);
    if (!std::getenv("SI_ONLY")) setenv("SI_LEAVE_OUT", lists ? "long,minutes,later,slow,frames" : "long", 0);
    // The driver keeps compiled shaders here, also for commands and windows, because compiling takes half of the time.
    setenv("MESA_SHADER_CACHE_DIR", SI_TEST_OUTPUT_DIR "/shader-cache", 0);
    if (!add_patterns("SI_ONLY", only) || !add_patterns("SI_LEAVE_OUT", without)) return 1;
    if (std::getenv("SI_ONLY") && only.empty()) {
        std::fprintf(stderr, "SI_ONLY=%s: no test has such a trait\n", std::getenv("SI_ONLY"));
        return 1;
    }
    if (filter == "*" && !only.empty()) filter = only;
    if (!without.empty()) filter += (filter.find('-') == std::string::npos ? "-" : ":") + without;
    testing::GTEST_FLAG(filter) = filter;
    testing::UnitTest::GetInstance()->listeners().Append(new LackingTests);  // the test framework owns it
    return RUN_ALL_TESTS();
}
