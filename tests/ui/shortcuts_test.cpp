// Tests of the shortcut table: consistent rows, a complete overview, and keys of menus and tooltips read from the
// table.
#include "ui/state/shortcuts.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "renderer/base/index_of.h"
#include "renderer/settings/overlays.h"
#include "tests/ui/ui_harness.h"
#include "ui/widgets/overlay_widget.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

bool can_coincide(Modifier a, Modifier b) {
    return a == Modifier::Any || b == Modifier::Any || a == b;
}

/// Returns whether one press can match both chords.
bool can_coincide(const Chord& a, const Chord& b) {
    const bool same_key = a.mapped == b.mapped && a.first <= b.last && b.first <= a.last;
    return same_key && can_coincide(a.ctrl, b.ctrl) && can_coincide(a.shift, b.shift) && can_coincide(a.alt, b.alt);
}

std::string without_spaces(std::string text) {
    std::erase(text, ' ');
    return text;
}

TEST(Shortcuts, NoKeyDoesTwoThings) {
    const auto rows = shortcuts();
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Shortcut &a = rows[i], &b = rows[j];
            if (a.chord.first < 0 || b.chord.first < 0) continue;
            EXPECT_FALSE(can_coincide(a.chord, b.chord) && si::can_coincide(a.when, b.when))
                << chord_text(a.chord) << ": " << a.label << " and " << b.label;
        }
}

TEST(Shortcuts, EveryCommandHasARow) {
    std::set<Command> found;
    for (const Shortcut& row : shortcuts()) found.insert(row.command);
    for (int i = 0; i <= index_of(Command::CloseOverview); ++i) EXPECT_TRUE(found.contains(Command(i))) << i;
}

TEST(Shortcuts, OnlyHeldKeysAndGesturesHaveNoAction) {
    for (const Shortcut& row : shortcuts()) {
        const bool polled = row.when == When::Flying || row.command == Command::MouseGesture;
        EXPECT_EQ(row.action == nullptr, polled) << chord_text(row.chord);
        EXPECT_EQ(row.chord.first < 0, row.command == Command::MouseGesture) << chord_text(row.chord);
    }
}

TEST(Shortcuts, OverviewListsAllKeys) {
    UiHarness ui(1600, 1000);
    ui.frames(2);
    ui.key(290);  // F1
    ui.frames(3);
    EXPECT_TRUE(ui.state.window.show_shortcuts);
    for (const Shortcut& row : shortcuts()) {
        EXPECT_TRUE(ui.drawn().shows(without_spaces(chord_text(row.chord)))) << chord_text(row.chord);
        EXPECT_TRUE(row.label[0] == '\0' || ui.drawn().shows(without_spaces(row.label))) << row.label;
    }
    ui.key(256 + ImGuiKey_Escape);
    EXPECT_FALSE(ui.state.window.show_shortcuts);
}

TEST(Shortcuts, OverlayKeysComeFromTheTable) {
    std::set<std::string> keys;
    for (const Shortcut& row : shortcuts())
        if (row.command == Command::ToggleOverlay)
            for (int k = row.chord.first; k <= row.chord.last; ++k)
                for (const char* held : {"", "Shift+", "Alt+", "Shift+Alt+"})
                    keys.insert(held + std::string(1, char(k)));
    for (std::size_t i = 0; i < overlays().size(); ++i) {
        const std::string key = overlay_key(int(i) + 1);
        EXPECT_TRUE(key.empty() || keys.contains(key)) << key;
    }
}

/// Texts of menus, tooltips and messages name keys only by key_text() and with_key().
TEST(Shortcuts, NoTextHardCodesAKey) {
    const std::regex literal(R"re("(?:\\.|[^"\\\n])*")re");
    const std::regex key(
        R"re(\b(Ctrl|Shift|Alt)\+[A-Z0-9]|\bF[0-9]+\b|\bPage (up|down)\b|\((Esc|Space|Home|[A-Z])\)|^"(Esc|Space)"$|\b[Kk]ey [A-Z]\b|\b[B-HJ-Z] (pins|shows|compares|takes|changes|hides|frames|does)\b)re");
    const fs::path root = SI_SOURCE_DIR;
    std::size_t read = 0;
    for (const char* folder : {"ui", "app/editor"})
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const fs::path& path = entry.path();
            if (path.extension() != ".cpp" && path.extension() != ".h") continue;
            if (path.filename() == "shortcuts.cpp" || path.filename() == "shortcuts.h") continue;
            ++read;
            std::ifstream in(path);
            for (std::string line; std::getline(in, line);) {
                line = line.substr(0, line.find("//"));
                for (std::sregex_iterator it(line.begin(), line.end(), literal), end; it != end; ++it)
                    EXPECT_FALSE(std::regex_search(it->str(), key)) << path << ": " << it->str();
            }
        }
    EXPECT_GT(read, 100u);
}

TEST(Shortcuts, MenusPrintKeysOfTheTable) {
    UiHarness ui(1280, 720);
    ui.frames(2);
    ui.click(ui.find("editor/top", "", "File"));
    ui.frames(2);
    for (const Command command : {Command::OpenFile, Command::SavePreset, Command::SavePresetAs, Command::RevertPreset,
                                  Command::CopyCommandLine, Command::Quit})
        EXPECT_TRUE(ui.drawn().shows(key_text(command))) << key_text(command);
}

TEST(Shortcuts, EscapeRestoresTheMaximisedPanelAndKeepsTheProbe) {
    UiHarness ui(1280, 720);
    ui.state.probe_pixel = glm::ivec2(3, 4);
    ui.state.window.maximised = Panel::Scene;
    ui.frames(3);
    ui.key(256 + ImGuiKey_Escape);
    EXPECT_FALSE(ui.state.window.maximised);
    EXPECT_TRUE(ui.state.probe_pixel);
    ui.key(256 + ImGuiKey_Escape);
    EXPECT_FALSE(ui.state.probe_pixel);
}

}  // namespace
}  // namespace si::test
