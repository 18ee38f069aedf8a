// Ways to count, drawn by the software OpenGL on scenes whose shadows are known without any tracer: a slab
// over a floor, an eye under it, and stacks of volumes deeper than a stencil counts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gl/capability.h"
#include "gl/renderer.h"
#include "method/shader_volumes.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {
namespace counting_test {

using testing::Each;

const Profile& ideal() {
    static const Profile profile = chip("ideal");
    return profile;
}

/// One frame of a scene, drawn with any method.
class Studio {
  public:
    Studio(const Scene& scene, int width, int height, const Profile& profile = ideal())
        : m_profile(profile),
          m_surface(bufferFormatOf(profile), width, height, arithmeticOf(profile, {})),
          m_frame(frameOf(scene, width, height)) {}

    Plan planOf(const Axes& axes, int holdingEye = 0) const {
        FrameShape shape = shapeOf(int(m_frame.volumes().size()), m_surface.width(), m_surface.height());
        shape.lights[0].holdingEye = holdingEye;
        return planFrame(axes, shape, m_profile);
    }
    Rendered draw(const Axes& axes, int holdingEye = 0) {
        return render(m_surface, m_profile, planOf(axes, holdingEye), m_frame.surfaces, m_frame.lights());
    }
    std::vector<bool> mask(const Axes& axes, int holdingEye = 0) {
        return draw(axes, holdingEye).masks.front();
    }
    const FrameVolumes& volumes() const { return m_frame.volumes(); }

