// draw_golden [TABLE-ROW...]: draws the golden pictures of the tests (tests/golden), or those that are named, on
// llvmpipe, and says which have changed. Look at them before you commit them.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/base/output.h"
#include "app/context/headless_context.h"
#include "renderer/base/error.h"
#include "tests/support/golden.h"
#include "tests/support/named_driver.h"

namespace {

void draw(const std::vector<std::string>& names) {
    using namespace si::test;
    const si::HeadlessContext context;
    si::Renderer renderer;
    if (const std::string driver = driver_at_hand(); !driver.starts_with("llvmpipe"))
        throw si::Error("golden pictures are llvmpipe's, and this is " + driver + "; set LIBGL_ALWAYS_SOFTWARE=1");
    std::vector<std::string> left = names;
    for (const std::string& table : golden_tables())
        for (const GoldenPicture& picture : golden_pictures(table)) {
            if (!names.empty() && std::erase(left, picture.name()) == 0) continue;
            const auto file = golden_file(golden_folder(), picture);
            const si::ByteImage before = read_golden(file), now = draw_golden(renderer, picture);
            si::write_png(file, now);
            const bool same = read_golden(file) == before;
            std::printf("%s %s\n", file.c_str(), before.data.empty() ? "new" : same ? "as it was" : "changed");
        }
    if (!left.empty()) throw si::Error("there is no row " + left.front());
}

}  // namespace

int main(int count, char** arguments) {
    try {
        draw({arguments + 1, arguments + count});
    } catch (const std::exception& e) {
        std::fprintf(stderr, "draw_golden: %s\n", e.what());
        return 1;
    }
}
