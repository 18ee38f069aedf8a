// Frames drawn by the software OpenGL: values of masks, agreement of the stores, and what the renderer
// promises of steps and errors.

#include "gl/renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "gl/capability.h"
#include "scene/load.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {
namespace renderer_test {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

using Pixel = std::array<int, 3>;

Pixel pixelAt(const Image& image, int x, int y) {
    const auto* p = &image.data[(std::size_t(y) * image.width + x) * image.channels];
    return {p[0], p[1], p[2]};
}

int largestDifference(const Image& a, const Image& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i)
        largest = std::max(largest, std::abs(a.data[i] - b.data[i]));
    return largest;
}

int pixelsThatDiffer(const std::vector<bool>& a, const std::vector<bool>& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
    return count;
}

/// Draws one frame of a scene with one method; surfaces and geometry are made once.
class Studio {
  public:
    Studio(const std::string& chipId, const Scene& scene, int width, int height)
        : m_profile(chip(chipId)),
          m_surface(bufferFormatOf(m_profile), width, height, arithmeticOf(m_profile, {})),
          m_frame(frameOf(scene, width, height)) {}

    Rendered draw(const Axes& axes) {
        return render(m_surface, m_profile, planOf(axes), m_frame.surfaces, m_frame.lights());
    }

    Rendered draw(const std::string& method, Shade shade = Shade::Attenuated) {
        Axes axes = findMethod(method)->axes;
        axes.shade = shade;
        return draw(axes);
    }

    /// The same with no volume at all: everything is lit.
    Rendered drawLit(const Axes& axes) {
        const Plan plan = planFrame(axes, shapeOf(0, m_surface.width(), m_surface.height()), m_profile);
        return render(m_surface, m_profile, plan, m_frame.surfaces, m_frame.lights());
    }

    Plan planOf(const Axes& axes) const {
        const int volumes = int(m_frame.volumes().size());
        return planFrame(axes, shapeOf(volumes, m_surface.width(), m_surface.height()), m_profile);
    }

  private:
    Profile m_profile;
    TestSurface m_surface;
    Frame m_frame;
};

Pass clearTo(float value) {
    return {.kind = PassKind::Clear, .label = "clear", .colour = glm::vec4(value), .clearsDepth = true};
}

Pass rectangle(const Blend& blend, float value) {
    return {.kind = PassKind::Rectangle, .label = "rectangle", .colour = glm::vec4(value), .blend = blend};
}

const Blend kDouble{.enabled = true, .source = BlendFactor::DstColor, .destination = BlendFactor::One};
const Blend kScale{.enabled = true, .source = BlendFactor::DstColor, .destination = BlendFactor::Zero};
const Blend kInvert{
    .enabled = true, .source = BlendFactor::OneMinusDstColor, .destination = BlendFactor::Zero};
const Blend kAdd{.enabled = true, .source = BlendFactor::One, .destination = BlendFactor::One};
constexpr float kHalf = 128.0f / 255;

/// Red, green and blue of a pixel after each of @p passes.
std::vector<Pixel> ladder(const std::string& chipId, std::vector<Pass> passes) {
    const Profile profile = chip(chipId);
    TestSurface surface(bufferFormatOf(profile), 4, 4, arithmeticOf(profile, {}));
    const Plan plan{.passes = std::move(passes), .width = 4, .height = 4, .maskWidth = 4, .maskHeight = 4};
    std::vector<Pixel> values;
    render(surface, profile, plan, {}, {},
           {.afterPass = [&](std::size_t) { values.push_back(pixelAt(readColour(surface), 1, 2)); }});
    return values;
}

// Section 4.2 in 8 bits: 1/4 is 63.75. Exact, as blending rounds in one way only.
TEST(Ladder, DoublesAQuarterToOneInThreeSteps) {
    EXPECT_THAT(
        ladder("ideal",
               {clearTo(0.25f), rectangle(kDouble, 1), rectangle(kDouble, 1), rectangle(kDouble, 1)}),
        ElementsAre(Pixel{64, 64, 64}, Pixel{128, 128, 128}, Pixel{255, 255, 255}, Pixel{255, 255, 255}));
}

// Section 4.3 for a lit pixel that stands at 1/4; the inverse of 128 is 127, and twice that misses 255 by
// one.
TEST(Ladder, LeavesALitPixelAt254Of255) {
    EXPECT_THAT(
        ladder("ideal",
               {clearTo(0.25f), rectangle(kDouble, 1), rectangle(kInvert, 1), rectangle(kDouble, 1)}),
        ElementsAre(Pixel{64, 64, 64}, Pixel{128, 128, 128}, Pixel{127, 127, 127}, Pixel{254, 254, 254}));
}

