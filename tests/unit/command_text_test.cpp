// Tests of command lines as text.
#include "renderer/base/command_text.h"

#include <gtest/gtest.h>

#include <vector>

namespace si {
namespace {

TEST(CommandText, WordsAreQuotedForTheShell) {
    for (const char* plain : {"stage", "a/b-c_d.json", "map.resolution=512", "50%", "me@there"})
        EXPECT_EQ(shell_quoted(plain), plain);
    EXPECT_EQ(shell_quoted(""), "''");
    EXPECT_EQ(shell_quoted("two words"), "'two words'");
    EXPECT_EQ(shell_quoted("it's $HOME"), "'it'\\''s $HOME'");
    EXPECT_EQ(shell_quoted("Küche"), "'Küche'");
}

TEST(CommandText, EachChangeIsOneWordAfterSet) {
    EXPECT_EQ(set_options_text({}), "");
    const std::vector<std::pair<std::string, std::string>> changes = {{"bias.normal", "0"},
                                                                      {"object.Root/My Fence.cast", "false"}};
    EXPECT_EQ(set_options_text(changes), "--set bias.normal=0 --set 'object.Root/My Fence.cast=false'");
}

}  // namespace
}  // namespace si