  private:
    Profile m_profile;
    TestSurface m_surface;
    Frame m_frame;
};

Axes axesOf(const std::string& id) {
    return findMethod(id)->axes;
}

int shadows(const std::vector<bool>& mask) {
    return int(std::count(mask.begin(), mask.end(), true));
}

/// The methods in every store, at scale 1, that count in one of these ways.
std::vector<Axes> countsOf(const std::vector<Count>& counts) {
    std::vector<Axes> all;
    for (const Axes& axes : allMethods())
        if (axes.shade == Shade::Black && axes.maskDivisor == 1 && axes.store != Store::None &&
            axes.store != Store::DepthMap && std::count(counts.begin(), counts.end(), axes.count))
            all.push_back(axes);
    return all;
}

const std::vector<Count> kEveryCount{Count::Zpass,  Count::ZpassCap,   Count::Zfail,
                                     Count::ZpPlus, Count::PlusPlusZp, Count::AtomicZp};
const std::vector<Count> kCountsFromWithin{Count::ZpassCap, Count::Zfail, Count::ZpPlus, Count::PlusPlusZp,
                                           Count::AtomicZp};

/// A slab over a floor, lit straight from above at infinity: its shadow is the square below it, 2 by 2.
Scene slabOverFloor() {
    Scene scene;
    scene.objects = {placed("floor", gnomon::rectangle({40, 40}), {0, 0, 0}, false),
                     placed("slab", box({2, 0.25, 2}), {0, 2.5f, 0})};
    scene.lights = {{.position = {0, 1, 0, 0}}};
    scene.frames = {{.eye = {0, 5, 8}, .target = {0, 1, 0}, .fovDegrees = 50, .nearPlane = 0.5f}};
    return scene;
}

/// Whether the ray through a pixel's centre meets the floor first, and where.
struct OnFloor {
    bool hit = false;
    glm::dvec3 at{};
};

OnFloor floorAt(const Camera& camera, int x, int y, int width, int height) {
    const glm::dvec3 eye(camera.eye), forward = glm::normalize(glm::dvec3(camera.target) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double tangent = std::tan(camera.fovDegrees * 3.14159265358979 / 360);
    const double u = ((x + 0.5) / width * 2 - 1) * tangent * width / height;
    const double v = (1 - (y + 0.5) / height * 2) * tangent;
    const glm::dvec3 ray = forward + u * right + v * up;
    // The slab is in the way of all that passes through its heights above it.
    for (const double h : {2.375, 2.625}) {
        const glm::dvec3 p = eye + ray * ((h - eye.y) / ray.y);
        if (ray.y < 0 && std::abs(p.x) < 1.6 && std::abs(p.z) < 1.6) return {};
    }
    const glm::dvec3 at = eye + ray * (-eye.y / ray.y);
    return {ray.y < 0 && std::abs(at.x) < 19 && std::abs(at.z) < 19, at};
}

TEST(EveryCount, DrawsTheRectangleUnderASlab) {
    constexpr int width = 120, height = 90;
    const Scene scene = slabOverFloor();
    Studio studio(scene, width, height);
    for (const Axes& axes : countsOf(kEveryCount)) {
        SCOPED_TRACE(describe(axes));
        const auto mask = studio.mask(axes);
        int lit = 0, dark = 0, wrong = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const OnFloor floor = floorAt(scene.frames[0], x, y, width, height);
                const double reach = std::max(std::abs(floor.at.x), std::abs(floor.at.z));
                // Within 0.01 of the edge a pixel's centre may round either way.
                if (!floor.hit || std::abs(reach - 1) < 0.01) continue;
                const bool shadow = reach < 1;
                ++(shadow ? dark : lit);
                wrong += mask[std::size_t(y) * width + std::size_t(x)] != shadow;
            }
        EXPECT_EQ(wrong, 0);
        EXPECT_GT(dark, 100);
        EXPECT_GT(lit, 2000);
    }
}

// Overlapping volumes: one bit for all of them can't count, so parity in a colour is left out.
TEST(EveryCount, GivesTheMaskOfZpassFromOutside) {
    Studio studio(twoBoxes(), 96, 72);
    const auto zpass = studio.mask(axesOf("heidmann"));
    ASSERT_GT(shadows(zpass), 150);
    int methods = 0;
    for (const Axes& axes : countsOf(kEveryCount)) {
        if (axes.arithmetic == Arithmetic::Parity && axes.store != Store::Stencil) continue;
        EXPECT_EQ(studio.mask(axes), zpass) << describe(axes);
        ++methods;
    }
    EXPECT_GT(methods, 30);
}

TEST(ParityInAColour, LosesShadowsWhereTwoVolumesOverlap) {
    Studio studio(twoBoxes(), 96, 72);
    Axes axes{.store = Store::Screen, .arithmetic = Arithmetic::Parity, .levels = 0};
    const int lost = shadows(studio.mask(axesOf("parity"))) - shadows(studio.mask(axes));
    EXPECT_GT(lost, 5);
}

TEST(CountsFromWithin, SeeTheShadowAllAround) {
    Studio studio(underASlab(), 40, 30);
    for (const Axes& axes : countsOf(kCountsFromWithin))
        EXPECT_THAT(studio.mask(axes), Each(true)) << describe(axes);
    for (const Axes& axes : countsOf({Count::Zpass}))
        EXPECT_THAT(studio.mask(axes), Each(false)) << describe(axes);
}

TEST(CountsFromWithin, SeeItWithAnyStartAndZpassWithABias) {
    Studio studio(underASlab(), 40, 30);
    Axes axes = axesOf("heidmann");
    axes.start = Start::Bias;
    EXPECT_THAT(studio.mask(axes, 1), Each(true));
    EXPECT_THAT(studio.mask(axes, 0), Each(false));
    for (const char* id : {"carmack", "hornus", "eisemann", "atomiczp"}) {
        axes = axesOf(id), axes.start = Start::Middle;
        EXPECT_THAT(studio.mask(axes), Each(true)) << id;
    }
}

/// Parallel squares between light and floor, each a caster of its own, lowest first; sides in world units.
Scene stack(const std::vector<double>& sides) {
    Scene scene;
    Mesh squares;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Mesh one = gnomon::rectangle({sides[i], sides[i]});
        const auto base = std::uint32_t(squares.positions.size());
        for (const glm::vec3& p : one.positions)
            squares.positions.push_back(p + glm::vec3(0, 1 + 0.01f * float(i), 0));
        for (const glm::uvec3& t : one.triangles) squares.triangles.push_back(t + base);
    }
    scene.objects = {placed("floor", gnomon::rectangle({9, 9}), {0, 0, 0}, false),
                     {.name = "squares", .mesh = squares}};
    scene.lights = {{.position = {0.1f, 20, 0.2f, 1}}};
    // Below the squares and beside their shadow, looking through it.
    scene.frames = {{.eye = {0.3f, 0.6f, 4}, .target = {0, 0, -0.8f}, .fovDegrees = 20, .nearPlane = 0.1f}};
    return scene;
}

