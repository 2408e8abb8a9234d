#include "renderer/base/command_text.h"

#include <gtest/gtest.h>

#include <vector>

namespace si {
namespace {

TEST(CommandText, WordsAreQuotedWhereAShellWouldSplitOrChangeThem) {
    for (const char* plain : {"stage", "a/b-c_d.json", "map.resolution=512", "50%", "me@there"})
        EXPECT_EQ(shell_word(plain), plain);
    EXPECT_EQ(shell_word(""), "''");
    EXPECT_EQ(shell_word("two words"), "'two words'");
    EXPECT_EQ(shell_word("it's $HOME"), "'it'\\''s $HOME'");
    EXPECT_EQ(shell_word("Küche"), "'Küche'");
}

TEST(CommandText, EachChangeIsOneWordAfterSet) {
    EXPECT_EQ(sets_text({}), "");
    const std::vector<std::pair<std::string, std::string>> changes = {{"bias.normal", "0"},
                                                                      {"object.Root/My Fence.cast", "false"}};
    EXPECT_EQ(sets_text(changes), "--set bias.normal=0 --set 'object.Root/My Fence.cast=false'");
}

}  // namespace
}  // namespace si
