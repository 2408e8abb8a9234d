// Random events and files for the editor, from a seed.
#include "tests/ui/monkey.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <random>
#include <string_view>

#include "app/session/presets.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/process.h"
#include "tests/support/random_settings.h"
#include "tests/ui/screen.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

const Words kKeys =
    "F1 Escape Escape Return Tab space Delete BackSpace Home End Left Right Up Down Next Prior f l k m b "
    "comma period 1 2 3 4 5 6 7 8 9 0 w a s d q e ctrl+z ctrl+z ctrl+y ctrl+o ctrl+s ctrl+a ctrl+c ctrl+v "
    "ctrl+x minus shift+Tab ctrl+shift+s ctrl+shift+c ctrl+r F5 F11 alt+F super";

constexpr std::array kTexts = {"0",    "-1",     "1e9",    "nan",  "inf",   "0.5", "512",     "16384",
                               "bias", "filter", "shadow", "%s%n", "../..", "/",   "x y.glb", "{\"a\":"};

class Monkey {
public:
    Monkey(std::uint32_t seed, std::size_t files) : random_(seed), files_(files) {}

    std::string next() {
        const int kind = below(100);
        if (kind < 30) return "xdotool " + click();
        if (kind < 36) return fmt::format("xdotool {} click --repeat 2 --delay 60 1", move());
        if (kind < 56) return "xdotool " + drag();
        if (kind < 64)
            return fmt::format("xdotool {} click --repeat {} --delay 5 {}", move(), 1 + below(12), 4 + below(2));
        if (kind < 82) return fmt::format("xdotool key {}", kKeys[std::size_t(below(int(kKeys.size())))]);
        if (kind < 88)
            return fmt::format("xdotool type --delay 5 '{}'", kTexts[std::size_t(below(int(kTexts.size())))]);
        if (kind < 91) return fly();
        if (kind < 94) return resize();
        if (kind < 97 && files_ > 0)
            return fmt::format("drop {} {} {}", below(int(files_)), below(width_), below(height_));
        return fmt::format("pause {}", 20 << below(5));
    }

private:
    // Own distributions, since those of the standard library differ between implementations.
    int below(int n) { return int(random_() % std::uint32_t(std::max(n, 1))); }
    std::string at() { return fmt::format("{} {}", below(width_), below(height_)); }
    std::string move() { return "mousemove " + at(); }
    int button() { return below(5) < 4 ? 1 : 2 + below(2); }
    std::string held() {
        static constexpr std::array kHeld = {"", "", "", "ctrl", "shift"};
        return kHeld[std::size_t(below(int(kHeld.size())))];
    }
    static std::string under(const std::string& key, const std::string& what) {
        return key.empty() ? what : fmt::format("keydown {0} {1} keyup {0}", key, what);
    }
    std::string click() {
        const std::string to = move();
        return fmt::format("{} {}", to, under(held(), fmt::format("click {}", button())));
    }
    std::string drag() {
        const std::string from = move(), key = held();
        const int b = button();
        std::string way;
        for (int steps = 1 + below(4); steps > 0; --steps) way += move() + " ";
        return fmt::format("{} {}", from, under(key, fmt::format("mousedown {0} {1}mouseup {0}", b, way)));
    }
    std::string fly() {
        static constexpr std::array kWays = {"w", "a", "s", "d", "q", "e"};
        const char* way = kWays[std::size_t(below(int(kWays.size())))];
        const std::string from = move(), to = move();
        return fmt::format("xdotool {} mousedown 3 keydown {} sleep 0.1 {} keyup {} mouseup 3", from, way, to, way);
    }
    std::string resize() {
        static constexpr std::array<std::pair<int, int>, 7> kSizes = {
            {{kWidth, kHeight}, {kWidth, kHeight}, {1000, 600}, {640, 480}, {320, 700}, {900, 120}, {60, 40}}};
        std::tie(width_, height_) = kSizes[std::size_t(below(int(kSizes.size())))];
        return fmt::format("size {} {}", width_, height_);
    }

    std::mt19937 random_;
    std::size_t files_;
    int width_ = kWidth, height_ = kHeight;
};

void write_text(const fs::path& file, std::string_view bytes) {
    std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

}  // namespace

std::vector<std::string> monkey_events(std::uint32_t seed, int count, std::size_t files) {
    Monkey monkey(seed, files);
    std::vector<std::string> events;
    for (int i = 0; i < count; ++i) events.push_back(monkey.next());
    return events;
}

std::vector<fs::path> monkey_files(const fs::path& folder) {
    fs::create_directories(folder);
    std::vector<fs::path> files;
    const auto file = [&](const std::string& name) { return files.emplace_back(folder / name); };
    for (const char* scene : {"boxes", "figures", "plane"})
        EXPECT_EQ(run_program({"export", scene, "-o", file(std::string(scene) + ".glb").string()}).code, 0);
    const std::string whole = file_bytes(files.front());
    write_text(file("half.glb"), std::string_view(whole).substr(0, whole.size() / 2));
    std::string damaged = whole;
    for (std::size_t i = 20; i < damaged.size(); i += 97) damaged[i] = char(damaged[i] ^ 0x55);
    write_text(file("damaged.glb"), damaged);
    write_text(file("empty.gltf"), "");
    write_text(file("no scene.txt"), "neither scene nor preset");
    write_text(file("deep.json"), std::string(100'000, '['));
    write_text(file("newer.json"), R"({"format": "shadow-inspector-preset", "version": 999, "settings": {}})");
    write_text(file("elsewhere.json"),
               R"({"format": "shadow-inspector-preset", "version": 3, "scene": "gone.glb", "settings": {}})");
    write_text(
        file("nan.json"),
        R"({"format": "shadow-inspector-preset", "version": 3, "scene": "boxes", "settings": {"bias.normal": 1e999}})");
    for (unsigned seed = 0; seed < 8; ++seed) {
        const RandomCase of = random_case(seed * 25);
        save_preset({.title = "", .topic = "", .about = "", .scene = of.scene, .settings = of.settings},
                    file(fmt::format("random {}.json", seed)));
    }
    fs::create_directories(file("folder.gltf"));
    files.push_back(folder / "not there.glb");
    return files;
}

}  // namespace si::test
