// One fuzzer: libFuzzer's entry over the target that the build names.
#include <algorithm>

#include "renderer/scenes/foreign_jobs.h"
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    si::foreign_child_main(*argc, *argv, si::foreign_jobs());
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto target = std::ranges::find(si::fuzz::targets(), SI_FUZZ_TARGET, &si::fuzz::Target::name);
    target->run({data, size});
    return 0;
}