TEST(Ladder, LeavesALitPixelAt255WhereHalfIsAdded) {
    EXPECT_EQ(ladder("ideal",
                     {clearTo(0.25f), rectangle(kDouble, 1), rectangle(kInvert, 1), rectangle(kAdd, kHalf)})
                  .back(),
              (Pixel{255, 255, 255}));
}

TEST(Ladder, HalvesOneToAnEighthAndBack) {
    EXPECT_THAT(ladder("ideal", {clearTo(1), rectangle(kScale, kHalf), rectangle(kScale, kHalf),
                                 rectangle(kScale, kHalf), rectangle(kDouble, 1), rectangle(kDouble, 1)}),
                ElementsAre(Pixel{255, 255, 255}, Pixel{128, 128, 128}, Pixel{64, 64, 64}, Pixel{32, 32, 32},
                            Pixel{64, 64, 64}, Pixel{128, 128, 128}));
}

// 565 read back as 8 bits: 8, 16, 15, 30 of 31 and 16, 32, 31, 62 of 63.
TEST(Ladder, LeavesALitPixelAt30Of31And62Of63In565) {
    EXPECT_THAT(
        ladder("voodoo1",
               {clearTo(0.25f), rectangle(kDouble, 1), rectangle(kInvert, 1), rectangle(kDouble, 1)}),
        ElementsAre(Pixel{66, 65, 66}, Pixel{132, 130, 132}, Pixel{123, 125, 123}, Pixel{247, 251, 247}));
}

TEST(Mask, CallsAValueBelowItsThresholdAShadow) {
    const Profile ideal = chip("ideal");
    TestSurface surface(bufferFormatOf(ideal), 4, 4);
    const auto shadow = [&](float value, double threshold) {
        Plan plan{.passes = {clearTo(value)}, .width = 4, .height = 4, .maskWidth = 4, .maskHeight = 4};
        plan.masks = {{.after = 1, .place = MaskPlace::Colour}}, plan.threshold = threshold;
        return render(surface, ideal, plan, {}, {}).masks.front();
    };
    EXPECT_THAT(shadow(127 / 255.0f, 0.5), Each(true));
    EXPECT_THAT(shadow(128 / 255.0f, 0.5), Each(false));
    EXPECT_THAT(shadow(191 / 255.0f, 0.75), Each(true));
    EXPECT_THAT(shadow(192 / 255.0f, 0.75), Each(false));
}

TEST(Mask, CallsAnythingButZeroInTheStencilAShadow) {
    Studio studio("ideal", twoBoxes(), 64, 48);
    const auto lit = studio.drawLit(findMethod("heidmann")->axes).masks.front();
    EXPECT_THAT(lit, Each(false));
    const auto mask = studio.draw("heidmann").masks.front();
    EXPECT_GT(std::count(mask.begin(), mask.end(), true), 50);
}

class EachShade : public testing::TestWithParam<Shade> {};
INSTANTIATE_TEST_SUITE_P(Shades, EachShade, testing::Values(Shade::Black, Shade::Ambient, Shade::Attenuated),
                         [](const auto& test) { return name(test.param); });

// 2 of 255: a lit pixel's mask is 254 or 255, which costs one step, and products round once more.
TEST_P(EachShade, LooksAlikeWhicheverBufferHoldsTheMask) {
    Studio studio("ideal", loadScene(std::string(GNOMON_SOURCE) + "/scenes/boxes.toml"), 160, 120);
    const Rendered stencil = studio.draw("heidmann", GetParam());
    ASSERT_GT(std::count(stencil.masks.front().begin(), stencil.masks.front().end(), true), 500);
    for (const char* method : {"roettger-alpha", "roettger-alpha-max", "roettger-screen",
                               "roettger-screen-max", "screen-texture"}) {
        SCOPED_TRACE(method);
        const Rendered other = studio.draw(method, GetParam());
        EXPECT_EQ(pixelsThatDiffer(stencil.masks.front(), other.masks.front()), 0);
        EXPECT_LE(largestDifference(stencil.image, other.image), 2);
    }
}

// The top left pixel sees no surface. 2 of 255 as above.
TEST_P(EachShade, ShowsTheSameBackgroundWithEveryMethod) {
    Studio studio("ideal", twoBoxes(), 64, 48);
    const Pixel expected{128, 153, 179};
    EXPECT_EQ(pixelAt(studio.draw("none").image, 0, 0), expected);
    for (Axes axes : allMethods()) {
        axes.shade = GetParam();
        const Pixel shown = pixelAt(studio.draw(axes).image, 0, 0);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], expected[c], 2) << describe(axes);
    }
}

