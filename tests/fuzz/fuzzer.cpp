// One fuzzer: libFuzzer's entry over the target that the build names.
#include <algorithm>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto target = std::ranges::find(si::fuzz::targets(), SI_FUZZ_TARGET, &si::fuzz::Target::name);
    target->run({data, size});
    return 0;
}
