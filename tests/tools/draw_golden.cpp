// draw_golden [-o DIR] [ROW...]: draws golden pictures of the tests (tests/golden) on llvmpipe and prints which
// changed. ROW is a choice (filter.kernel=tent3) or the picture's name (filters-tent3). Without a ROW all are drawn. -o
// DIR writes to another folder. Look at the pictures before you commit them.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/base/output.h"
#include "app/context/headless_context.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/settings/param.h"
#include "tests/support/golden.h"
#include "tests/support/requested_driver.h"

namespace {

using si::test::GoldenPicture;

std::vector<GoldenPicture> all_pictures() {
    std::vector<GoldenPicture> all;
    for (const std::string& table : si::test::golden_tables())
        for (GoldenPicture& picture : si::test::golden_pictures(table)) all.push_back(std::move(picture));
    return all;
}

/// Returns the pictures of the rows, or all pictures without rows. @throws UsageError naming the nearest row
std::vector<GoldenPicture> chosen_pictures(const std::vector<std::string>& rows) {
    const std::vector<GoldenPicture> all = all_pictures();
    if (rows.empty()) return all;
    std::vector<GoldenPicture> chosen;
    for (const std::string& row : rows) {
        const std::size_t before = chosen.size();
        std::vector<std::string> names;
        for (const GoldenPicture& picture : all) {
            if (picture.name() == row || picture.choice() == row) chosen.push_back(picture);
            names.push_back(row.find('=') == std::string::npos ? picture.name() : picture.choice());
        }
        if (chosen.size() == before)
            throw si::UsageError(
                fmt::format("there is no golden picture of {}{}", row, si::did_you_mean(si::nearest_name(row, names))));
    }
    return chosen;
}

void draw(const std::vector<std::string>& rows, const std::filesystem::path& folder) {
    const std::vector<GoldenPicture> pictures = chosen_pictures(rows);
    const si::HeadlessContext context;
    si::Renderer renderer;
    if (const std::string driver = si::test::current_driver(); !driver.starts_with("llvmpipe"))
        throw si::Error("golden pictures are llvmpipe's, and this is " + driver + "; set LIBGL_ALWAYS_SOFTWARE=1");
    for (const GoldenPicture& picture : pictures) {
        const auto file = golden_file(folder, picture);
        const si::ByteImage before = si::test::read_golden(file);
        const si::ByteImage now = draw_golden(renderer, picture);
        si::write_png(file, now);
        const bool same = si::test::read_golden(file) == before;
        std::printf("%s %s\n", file.c_str(), before.data.empty() ? "new" : same ? "unchanged" : "changed");
    }
}

}  // namespace

int main(int count, char** arguments) {
    try {
        std::vector<std::string> rows(arguments + 1, arguments + count);
        std::filesystem::path folder = si::test::golden_folder();
        if (rows.size() >= 2 && rows[0] == "-o") {
            folder = rows[1];
            rows.erase(rows.begin(), rows.begin() + 2);
        }
        draw(rows, folder);
    } catch (const si::UsageError& e) {
        std::fprintf(stderr, "draw_golden: %s\n", e.what());
        return 2;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "draw_golden: %s\n", e.what());
        return 1;
    }
}