// A light beside the eye: the shadow of a box before the sky reaches to infinity within view, beside the box,
// so that rays enter its volume by a side and leave it by the far cap alone.
TEST(FarCap, KeepsTheBackgroundLit) {
    Scene scene;
    scene.objects = {placed("box", box({0.8, 0.7, 0.8}), {0.2f, 0.1f, 1.0f})};
    scene.lights = {{.position = {1.9f, 0.3f, 5.2f, 1}}};
    scene.frames = {{.eye = {0, 0, 5}, .target = {0, 0, 0}, .fovDegrees = 50}};
    Studio studio("ideal", scene, 64, 48);
    const Image unshadowed = studio.draw("none").image;
    for (const char* method : {"heidmann", "roettger-alpha", "roettger-screen"}) {
        const Rendered drawn = studio.draw(method);
        int sky = 0, shadowed = 0;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 64; ++x) {
                const bool isSky = pixelAt(unshadowed, x, y) == Pixel{128, 153, 179};
                sky += isSky;
                shadowed += isSky && drawn.masks.front()[std::size_t(y) * 64 + x];
            }
        EXPECT_GT(sky, 1000) << ::testing::PrintToString(pixelAt(unshadowed, 0, 0));
        EXPECT_EQ(shadowed, 0) << method;
    }
}

class EachStore : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Stores, EachStore, testing::Values("heidmann", "roettger-alpha", "roettger-screen"),
                         [](const auto& test) {
                             std::string id = test.param;
                             std::replace(id.begin(), id.end(), '-', '_');
                             return id;
                         });

TEST_P(EachStore, SeesTheShadowFromWithinTheVolumeOnlyWithANearCap) {
    Studio studio("ideal", underASlab(), 40, 30);
    Axes axes = findMethod(GetParam())->axes;
    axes.count = Count::ZpassCap;
    EXPECT_THAT(studio.draw(axes).masks.front(), Each(true));
    axes.count = Count::Zpass;
    EXPECT_THAT(studio.draw(axes).masks.front(), Each(false));
}

TEST(Steps, AreReportedOncePerPassInOrder) {
    const Profile ideal = chip("ideal");
    TestSurface surface(bufferFormatOf(ideal), 32, 24);
    const Frame frame = frameOf(twoBoxes(), 32, 24);
    const Plan plan = planFrame(findMethod("roettger-screen")->axes, shapeOf(2, 32, 24), ideal);
    std::vector<std::size_t> seen, foreseen(plan.passes.size());
    for (std::size_t i = 0; i < foreseen.size(); ++i) foreseen[i] = i;
    render(surface, ideal, plan, frame.surfaces, frame.lights(),
           {.afterPass = [&](std::size_t pass) { seen.push_back(pass); }});
    EXPECT_EQ(seen, foreseen);
}

TEST(Errors, OfOpenGLNameThePass) {
    const Profile ideal = chip("ideal");
    TestSurface surface(bufferFormatOf(ideal), 4, 4);
    Pass bad = rectangle({}, 1);
    bad.label = "into a viewport of negative width", bad.target = Target::Mask;
    const Plan plan{.passes = {clearTo(0), bad}, .width = 4, .height = 4, .maskWidth = -1, .maskHeight = 4};
    try {
        render(surface, ideal, plan, {}, {});
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("pass 2: into a viewport of negative width"));
        EXPECT_THAT(error.what(), HasSubstr("0x0501"));  // GL_INVALID_VALUE
    }
}

TEST(Errors, OfAnEarlierFrameAreNotThoseOfTheNext) {
    const Profile ideal = chip("ideal");
    TestSurface surface(bufferFormatOf(ideal), 4, 4);
    surface.driver().Viewport(0, 0, -1, 4);
    const Plan plan{.passes = {clearTo(0)}, .width = 4, .height = 4, .maskWidth = 4, .maskHeight = 4};
    EXPECT_NO_THROW(render(surface, ideal, plan, {}, {}));
}

// State that one frame leaves behind, a method that fails half-way included, must not show in the next.
TEST(Frames, DontDependOnTheFrameBefore) {
    Studio studio("ideal", twoBoxes(), 64, 48);
    const Image fresh = studio.draw("roettger-screen").image;
    for (const NamedMethod& method : namedMethods())
        for (const Shade shade : {Shade::Black, Shade::Ambient, Shade::Attenuated}) {
            studio.draw(method.id, shade);
            EXPECT_EQ(studio.draw("roettger-screen").image, fresh) << method.id;
        }
}

Axes scaled(int divisor, Store store) {
    return {.store = store,
            .arithmetic = Arithmetic::Double,
            .count = Count::ZpassCap,
            .maskDivisor = divisor,
            .apply = Apply::Texture};
}

