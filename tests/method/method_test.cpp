// The axes of methods, their names, and which of them contradict each other.

#include "method/method.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace gnomon {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Axes axesOf(const std::string& id) {
    return findMethod(id)->axes;
}

/// What contradicts, or "".
std::string objection(const Axes& axes) {
    return contradiction(axes).value_or("");
}

TEST(NamedMethods, HaveUniqueIdsSourcesAndSummaries) {
    std::set<std::string> ids;
    for (const NamedMethod& method : namedMethods()) {
        EXPECT_TRUE(ids.insert(method.id).second) << method.id << " twice";
        EXPECT_THAT(method.source, Not(IsEmpty())) << method.id;
        EXPECT_THAT(method.summary, Not(IsEmpty())) << method.id;
        // A paper by its year, or "gnomon" for what no paper has; parity is folklore.
        if (method.id != "none" && method.id != "parity") {
            EXPECT_THAT(method.source, ContainsRegex("[A-Z][a-z]+.* (19|20)[0-9][0-9]")) << method.id;
        }
    }
}

TEST(NamedMethods, AreThoseOfTheDesign) {
    std::vector<std::string> ids;
    for (const NamedMethod& method : namedMethods()) ids.push_back(method.id);
    EXPECT_THAT(ids, ElementsAre("none", "heidmann", "carmack", "parity", "roettger-alpha",
                                 "roettger-alpha-max", "roettger-screen", "roettger-screen-max",
                                 "screen-texture", "roettger-half", "roettger-quarter", "alpha-zfail",
                                 "screen-zfail", "hornus", "eisemann", "atomiczp", "counter", "williams"));
}

TEST(NamedMethods, DontContradictThemselves) {
    for (const NamedMethod& method : namedMethods()) EXPECT_EQ(objection(method.axes), "") << method.id;
}

TEST(NamedMethods, AreTheirIds) {
    for (const NamedMethod& method : namedMethods()) {
        EXPECT_EQ(findMethod(method.id), &method);
        EXPECT_EQ(methodId(method.axes), method.id);
    }
}

TEST(NamedMethods, StandForWhatTheyAreNamedAfter) {
    EXPECT_EQ(axesOf("heidmann").store, Store::Stencil);
    EXPECT_EQ(
        axesOf("roettger-alpha"),
        (Axes{
            .store = Store::Alpha, .arithmetic = Arithmetic::Double, .levels = 2, .count = Count::ZpassCap}));
    EXPECT_EQ(axesOf("roettger-screen-max").arithmetic, Arithmetic::Halve);
    EXPECT_EQ(axesOf("roettger-half").maskDivisor, 2);
    EXPECT_EQ(axesOf("roettger-quarter").maskDivisor, 4);
    EXPECT_EQ(axesOf("screen-texture").apply, Apply::Texture);
}

TEST(FindMethod, IsNothingForAnUnknownId) {
    EXPECT_EQ(findMethod("bergeron"), nullptr);
    EXPECT_EQ(findMethod(""), nullptr);
}

TEST(MethodId, LeavesTheShadeOut) {
    for (const NamedMethod& method : namedMethods())
        for (const Shade shade : {Shade::Black, Shade::Ambient, Shade::Attenuated}) {
            Axes axes = method.axes;
            axes.shade = shade;
            EXPECT_EQ(methodId(axes), method.id);
        }
}

TEST(MethodId, IsNoneWhateverTheUnshadowedFramesOtherAxes) {
    EXPECT_EQ(methodId({.store = Store::None, .arithmetic = Arithmetic::Halve, .maskDivisor = 4}), "none");
}

TEST(MethodId, JoinsTheAxesOfAnUnnamedMethod) {
    Axes axes = axesOf("roettger-quarter");
    axes.levels = 3;
    EXPECT_EQ(methodId(axes), "screen-double-3-zpass-cap-winding-1:4-texture");
    EXPECT_EQ(methodId({.store = Store::Stencil, .levels = 0, .silhouette = Silhouette::PerTriangle}),
              "stencil-count-zpass-per-triangle-1-blend");
}

