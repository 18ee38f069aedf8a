#include "method/from_words.h"

#include <gmock/gmock.h>

#include <stdexcept>

namespace gnomon {
namespace from_words_test {

std::string errorOf(const std::string& method, const std::map<std::string, std::string>& options) {
    try {
        axesFromWords(method, options);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no error";
}

TEST(AxesFromWords, AreThoseOfTheNamedMethod) {
    for (const NamedMethod& method : namedMethods()) EXPECT_EQ(axesFromWords(method.id, {}), method.axes);
}

TEST(AxesFromWords, ChangeAxesAsFlagsDo) {
    EXPECT_EQ(methodId(axesFromWords("carmack", {{"silhouette", "visible"}, {"caps", "away"}})),
              "stencil-count-zfail-visible-1-blend-caps-away");
    EXPECT_EQ(methodId(axesFromWords("roettger-screen", {{"levels", "4"}, {"clip", "none"}})),
              "screen-double-4-zpass-cap-winding-1-blend-clip-none");
    EXPECT_EQ(methodId(axesFromWords("heidmann", {{"start", "bias"}, {"overflow", "saturate"}})),
              "stencil-count-zpass-winding-1-blend-start-bias-saturate");
    EXPECT_EQ(methodId(axesFromWords("heidmann", {{"count", "zfail"}, {"offset", "0.5"}})),
              "stencil-count-zfail-winding-1-blend-offset-0.5");
    EXPECT_EQ(methodId(axesFromWords("screen-texture", {{"mask-scale", "1/2"}})), "roettger-half");
    EXPECT_EQ(methodId(axesFromWords("heidmann",
                                     {{"store", "alpha"}, {"arithmetic", "double"}, {"count", "zpass-cap"}})),
              "roettger-alpha");
    EXPECT_EQ(methodId(axesFromWords("williams", {{"map-size", "64"}, {"map-bias", "0.1"}})),
              "depth-map-64-0.1");
}

TEST(AxesFromWords, SayWhatIsWrong) {
    EXPECT_EQ(errorOf("carmac", {}), "no such method 'carmac'");
    EXPECT_EQ(errorOf("carmack", {{"colour", "red"}}), "no such axis 'colour'");
    EXPECT_EQ(errorOf("carmack", {{"silhouette", "round"}}), "no such silhouette 'round'");
    EXPECT_EQ(errorOf("roettger-screen", {{"levels", "9"}}), "levels: '9' is not within 1 to 8");
    EXPECT_EQ(errorOf("carmack", {{"offset", "-1"}}), "offset: '-1' is not within 0 to 1e+15");
    EXPECT_EQ(errorOf("williams", {{"map-bias", "1"}}), "map-bias: '1' is not within 0 to 1");
    EXPECT_EQ(errorOf("roettger-half", {{"mask-scale", "1/3"}}), "no such mask-scale '1/3'");
    EXPECT_EQ(errorOf("carmack", {{"arithmetic", "double"}}), "a stencil can't double: only count or parity");
}

}  // namespace from_words_test
}  // namespace gnomon
