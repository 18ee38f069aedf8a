#include "text/one_line.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace one_line_test {

TEST(OneLine, HasNoControlCharacterButTabs) {
    for (const char* text : {"", "a b", "a\tb", "Größe", "a=\"b\""}) {
        EXPECT_TRUE(isOneLine(text)) << text;
        EXPECT_EQ(oneLine(text), text);
    }
    for (const char c : {'\0', '\n', '\r', '\x1b', '\x7f'})
        EXPECT_FALSE(isOneLine(std::string("a") + c + "b")) << int(c);
    EXPECT_EQ(oneLine("a\nb\r\n\x1b[0mc"), "a b   [0mc");
    EXPECT_EQ(oneLine(std::string("a\0b", 3)), "a b");
}

}  // namespace one_line_test
}  // namespace gnomon
