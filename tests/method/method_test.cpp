// The axes of methods, their names, and which of them contradict each other.

#include "method/method.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

namespace gnomon {
namespace method_test {

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
        // A paper by its year, or "gnomon" for what no paper has; parity is folklore. What games did, by an
        // emulator's notes.
        if (method.id != "none" && method.id != "parity") {
            EXPECT_THAT(method.source, ContainsRegex("[A-Z][a-z]+.* (19|20)[0-9][0-9]|^[A-Z0-9]+ (issue|PR)"))
                << method.id;
        }
    }
}

TEST(NamedMethods, AreThoseOfTheDesign) {
    std::vector<std::string> ids;
    for (const NamedMethod& method : namedMethods()) ids.push_back(method.id);
    EXPECT_THAT(
        ids, ElementsAre("none", "heidmann", "carmack", "parity", "roettger-alpha", "roettger-alpha-max",
                         "roettger-screen", "roettger-screen-max", "screen-texture", "roettger-half",
                         "roettger-quarter", "alpha-zfail", "screen-zfail", "hornus", "eisemann", "atomiczp",
                         "counter", "williams", "screen-count", "alpha-count", "screen-parity", "auto"));
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

TEST(AxisValues, AreAllCountsAndSilhouettesWithTheirPapers) {
    std::vector<std::string> words;
    for (const AxisValue& v : axisValues()) {
        words.push_back(v.axis + " " + v.value);
        EXPECT_THAT(v.source, testing::ContainsRegex("19|20|section")) << v.value;
        EXPECT_THAT(v.summary, Not(IsEmpty())) << v.value;
    }
    std::vector<std::string> expected;
    for (int i = 0; i < kCounts; ++i) expected.push_back("count " + name(gnomon::Count(i)));
    for (int i = 0; i < kSilhouettes; ++i) expected.push_back("silhouette " + name(Silhouette(i)));
    EXPECT_EQ(words, expected);
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
    // Stencil: 2 counts x 2 silhouettes. Each other store: (4 levels + halve + count) x 2 x 2 x (blend +
    // texture at 3 scales).
    EXPECT_EQ(methods, 4 + 2 * 6 * 4 * 4);
    EXPECT_EQ(ids.size(), std::size_t(methods));
}

/// Each combination of the axes and options that is no contradiction, but for shades.
std::vector<Axes> wholeProduct() {
    std::vector<Axes> all{{.store = Store::None, .levels = 0}};
    for (const int size : {256, kDefaultMapSize})
        for (const float bias : {0.0f, kDefaultMapBias})
            all.push_back({.store = Store::DepthMap, .levels = 0, .mapSize = size, .mapBias = bias});
    for (const Store store : {Store::Stencil, Store::Alpha, Store::Screen, Store::Counter})
        for (int bits = 0; bits < 2 * 2 * 3 * 2; ++bits)  // apply, caps, clip, offset
            for (int arithmetic = 0; arithmetic < kArithmetics; ++arithmetic)
                for (int count = 0; count < kCounts; ++count)
                    for (int silhouette = 0; silhouette < kSilhouettes; ++silhouette)
                        for (const int divisor : {1, 2, 4})
                            for (int start = 0; start < kStarts; ++start)
                                for (int overflow = 0; overflow < kOverflows; ++overflow)
                                    for (const int levels : {1, 2, 8}) {
                                        const bool doubles = Arithmetic(arithmetic) == Arithmetic::Double;
                                        if (!doubles && levels != 1) continue;
                                        const Axes axes{.store = store,
                                                        .arithmetic = Arithmetic(arithmetic),
                                                        .levels = doubles ? levels : 0,
                                                        .count = Count(count),
                                                        .silhouette = Silhouette(silhouette),
                                                        .maskDivisor = divisor,
                                                        .apply = Apply(bits % 2),
                                                        .start = Start(start),
                                                        .overflow = Overflow(overflow),
                                                        .capFaces = CapFaces(bits / 2 % 2),
                                                        .clip = Clip(bits / 4 % 3),
                                                        .offset = bits / 12 ? 0.5f : 0.0f};
                                        if (!contradiction(axes)) all.push_back(axes);
                                    }
    return all;
}

TEST(MethodId, TellsApartAllMethodsWithAllTheirOptions) {
    std::map<std::string, Axes> methods;
    for (const Axes& axes : wholeProduct()) {
        const auto [at, isNew] = methods.emplace(methodId(axes), axes);
        EXPECT_TRUE(isNew || normalised(axes) == normalised(at->second)) << at->first;
    }
    EXPECT_GT(methods.size(), 1000u);
}

TEST(MethodId, NamesOptionsThatAreNotAsUsual) {
    Axes axes = axesOf("carmack");
    axes.start = Start::Middle, axes.overflow = Overflow::Wrap, axes.capFaces = CapFaces::Away;
    axes.clip = Clip::Eye, axes.offset = 0.25f;
    EXPECT_EQ(methodId(axes),
              "stencil-count-zfail-winding-1-blend-start-middle-wrap-caps-away-clip-eye-offset-0.25");
    EXPECT_EQ(methodId({.store = Store::DepthMap, .mapSize = 512, .mapBias = 0.5f}), "depth-map-512-0.5");
}

TEST(MethodId, IsWilliamsWithTheDefaultMap) {
    EXPECT_EQ(methodId({.store = Store::DepthMap}), "williams");
    EXPECT_EQ(methodId({.store = Store::DepthMap,
                        .count = Count::Zfail,
                        .mapSize = kDefaultMapSize,
                        .mapBias = kDefaultMapBias}),
              "williams");
}

TEST(Contradiction, IsCountingBeyondZpassAndZfailInAColour) {
    for (const Store store : {Store::Alpha, Store::Screen})
        for (const Count count : {Count::ZpPlus, Count::PlusPlusZp, Count::AtomicZp})
            EXPECT_THAT(objection({.store = store, .arithmetic = Arithmetic::Double, .count = count}),
                        HasSubstr("needs a stencil or a counter"));
}

TEST(Contradiction, IsACounterThatDoesAnythingButCount) {
    EXPECT_EQ(objection({.store = Store::Counter, .count = Count::ZpPlus}), "");
    EXPECT_THAT(objection({.store = Store::Counter, .arithmetic = Arithmetic::Parity}),
                HasSubstr("only counts"));
    EXPECT_THAT(objection({.store = Store::Counter, .apply = Apply::Texture}), HasSubstr("blend"));
    EXPECT_THAT(objection({.store = Store::Counter, .maskDivisor = 2}), HasSubstr("scale 1"));
    for (const Count count : {Count::PlusPlusZp, Count::AtomicZp})
        EXPECT_THAT(objection({.store = Store::Counter, .count = count}), HasSubstr("of a stencil"));
}

TEST(Contradiction, IsParityThatStartsOrOverflows) {
    Axes axes = axesOf("parity");
    EXPECT_EQ(objection(axes), "");
    for (const Count count : {Count::ZpPlus, Count::PlusPlusZp, Count::AtomicZp}) {
        axes.count = count;
        EXPECT_THAT(objection(axes), HasSubstr("parity has none"));
    }
    axes.count = Count::Zfail, axes.start = Start::Middle;
    EXPECT_THAT(objection(axes), HasSubstr("one bit"));
    axes.start = Start::Zero, axes.overflow = Overflow::Wrap;
    EXPECT_THAT(objection(axes), HasSubstr("one bit"));
}

TEST(Contradiction, IsAStartOrOverflowOfWhatDoesNotCountOrNeverOverflows) {
    Axes axes = axesOf("roettger-screen");
    axes.start = Start::Middle;
    EXPECT_THAT(objection(axes), HasSubstr("of a count"));
    axes = axesOf("screen-parity"), axes.overflow = Overflow::Saturate;
    EXPECT_THAT(objection(axes), HasSubstr("of a count"));
    axes = axesOf("counter"), axes.overflow = Overflow::Wrap;
    EXPECT_THAT(objection(axes), HasSubstr("in a stencil, colour or alpha"));
}

TEST(Contradiction, IsACountInAColourThatWrapsFromTheMiddleOrStartsAtABias) {
    for (const char* id : {"screen-count", "alpha-count"}) {
        Axes axes = axesOf(id);
        for (const Overflow overflow : {Overflow::Either, Overflow::Wrap, Overflow::Saturate}) {
            axes.overflow = overflow, axes.start = Start::Zero;
            EXPECT_EQ(objection(axes), "") << name(overflow);
            axes.start = Start::Middle;
            EXPECT_EQ(objection(axes).empty(), overflow != Overflow::Wrap) << name(overflow);
        }
        axes.start = Start::Bias;
        EXPECT_THAT(objection(axes), HasSubstr("stencil's"));
    }
}

TEST(Contradiction, IsABiasForTheEyeWhereTheCountNeedsNone) {
    Axes axes = axesOf("heidmann");
    axes.start = Start::Bias;
    EXPECT_EQ(objection(axes), "");
    for (const Count count :
         {Count::ZpassCap, Count::Zfail, Count::ZpPlus, Count::PlusPlusZp, Count::AtomicZp}) {
        axes.count = count;
        EXPECT_THAT(objection(axes), HasSubstr("is for zpass"));
    }
}

TEST(Contradiction, IsAtomiczpWithAnotherSilhouetteCapOrASaturatingCount) {
    for (const auto& change :
         std::vector<std::function<void(Axes&)>>{[](Axes& a) { a.silhouette = Silhouette::Manifold; },
                                                 [](Axes& a) { a.capFaces = CapFaces::Away; },
                                                 [](Axes& a) { a.overflow = Overflow::Saturate; }}) {
        Axes axes = axesOf("atomiczp");
        EXPECT_EQ(objection(axes), "");
        change(axes);
        EXPECT_THAT(objection(axes), HasSubstr("atomiczp finds its own"));
    }
}

TEST(Contradiction, IsAnOffsetWithoutALightCapAndAwayCapsOfSingleTriangles) {
    Axes axes = axesOf("carmack");
    axes.offset = 0.1f;
    EXPECT_EQ(objection(axes), "");
    axes.count = Count::Zpass;
    EXPECT_THAT(objection(axes), HasSubstr("offset"));
    axes = axesOf("carmack"), axes.capFaces = CapFaces::Away;
    EXPECT_EQ(objection(axes), "");
    axes.silhouette = Silhouette::PerTriangle;
    EXPECT_THAT(objection(axes), HasSubstr("whole casters"));
}

TEST(Contradiction, IsAnotherClipWithASmallMask) {
    for (const Clip clip : {Clip::Eye, Clip::None}) {
        Axes axes = axesOf("roettger-half");
        axes.clip = clip;
        EXPECT_THAT(objection(axes), HasSubstr("window's size"));
        axes = axesOf("screen-texture"), axes.clip = clip;
        EXPECT_EQ(objection(axes), "");
    }
}

TEST(Normalised, LeavesNothingButWhatMeansSomethingToTheStore) {
    EXPECT_EQ(normalised({.store = Store::Stencil, .levels = 5}).levels, 0);
    EXPECT_EQ(normalised({.store = Store::Stencil, .mapSize = 64}).mapSize, 0);
    const Axes map = normalised({.store = Store::DepthMap, .maskDivisor = 4, .shade = Shade::Black});
    EXPECT_EQ(map, (Axes{.store = Store::DepthMap,
                         .levels = 0,
                         .shade = Shade::Black,
                         .mapSize = kDefaultMapSize,
                         .mapBias = kDefaultMapBias}));
    EXPECT_EQ(normalised({.store = Store::DepthMap, .mapSize = 64}).mapBias, 0)
        << "an explicit map without a bias";
}

TEST(PartsOf, CloseVolumesWhereTheCountLooks) {
    const Parts open = Part::Sides | Part::FarCap;
    EXPECT_EQ(partsOf(Count::Zpass), open);
    EXPECT_EQ(partsOf(Count::ZpassCap), open | Part::NearCap);
    EXPECT_EQ(partsOf(Count::Zfail), open | Part::LightCap);
    EXPECT_EQ(partsOf(Count::ZpPlus), open | Part::NearCap);
    EXPECT_EQ(partsOf(Count::PlusPlusZp), open | Part::NearFaces);
    EXPECT_TRUE(partsOf(Count::AtomicZp).empty());
}

TEST(Contradiction, IsAStencilThatDoublesOrHalves) {
    EXPECT_THAT(objection({.store = Store::Stencil, .arithmetic = Arithmetic::Double}),
                HasSubstr("only count"));
    EXPECT_THAT(objection({.store = Store::Stencil, .arithmetic = Arithmetic::Halve}),
                HasSubstr("only count"));
}

TEST(Contradiction, IsNotCountingInAColourBuffer) {
    for (const Store store : {Store::Alpha, Store::Screen})
        for (const Apply apply : {Apply::Blend, Apply::Texture})
            for (const Count count : {Count::Zpass, Count::ZpassCap, Count::Zfail})
                EXPECT_EQ(objection({.store = store, .count = count, .apply = apply}), "");
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

}  // namespace method_test
}  // namespace gnomon
