#include "tests/support/shared_context.h"

#include <gtest/gtest.h>

#include <optional>

namespace si::test {
namespace {

// Static objects and exit handlers would end too late: parts of the driver may be gone, while its threads still draw.
struct Shared : testing::EmptyTestEventListener {
    std::optional<HeadlessContext> context{std::in_place};
    // The limit is enough for all tests of a shard, at some 4 MB each on llvmpipe.
    std::shared_ptr<gl::ProgramCache> programs = std::make_shared<gl::ProgramCache>(gl::ShaderSource(), 200);
    void OnTestProgramEnd(const testing::UnitTest&) override {
        context->make_current();
        programs.reset();
        context.reset();
    }
};

Shared& shared() {
    static Shared* made = nullptr;
    if (!made) testing::UnitTest::GetInstance()->listeners().Append(made = new Shared);  // the test framework owns it
    return *made;
}

}  // namespace

HeadlessContext& shared_context() {
    shared().context->make_current();
    return *shared().context;
}

std::shared_ptr<gl::ProgramCache> shared_programs() {
    return shared().programs;
}

}  // namespace si::test
