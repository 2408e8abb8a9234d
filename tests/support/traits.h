// Declares traits of tests, by which runs of the tests select.
#pragma once

namespace si::test {

/// Property of a test that decides which runs include the test.
enum class Trait {
    DriverIndependent,  ///< same result on every driver: left out of the run on a second driver
    Repeated,           ///< repetition of one computation or drawing: left out under the sanitizers
    SystemAllocator,    ///< memory counted, or passed between threads: runs with the C library's allocator
    Product,            ///< loop over combinations() or portion(): once more over everything with SI_FULL_PRODUCTS=1
    Later,              ///< duration above three seconds: left out of the quick run, runs in the stage slow
    Slow,               ///< as Later, and left out of the run on a second driver: duration above eight seconds
    Minutes,            ///< duration of minutes: runs in the stage products
    Frame,              ///< import of frames that RenderDoc captured: runs in the stage frames
    Long,               ///< duration of many minutes: run by hand
};

/// Registration of a trait for the tests of a suite. The macros below define static objects of this type. The main
/// program of the tests fails if a registration matches no test.
struct TraitOf {
    /// Registers a trait.
    /// @param name name of the test; null: all tests of the suite
    TraitOf(Trait trait, const char* suite, const char* name);
};

}  // namespace si::test

#define SI_TRAIT_JOIN_(a, b) a##b
#define SI_TRAIT_NAME_(line) SI_TRAIT_JOIN_(si_trait_, line)
/// Registers a trait for all tests of a suite, in each instance: SI_TESTS_ARE(Repeated, Suite).
#define SI_TESTS_ARE(trait, suite)                                  \
    static const ::si::test::TraitOf SI_TRAIT_NAME_(suite##trait) { \
        ::si::test::Trait::trait, #suite, nullptr                   \
    }
/// Registers a trait for one instance of a parameterised suite: SI_INSTANCE_IS(Long, Instance, Suite).
#define SI_INSTANCE_IS(trait, instance, suite)                                \
    static const ::si::test::TraitOf SI_TRAIT_NAME_(instance##suite##trait) { \
        ::si::test::Trait::trait, #instance "/" #suite, nullptr               \
    }
/// Registers a trait for one test, in each instance: SI_TEST_IS(Repeated, Suite, Name).
#define SI_TEST_IS(trait, suite, name)                                    \
    static const ::si::test::TraitOf SI_TRAIT_NAME_(suite##name##trait) { \
        ::si::test::Trait::trait, #suite, #name                           \
    }