constexpr int kWidth = 33, kHeight = 25;

/// What the middle of the picture, at z = -0.8 on the floor, is with a method.
bool isDarkInTheMiddle(const Scene& scene, const Axes& axes, const Profile& profile = ideal()) {
    Studio studio(scene, kWidth, kHeight, profile);
    return studio.mask(axes)[std::size_t(kHeight / 2) * kWidth + kWidth / 2];
}

/// @p count volumes hold the middle.
Scene deep(int count) {
    return stack(std::vector<double>(std::size_t(count), 3));
}

/// 40 volumes hold the middle, and the way there leads into and out of 260 more.
Scene deepOnTheWay(std::size_t onTheWay = 260, std::size_t holding = 40) {
    std::vector<double> sides(onTheWay, 0.4);
    sides.resize(onTheWay + holding, 3);
    return stack(sides);
}

Axes overflowing(const char* id, Overflow overflow) {
    Axes axes = axesOf(id);
    axes.overflow = overflow;
    return axes;
}

// Usta et al. 2019, section 4: exactly 256 nested volumes look like none in 8 bits that wrap.
TEST(DeepStacks, FoolAStencilThatWrapsAtExactly256) {
    for (const char* id : {"heidmann", "carmack"}) {
        const Axes wraps = overflowing(id, Overflow::Wrap);
        EXPECT_TRUE(isDarkInTheMiddle(deep(255), wraps)) << id;
        EXPECT_FALSE(isDarkInTheMiddle(deep(256), wraps)) << id;
        EXPECT_TRUE(isDarkInTheMiddle(deep(257), wraps)) << id;
    }
    EXPECT_TRUE(isDarkInTheMiddle(deepOnTheWay(), overflowing("heidmann", Overflow::Wrap)));
}

// Of 300 entries 255 are left, and 260 exits take them all.
TEST(DeepStacks, FoolAStencilThatSaturatesWhereExitsOutnumberWhatItKept) {
    const Axes saturates = overflowing("heidmann", Overflow::Saturate);
    for (const int volumes : {255, 256, 300}) {
        EXPECT_TRUE(isDarkInTheMiddle(deep(volumes), saturates)) << volumes;
    }
    EXPECT_FALSE(isDarkInTheMiddle(deepOnTheWay(), saturates));
}

/// The counts in colour and alpha, however they meet the scene.
std::vector<Axes> maskCounts(Overflow overflow) {
    std::vector<Axes> all;
    for (const char* id : {"screen-count", "alpha-count"})
        for (const Apply apply : {Apply::Blend, Apply::Texture}) {
            all.push_back(overflowing(id, overflow));
            all.back().apply = apply;
        }
    return all;
}

TEST(DeepStacks, FoolAMaskOf8BitsThatClampsAsTheyFoolAStencil) {
    for (const Axes& axes : maskCounts(Overflow::Saturate)) {
        SCOPED_TRACE(describe(axes));
        for (const int volumes : {1, 255, 256, 300}) EXPECT_TRUE(isDarkInTheMiddle(deep(volumes), axes));
        EXPECT_FALSE(isDarkInTheMiddle(deepOnTheWay(), axes));
        EXPECT_FALSE(isDarkInTheMiddle(stack(std::vector<double>(300, 0.4)), axes));
    }
}

TEST(DeepStacks, FoolAMaskOf8BitsThatWrapsAtExactly256) {
    for (const Axes& axes : maskCounts(Overflow::Wrap)) {
        SCOPED_TRACE(describe(axes));
        for (const auto& [volumes, dark] : {std::pair(255, true), {256, false}, {257, true}})
            EXPECT_EQ(isDarkInTheMiddle(deep(volumes), axes), dark) << volumes;
        EXPECT_TRUE(isDarkInTheMiddle(deepOnTheWay(), axes));
    }
}

/// Colours of 5, 6 and 5 bits, and nothing else to count in.
Profile fewBits() {
    Profile p = chip("ideal");
    p.colourFormats = {{"565", 5, 6, 5, 0}};
    p.alphaBits = p.stencilBits = 0;
    p.depthBits = {16};
    return p;
}