// Beyond the mask's last row and column its texture holds nothing; filtering must not reach there. 2 of 255
// as above.
TEST(MaskTexture, DoesNotBleedAtTheWindowsEdge) {
    for (const char* id : {"ideal", "tnt", "ps2"}) {
        Studio studio(id, twoBoxes(), 321, 241);
        const Image unshadowed = studio.draw("none").image;
        for (const int divisor : {1, 2, 4}) {
            const Rendered drawn = studio.drawLit(scaled(divisor, Store::Screen));
            EXPECT_LE(largestDifference(drawn.image, unshadowed), 2) << id << " 1/" << divisor;
            EXPECT_THAT(drawn.masks.front(), Each(false)) << id << " 1/" << divisor;
        }
    }
}

// A corner pixel is the harder case for texels beside the mask: both its row and its column are the last.
TEST(MaskTexture, KeepsShadowsUpToTheWindowsEdge) {
    for (const char* id : {"ideal", "tnt"})
        for (const Store store : {Store::Screen, Store::Alpha}) {
            Studio studio(id, underASlab(), 81, 63);
            for (const int divisor : {1, 2, 4})
                EXPECT_THAT(studio.draw(scaled(divisor, store)).masks.front(), Each(true))
                    << id << " " << name(store) << " 1/" << divisor;
        }
}

/// One slab over the floor, seen from above, its shadow in the open.
Scene slabFromAbove() {
    Scene scene;
    scene.objects = {placed("floor", gnomon::rectangle({40, 40}), {0, 0, 0}, false),
                     placed("slab", box({1.3, 0.1, 1.1}), {-1.21f, 1.03f, 0.17f})};
    scene.lights = {{.position = {-4.3f, 3.9f, 0.7f, 1}}};
    scene.frames = {{.eye = {0.1f, 8.3f, 0.2f}, .target = {0, 0, 0}, .up = {0, 0, -1}}};
    return scene;
}

// A bilinear sample reaches one texel, that is `divisor` pixels, and the mask's samples stand up to half a
// texel from the pixel's: farther than two texels from the shadow's edge both masks must say the same.
TEST(LowResolutionMask, AgreesWithTheFullOneAwayFromShadowEdges) {
    constexpr int kWidth = 321, kHeight = 241;
    Studio studio("ideal", slabFromAbove(), kWidth, kHeight);
    const auto full = studio.draw("heidmann").masks.front();
    ASSERT_GT(std::count(full.begin(), full.end(), true), 1000);
    for (const int divisor : {1, 2, 4}) {
        const auto low = studio.draw(scaled(divisor, Store::Screen)).masks.front();
        const int reach = divisor == 1 ? 0 : 2 * divisor;
        int uniform = 0, wrong = 0;
        for (int y = reach; y < kHeight - reach; ++y)
            for (int x = reach; x < kWidth - reach; ++x) {
                const bool shadow = full[std::size_t(y) * kWidth + x];
                bool same = true;
                for (int dy = -reach; same && dy <= reach; ++dy)
                    for (int dx = -reach; same && dx <= reach; ++dx)
                        same = full[std::size_t(y + dy) * kWidth + x + dx] == shadow;
                uniform += same;
                wrong += same && low[std::size_t(y) * kWidth + x] != shadow;
            }
        EXPECT_GT(uniform, kWidth * kHeight / 2);
        EXPECT_EQ(wrong, 0) << "1/" << divisor;
    }
}

// What a chip renders into is its own: 565 with 16-bit depth and no stencil on a Voodoo.
TEST(SurfaceBuffers, AreTheChips) {
    EXPECT_EQ(bufferFormatOf(chip("voodoo1")),
              (BufferFormat{.red = 5, .green = 6, .blue = 5, .alpha = 0, .depth = 16, .stencil = 0}));
    EXPECT_EQ(bufferFormatOf(chip("tnt")), BufferFormat{});
    EXPECT_EQ(bufferFormatOf(chip("ps2")).stencil, 0);
}

TEST(SurfaceBuffers, OfMoreThanEightBitsPerChannelAreRefused) {
    EXPECT_THROW(
        TestSurface({.red = 10, .green = 10, .blue = 10, .alpha = 0, .depth = 24, .stencil = 8}, 4, 4),
        std::runtime_error);
    EXPECT_THROW(
        TestSurface({.red = 12, .green = 12, .blue = 12, .alpha = 12, .depth = 16, .stencil = 0}, 4, 4),
        std::runtime_error);
}

// On a chip that only adds, the renderer never calls the extension for other equations.
TEST(Paths, RunOnTheChipsThatTheyAreFor) {
    for (const auto& [id, method] :
         {std::pair("tnt", "heidmann"), std::pair("geforce2mx", "roettger-alpha-max"),
          std::pair("voodoo1", "roettger-screen"), std::pair("voodoo3", "roettger-screen"),
          std::pair("ps2", "screen-texture")}) {
        Studio studio(id, twoBoxes(), 64, 48);
        EXPECT_NO_THROW(studio.draw(method)) << id;
    }
}

}  // namespace renderer_test
}  // namespace gnomon