TEST(MethodId, TellsApartAllMethodsThatDifferInMoreThanShade) {
    std::set<std::string> ids;
    int methods = 0;
    for (const Store store : {Store::Stencil, Store::Alpha, Store::Screen})
        for (const Arithmetic arithmetic : {Arithmetic::Count, Arithmetic::Double, Arithmetic::Halve})
            for (const int levels : {1, 2, 3, 8})
                for (const Count count : {Count::Zpass, Count::ZpassCap})
                    for (const Silhouette silhouette : {Silhouette::Winding, Silhouette::PerTriangle})
                        for (const int divisor : {1, 2, 4})
                            for (const Apply apply : {Apply::Blend, Apply::Texture}) {
                                // Levels are an axis of doubling alone.
                                if (arithmetic != Arithmetic::Double && levels != 1) continue;
                                const Axes axes{.store = store,
                                                .arithmetic = arithmetic,
                                                .levels = arithmetic == Arithmetic::Double ? levels : 0,
                                                .count = count,
                                                .silhouette = silhouette,
                                                .maskDivisor = divisor,
                                                .apply = apply};
                                if (contradiction(axes)) continue;
                                ++methods;
                                ids.insert(methodId(axes));
                            }
    // Stencil: 2 counts x 2 silhouettes. Each other store: (4 levels + halve) x 2 x 2 x (blend + texture at
    // 3 scales).
    EXPECT_EQ(methods, 4 + 2 * 5 * 4 * 4);
    EXPECT_EQ(ids.size(), std::size_t(methods));
}

TEST(Contradiction, IsAStencilThatDoublesOrHalves) {
    EXPECT_THAT(objection({.store = Store::Stencil, .arithmetic = Arithmetic::Double}),
                HasSubstr("only count"));
    EXPECT_THAT(objection({.store = Store::Stencil, .arithmetic = Arithmetic::Halve}),
                HasSubstr("only count"));
}

TEST(Contradiction, IsCountingInAColourBuffer) {
    EXPECT_THAT(objection({.store = Store::Alpha}), HasSubstr("double, halve or parity"));
    EXPECT_THAT(objection({.store = Store::Screen}), HasSubstr("double, halve or parity"));
}

TEST(Contradiction, IsAStencilAsATexture) {
    EXPECT_THAT(objection({.store = Store::Stencil, .apply = Apply::Texture}), HasSubstr("texture"));
    EXPECT_THAT(objection({.store = Store::Stencil, .maskDivisor = 2}), HasSubstr("scale 1"));
}

TEST(Contradiction, IsASmallMaskThatIsBlended) {
    Axes axes = axesOf("roettger-half");
    axes.apply = Apply::Blend;
    EXPECT_THAT(objection(axes), HasSubstr("as a texture only"));
}

TEST(Contradiction, IsDoublingBeyondEightLevelsOrBelowOne) {
    Axes axes = axesOf("roettger-screen");
    for (const auto& [levels, fine] : {std::pair(0, false), std::pair(1, true), std::pair(8, true),
                                       std::pair(9, false), std::pair(-1, false)}) {
        axes.levels = levels;
        EXPECT_EQ(objection(axes).empty(), fine) << levels;
    }
}

TEST(Contradiction, IsNothingForTheUnshadowedFrame) {
    EXPECT_EQ(objection({.store = Store::None, .arithmetic = Arithmetic::Halve, .maskDivisor = 4}), "");
}

// Issue 2, part 5.
TEST(PathCandidates, AreStencilAlphaScreenAndScreenWithTextureInThisOrder) {
    std::vector<std::string> ids;
    for (const Axes& axes : pathCandidates()) ids.push_back(methodId(axes));
    EXPECT_THAT(ids, ElementsAre("heidmann", "roettger-alpha", "roettger-screen", "screen-texture"));
}

TEST(MaskScaleName, IsAFraction) {
    EXPECT_EQ(maskScaleName(1), "1");
    EXPECT_EQ(maskScaleName(2), "1/2");
    EXPECT_EQ(maskScaleName(4), "1/4");
}

}  // namespace
}  // namespace gnomon