// From the middle 15 are left, from 0 all 31.
TEST(DeepStacks, FoolAMaskOf5BitsThatClampsBeyond31OnTheWay) {
    const Profile p = fewBits();
    for (const Apply apply : {Apply::Blend, Apply::Texture}) {
        Axes axes = overflowing("screen-count", Overflow::Saturate);
        axes.apply = apply;
        SCOPED_TRACE(describe(axes));
        for (const int volumes : {1, 31, 32, 40}) EXPECT_TRUE(isDarkInTheMiddle(deep(volumes), axes, p));
        EXPECT_TRUE(isDarkInTheMiddle(deepOnTheWay(30, 5), axes, p));
        EXPECT_FALSE(isDarkInTheMiddle(deepOnTheWay(31, 5), axes, p));
        axes.start = Start::Middle;
        EXPECT_TRUE(isDarkInTheMiddle(deepOnTheWay(14, 5), axes, p));
        EXPECT_FALSE(isDarkInTheMiddle(deepOnTheWay(15, 5), axes, p));
        EXPECT_FALSE(isDarkInTheMiddle(deepOnTheWay(10, 0), axes, p));
    }
}

TEST(DeepStacks, FoolAMaskOf5BitsThatWrapsAtExactly32) {
    const Profile p = fewBits();
    const Axes wraps = overflowing("screen-count", Overflow::Wrap);
    for (const auto& [volumes, dark] : {std::pair(31, true), {32, false}, {33, true}})
        EXPECT_EQ(isDarkInTheMiddle(deep(volumes), wraps, p), dark) << volumes;
    EXPECT_TRUE(isDarkInTheMiddle(deepOnTheWay(60, 5), wraps, p));
}

// Filtering would make counts that no pixel had, and shadows of all of them.
TEST(CountTexture, IsNotFilteredBetweenItsTexels) {
    Studio studio(twoBoxes(), 96, 72);
    for (const char* id : {"screen-count", "alpha-count"}) {
        Axes axes = axesOf(id);
        axes.maskDivisor = 2;
        const auto mask = studio.mask(axes);
        ASSERT_GT(shadows(mask), 150);
        int split = 0;
        for (std::size_t y = 0; y < 72; ++y)
            for (std::size_t x = 0; x < 96; ++x)
                split += mask[y * 96 + x] != mask[(y & ~1u) * 96 + (x & ~1u)];
        EXPECT_EQ(split, 0) << id << ": pixels unlike the first of their texel";
    }
}

// By logic operation or by blending: 255 - v and the inverse of its bits are the same in any number of bits.
TEST(Inversion, IsTheSameByLogicOperationAndByBlending) {
    for (const Profile& with : {ideal(), fewBits()})
        for (const Store store : {Store::Screen, Store::Alpha}) {
            if (store == Store::Alpha && with.alphaBits == 0) continue;
            Axes axes = axesOf("screen-parity");
            axes.store = store;
            Profile without = with;
            without.logicOps = false;
            Studio logic(twoBoxes(), 96, 72, with), blending(twoBoxes(), 96, 72, without);
            const Rendered a = logic.draw(axes), b = blending.draw(axes);
            EXPECT_GT(shadows(a.masks.front()), 150);
            EXPECT_EQ(a.masks, b.masks);
            EXPECT_EQ(a.image, b.image);
        }
}

TEST(DeepStacks, AreCountedRightIn16BitsFromBothEnds) {
    for (const Count count : {Count::Zpass, Count::Zfail}) {
        const Axes counter{.store = Store::Counter, .levels = 0, .count = count};
        for (const int volumes : {1, 255, 256, 257, 300})
            EXPECT_TRUE(isDarkInTheMiddle(deep(volumes), counter)) << name(count) << volumes;
        EXPECT_TRUE(isDarkInTheMiddle(deepOnTheWay(), counter)) << name(count);
        EXPECT_FALSE(isDarkInTheMiddle(stack(std::vector<double>(300, 0.4)), counter)) << name(count);
    }
}

