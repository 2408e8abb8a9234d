// States traits of tests, which runs select by.
#pragma once

namespace si::test {

enum class Trait {
    DriverIndependent,  ///< decided by the program's own code: left out of the run on a second driver
    Repeated,           ///< computes or draws one thing over and over: left out under the sanitizers
    Long,               ///< minutes: run by hand
};

/// Remembers a trait of all tests whose suite and name contain these; `name` is null for all of a suite.
/// The main program of the tests fails when no test is meant.
struct TraitOf {
    TraitOf(Trait trait, const char* suite, const char* name);
};

}  // namespace si::test

#define SI_TRAIT_JOIN_(a, b) a##b
#define SI_TRAIT_NAME_(line) SI_TRAIT_JOIN_(si_trait_, line)
/// SI_TESTS_ARE(Repeated, Suite): all tests of a suite, in each of its instances.
#define SI_TESTS_ARE(trait, suite)                                  \
    static const ::si::test::TraitOf SI_TRAIT_NAME_(suite##trait) { \
        ::si::test::Trait::trait, #suite, nullptr                   \
    }
/// SI_INSTANCE_IS(Long, Instance, Suite): one instance of a suite.
#define SI_INSTANCE_IS(trait, instance, suite)                                \
    static const ::si::test::TraitOf SI_TRAIT_NAME_(instance##suite##trait) { \
        ::si::test::Trait::trait, #instance "/" #suite, nullptr               \
    }
/// SI_TEST_IS(Repeated, Suite, Name): one test, in each of its instances.
#define SI_TEST_IS(trait, suite, name)                                    \
    static const ::si::test::TraitOf SI_TRAIT_NAME_(suite##name##trait) { \
        ::si::test::Trait::trait, #suite, #name                           \
    }
