#include "text/deep_key.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon {
namespace deep_key_test {

std::string keyOf(std::size_t parts, const std::string& part = "a") {
    return fmt::format("{}", fmt::join(std::vector<std::string>(parts, part), "."));
}

const std::string kMost = keyOf(kMostKeyParts), kDeep = keyOf(kMostKeyParts + 1);

TEST(DeepKey, IsFoundWhereverAKeyStands) {
    EXPECT_EQ(lineOfDeepKey(kDeep + " = 1\n"), 1u);
    EXPECT_EQ(lineOfDeepKey("a = 1\n[" + kDeep + "]\n"), 2u);
    EXPECT_EQ(lineOfDeepKey("a = 1\n\n[[" + kDeep + "]]\n"), 3u);
    EXPECT_EQ(lineOfDeepKey("a = {b = 1, " + kDeep + " = 1}"), 1u);
    EXPECT_EQ(lineOfDeepKey(keyOf(kMostKeyParts + 1, "a ") + " = 1\n"), 1u);
}

TEST(DeepKey, MayHaveQuotesWithAnythingBetweenThem) {
    for (const char* part : {"\"=\"", "'['", "\"\\\"=\"", "'\\'", "\"#\""}) {
        EXPECT_EQ(lineOfDeepKey("x = 1\n" + keyOf(kMostKeyParts + 1, part) + " = 1\n"), 2u) << part;
        EXPECT_EQ(lineOfDeepKey(keyOf(kMostKeyParts, part) + " = 1\n"), 0u) << part;
    }
}

TEST(DeepKey, IsNoNumberTextOrComment) {
    EXPECT_EQ(lineOfDeepKey(kMost + " = 1.5\n[" + kMost + "]\n"), 0u);
    EXPECT_EQ(
        lineOfDeepKey("a = [" + fmt::format("{}", fmt::join(std::vector<double>(99, 1.5), ", ")) + "]\n"),
        0u);
    for (const char* quote : {"\"", "'", "\"\"\"", "'''"})
        EXPECT_EQ(lineOfDeepKey(fmt::format("a = {}{}{}\n", quote, kDeep, quote)), 0u) << quote;
    EXPECT_EQ(lineOfDeepKey("# " + kDeep + "\n"), 0u);
}

TEST(DeepKey, StandsInTheLineThatLongStringsLeaveIt) {
    EXPECT_EQ(lineOfDeepKey("a = \"\"\"\n\n\\\"\"\"\"\"\"\n" + kDeep + " = 1\n"), 4u);
    EXPECT_EQ(lineOfDeepKey("a = '''\n'''''\n" + kDeep + " = 1\n"), 3u);
    EXPECT_EQ(lineOfDeepKey("a = \"no end\n" + kDeep + " = 1\n"), 2u);
    EXPECT_EQ(lineOfDeepKey("a = \"\"\"no end\n" + kDeep + " = 1\n"), 0u);
    EXPECT_EQ(lineOfDeepKey("a = \"\\"), 0u);
    EXPECT_EQ(lineOfDeepKey(""), 0u);
}

}  // namespace deep_key_test
}  // namespace gnomon