// So that AtomicZP is compared like with like, where nothing hides the eye and where a slab does.
TEST(ShaderVolumes, AreTheHostsToThePixel) {
    for (const char* id : {"heidmann", "eisemann"}) {
        for (const Scene& scene : {twoBoxes(), underASlab()}) {
            constexpr int width = 120, height = 90;
            const Frame frame = frameOf(scene, width, height);
            Surface surface(bufferFormatOf(ideal()), width, height, arithmeticOf(ideal(), {}));
            const Plan plan =
                planFrame(axesOf(id), shapeOf(int(frame.volumes().size()), width, height), ideal());
            const Rendered byHost = render(surface, ideal(), plan, frame.surfaces, frame.lights());
            const Plan shaded = withShaderVolumes(plan);
            const Rendered byShader = render(surface, ideal(), shaded, frame.surfaces, frame.lights());
            EXPECT_EQ(byShader.counts.passes, countPasses(shaded));
            EXPECT_EQ(byShader.image.data, byHost.image.data) << id;
            EXPECT_EQ(byShader.masks, byHost.masks) << id;
        }
    }
}

TEST(TwoLights, DrawWhatEachWouldAlone) {
    Scene scene = twoBoxes();
    scene.lights.push_back({.position = glm::vec4(glm::normalize(glm::vec3(-1.3f, 2.9f, 0.7f)), 0)});
    constexpr int width = 80, height = 60;
    const std::array<Frame, 2> frames{frameOf(scene, width, height, 0), frameOf(scene, width, height, 1)};
    const LightFrames both = [&](int light) -> const LightFrame& { return frames[std::size_t(light)].light; };
    TestSurface surface(bufferFormatOf(ideal()), width, height, arithmeticOf(ideal(), {}));
    FrameShape shape{.width = width, .height = height};
    for (const Frame& frame : frames) shape.lights.push_back({.volumes = int(frame.volumes().size())});
    shape.lights[1].directional = true;
    for (const Axes& axes : allMethods()) {
        if (axes.maskDivisor == 4 || axes.store == Store::None) continue;
        SCOPED_TRACE(describe(axes));
        const Plan plan = planFrame(axes, shape, ideal());
        const Rendered together = render(surface, ideal(), plan, frames[0].surfaces, both);
        EXPECT_EQ(together.counts.passes, countPasses(plan));
        ASSERT_EQ(together.masks.size(), 2u);
        if (axes.shade != Shade::Attenuated) continue;
        for (std::size_t i = 0; i < 2; ++i) {
            const FrameShape one{.width = width, .height = height, .lights = {shape.lights[i]}};
            const Rendered alone = render(surface, ideal(), planFrame(axes, one, ideal()), frames[i].surfaces,
                                          frames[i].lights());
            EXPECT_EQ(together.masks[i], alone.masks.front()) << "light " << i;
        }
    }
}

// 4 of 255: each light's part rounds once more than in one pass, and so does the mask that it takes.
TEST(TwoLights, LookAlikeWhicheverBufferHoldsTheMask) {
    Scene scene = twoBoxes();
    for (Light& light : scene.lights) light.colour = glm::vec3(0.6f);
    scene.lights.push_back({.position = {-2.3f, 5.9f, 2.7f, 1}, .colour = glm::vec3(0.5f)});
    constexpr int width = 80, height = 60;
    const std::array<Frame, 2> frames{frameOf(scene, width, height, 0), frameOf(scene, width, height, 1)};
    const LightFrames both = [&](int light) -> const LightFrame& { return frames[std::size_t(light)].light; };
    TestSurface surface(bufferFormatOf(ideal()), width, height, arithmeticOf(ideal(), {}));
    FrameShape shape{.width = width, .height = height};
    for (const Frame& frame : frames) shape.lights.push_back({.volumes = int(frame.volumes().size())});
    for (const Shade shade : {Shade::Black, Shade::Ambient, Shade::Attenuated}) {
        const auto imageOf = [&](const char* id) {
            Axes axes = axesOf(id);
            axes.shade = shade;
            return render(surface, ideal(), planFrame(axes, shape, ideal()), frames[0].surfaces, both).image;
        };
        const Image stencil = imageOf("carmack");
        for (const char* id : {"roettger-screen", "roettger-screen-max", "screen-texture", "counter",
                               "parity", "atomiczp", "roettger-alpha", "screen-count", "alpha-count"}) {
            const Image other = imageOf(id);
            int largest = 0;
            for (std::size_t i = 0; i < other.data.size(); ++i)
                largest = std::max(largest, std::abs(other.data[i] - stencil.data[i]));
            EXPECT_LE(largest, 4) << id << " " << name(shade);
        }
    }
}

}  // namespace counting_test
}  // namespace gnomon
