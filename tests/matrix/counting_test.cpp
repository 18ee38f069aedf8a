// Every way to count and every silhouette, held against truth and against each other: far from volumes,
// inside them, on a ring of lights about the eye, and where the near plane cuts a caster.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "matrix/lab.h"
#include "scene/primitives.h"
#include "scenes.h"

namespace gnomon {
namespace counting_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

constexpr int kWidth = 96, kHeight = 72;

const Profile& ideal() {
    static const Profile profile = chip("ideal");
    return profile;
}

Axes stencilCounting(Count count) {
    return {.store = Store::Stencil, .count = count};
}

/// Those that are right wherever the eye is.
const std::vector<Axes>& robustMethods() {
    static const std::vector<Axes> methods{method("carmack"),  method("hornus"),
                                           method("eisemann"), method("atomiczp"),
                                           method("counter"),  stencilCounting(Count::ZpassCap)};
    return methods;
}

class NamedMethod : public testing::TestWithParam<std::string> {};

TEST_P(NamedMethod, IsExactOnConvexCasters) {
    Lab lab(shippedScene("boxes"));
    for (const int frame : {0, 17, 41})
        EXPECT_EQ(resultOf(lab.run(ideal(), method(GetParam()), 160, 120, frame)), "exact 0/0") << frame;
}

/// All but those that give up exactness on purpose; parity in a colour can't tell volumes apart.
std::vector<std::string> exactMethods() {
    std::vector<std::string> ids;
    for (const gnomon::NamedMethod& row : namedMethods())
        if (row.axes.store != Store::None && row.axes.store != Store::DepthMap && row.axes.maskDivisor == 1 &&
            (row.axes.arithmetic != Arithmetic::Parity || row.axes.store == Store::Stencil))
            ids.push_back(row.id);
    return ids;
}

std::string identifier(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return text;
}

INSTANTIATE_TEST_SUITE_P(Boxes, NamedMethod, testing::ValuesIn(exactMethods()),
                         [](const auto& test) { return identifier(test.param); });

/// Numbers that are the same with every standard library.
class Dice {
  public:
    explicit Dice(unsigned seed) : m_random(seed) {}
    float between(float low, float high) {
        return low + (high - low) * float(double(m_random()) / 4294967296.0);
    }
    glm::vec3 direction() {
        for (;;) {
            const glm::vec3 v(between(-1, 1), between(-1, 1), between(-1, 1));
            if (glm::dot(v, v) > 0.1f && glm::dot(v, v) < 1) return glm::normalize(v);
        }
    }
    std::size_t below(std::size_t n) { return m_random() % n; }

  private:
    std::mt19937 m_random;
};

glm::vec3 centreOf(const Object& object) {
    glm::vec3 sum(0);
    for (const glm::vec3& p : object.mesh.positions) sum += p;
    return sum / float(object.mesh.positions.size());
}

/// From @p at away from @p light.
glm::vec3 awayFrom(const glm::vec4& light, const glm::vec3& at) {
    return glm::normalize(at * light.w - glm::vec3(light));
}

glm::vec4 someLight(Dice& dice, bool directional) {
    const glm::vec3 at(dice.between(-4, 4), dice.between(6, 10), dice.between(-4, 4));
    return directional ? glm::vec4(glm::normalize(at), 0) : glm::vec4(at, 1);
}

const Object& someCaster(const Scene& scene, Dice& dice) {
    for (;;) {
        const Object& object = scene.objects[dice.below(scene.objects.size())];
        if (object.casts) return object;
    }
}

/// The boxes, with the eye in the shadow of one of them.
Scene eyeInside(Dice& dice, bool directional) {
    Scene scene = shippedScene("boxes");
    const glm::vec4 light = someLight(dice, directional);
    glm::vec3 eye(0);
    while (eye.y < 0.3f) {
        const glm::vec3 centre = centreOf(someCaster(scene, dice));
        eye = centre + dice.between(0.8f, 2.5f) * awayFrom(light, centre);
    }
    scene.lights = {{.position = light}};
    scene.frames = {{.eye = eye,
                     .target = {dice.between(-3, 3), dice.between(0, 1.5f), dice.between(-3, 3)},
                     .fovDegrees = 65,
                     .nearPlane = 0.03f}};
    return scene;
}

/// A scene with an eye that stays and a light on a ring of 8 about it.
Scene lightOnRing(int step, bool directional, const std::string& id = "boxes") {
    Scene scene = shippedScene(id);
    const glm::vec3 eye(0.43f, 2.61f, 4.87f);
    const float angle = float(step) * 0.785398f + 0.137f;
    const glm::vec3 towards(3.1f * std::cos(angle), 3.1f * std::sin(angle),
                            0.67f * std::sin(2 * angle) + 0.31f);
    scene.lights = {
        {.position = directional ? glm::vec4(glm::normalize(towards), 0) : glm::vec4(eye + towards, 1)}};
    scene.frames = {{.eye = eye, .target = {0.11f, 1.23f, -0.17f}, .fovDegrees = 60, .nearPlane = 0.25f}};
    return scene;
}

/// The boxes, with the near plane through one of them.
Scene casterCut(Dice& dice, bool directional) {
    Scene scene = shippedScene("boxes");
    const glm::vec3 centre = centreOf(someCaster(scene, dice));
    const float distance = dice.between(1.1f, 2.0f);
    glm::vec3 from = dice.direction();
    from.y = std::abs(from.y) * 0.6f;
    scene.lights = {{.position = someLight(dice, directional)}};
    scene.frames = {{.eye = centre + distance * glm::normalize(from),
                     .target = centre,
                     .fovDegrees = 60,
                     .nearPlane = distance * dice.between(0.93f, 1.07f)}};
    return scene;
}

/// Draws the only frame of @p scene with each of the robust methods.
void expectRobust(const Scene& scene) {
    Lab lab(scene);
    std::optional<Image> first;
    for (const Axes& axes : robustMethods()) {
        SCOPED_TRACE(methodId(axes));
        Pictures pictures;
        const Cell cell = lab.run(ideal(), axes, kWidth, kHeight, 0, &pictures);
        EXPECT_EQ(resultOf(cell), "exact 0/0");
        if (!first) first = pictures.mask;
        int different = 0;
        for (std::size_t i = 0; i < first->data.size() && i < pictures.mask.data.size(); ++i)
            different += first->data[i] != pictures.mask.data[i];
        EXPECT_EQ(different, 0) << "pixels unlike carmack's, tied ones included";
    }
}

class RobustMethods : public testing::TestWithParam<bool> {
  protected:
    bool directional() const { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Lights, RobustMethods, testing::Bool(),
                         [](const auto& test) { return test.param ? "Directional" : "Point"; });

TEST_P(RobustMethods, AgreeAndAreExactWithTheEyeInsideAVolumeWhereZpassIsWrong) {
    Dice dice(11);
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(i);
        const Scene scene = eyeInside(dice, directional());
        expectRobust(scene);
        const Cell zpass = Lab(scene).run(ideal(), method("heidmann"), kWidth, kHeight, 0);
        EXPECT_EQ(zpass.verdict, Verdict::Wrong) << resultOf(zpass);
        EXPECT_THAT(zpass.causes,
                    ElementsAre(testing::Pair("eye inside a volume", zpass.wrongEdge + zpass.wrongInterior)));
    }
}

TEST_P(RobustMethods, AgreeAndAreExactOnARingOfLightsAboutTheEye) {
    for (int step = 0; step < 8; ++step) {
        SCOPED_TRACE(step);
        expectRobust(lightOnRing(step, directional()));
    }
}

TEST_P(RobustMethods, AgreeAndAreExactWithTheNearPlaneCuttingACaster) {
    Dice dice(23);
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(i);
        expectRobust(casterCut(dice, directional()));
    }
}

// The knot's own volume is entered up to five times on a ray.
TEST_P(RobustMethods, AgreeAndAreExactOnANonConvexCaster) {
    for (const int step : {1, 6}) {
        SCOPED_TRACE(step);
        expectRobust(lightOnRing(step, directional(), "knot"));
    }
}

/// One view of each hard kind.
std::vector<Scene> hardViews(unsigned seed, bool directional) {
    Dice dice(seed);
    return {eyeInside(dice, directional), lightOnRing(int(seed % 8), directional),
            casterCut(dice, directional)};
}

// Where volumes are cut is a matter of cost (Usta et al. 2019, section 4).
TEST_P(RobustMethods, AreExactWhereverTheirVolumesAreCut) {
    for (const unsigned seed : {2u, 7u})
        for (const Scene& scene : hardViews(seed, directional())) {
            Lab lab(scene);
            for (const Clip clip : {Clip::Eye, Clip::None})
                for (Axes axes : robustMethods()) {
                    axes.clip = clip;
                    EXPECT_EQ(resultOf(lab.run(ideal(), axes, kWidth, kHeight, 0)), "exact 0/0")
                        << methodId(axes) << " " << seed;
                }
        }
}

// The host flattens what lies before the near plane there; whole sides it would have to leave out.
TEST_P(RobustMethods, NeedNoDepthClampWhereTheHostCutsVolumesAtTheNearPlane) {
    Profile without = ideal();
    without.depthClamp = false;
    for (const Scene& scene : hardViews(5, directional())) {
        Lab lab(scene);
        for (const Axes& axes : robustMethods()) {
            const bool inShader = axes.count == Count::AtomicZp;
            EXPECT_EQ(resultOf(lab.run(without, axes, kWidth, kHeight, 0)),
                      inShader ? "refused 0/0, lacks depth clamp" : "exact 0/0")
                << methodId(axes);
        }
        Axes whole = method("eisemann");
        whole.clip = Clip::Eye;
        EXPECT_EQ(resultOf(lab.run(without, whole, kWidth, kHeight, 0)), "refused 0/0, lacks depth clamp");
    }
}

// From outside of casters nothing but their own unlit faces lies within the offset.
TEST_P(RobustMethods, AreExactWithVolumesThatStartAHundredthBehindTheirCasters) {
    Dice dice(17);
    for (int i = 0; i < 4; ++i) {
        Lab lab(i % 2 == 0 ? eyeInside(dice, directional()) : lightOnRing(i, directional()));
        for (const char* id : {"carmack", "counter"}) {
            Axes axes = method(id);
            axes.offset = 0.01f;
            EXPECT_EQ(resultOf(lab.run(ideal(), axes, kWidth, kHeight, 0)), "exact 0/0") << id << " " << i;
        }
    }
}

/// What the frame of several lights shows of each is what it shows of it alone.
TEST(TwoLights, AreEachJudgedByTheirOwnTruth) {
    const Light second{.position = glm::vec4(glm::normalize(glm::vec3(-3.1f, 4.3f, 1.7f)), 0),
                       .colour = glm::vec3(0.4f)};
    Scene both = shippedScene("boxes"), other = both;
    const Scene one = both;
    both.lights.push_back(second);
    other.lights = {second};
    Lab lab(both), first(one), last(other);
    for (const char* id : {"carmack", "heidmann", "roettger-alpha", "roettger-screen", "screen-texture",
                           "parity", "hornus", "eisemann", "atomiczp", "counter"}) {
        SCOPED_TRACE(id);
        Pictures together, alone, beside;
        const Cell cell = lab.run(ideal(), method(id), kWidth, kHeight, 0, &together);
        EXPECT_EQ(cell.lights, 2);
        EXPECT_EQ(resultOf(cell), "exact 0/0");
        first.run(ideal(), method(id), kWidth, kHeight, 0, &alone);
        last.run(ideal(), method(id), kWidth, kHeight, 0, &beside);
        ASSERT_THAT(together.mask.data, SizeIs(alone.mask.data.size()));
        int different = 0, shadows = 0;
        for (std::size_t i = 0; i < together.mask.data.size(); ++i) {
            const int average = (alone.mask.data[i] + beside.mask.data[i]) / 2;
            different += together.mask.data[i] != average;
            shadows += average != 255;
        }
        EXPECT_EQ(different, 0);
        EXPECT_GT(shadows, 500);
    }
    EXPECT_EQ(lab.run(ideal(), method("none"), kWidth, kHeight, 0).verdict, Verdict::Wrong);
}

TEST(TwoLights, AreRefusedOnTheScreenWhereTheFrameSoFarCannotBeKept) {
    Scene scene = shippedScene("boxes");
    scene.lights.push_back({.position = {-3.7f, 9.1f, 2.3f, 1}});
    Lab two(scene), one(shippedScene("boxes"));
    Profile chipWithout = ideal();
    chipWithout.frameTexture = FrameTexture::None;
    EXPECT_EQ(resultOf(two.run(chipWithout, method("roettger-screen"), kWidth, kHeight, 0)),
              "refused 0/0, lacks a frame buffer that becomes a texture");
    EXPECT_EQ(one.run(chipWithout, method("roettger-screen"), kWidth, kHeight, 0).verdict, Verdict::Exact);
    EXPECT_EQ(two.run(chipWithout, method("roettger-alpha"), kWidth, kHeight, 0).verdict, Verdict::Exact);
    EXPECT_EQ(two.run(chipWithout, method("heidmann"), kWidth, kHeight, 0).verdict, Verdict::Exact);
}

class EachSilhouette : public testing::TestWithParam<Silhouette> {};
INSTANTIATE_TEST_SUITE_P(Boxes, EachSilhouette,
                         testing::Values(Silhouette::Triangular, Silhouette::Visible, Silhouette::Manifold,
                                         Silhouette::Winding, Silhouette::PerTriangle),
                         [](const auto& test) { return identifier(name(test.param)); });

TEST_P(EachSilhouette, IsExactOnClosedCastersFromInsideAndOutside) {
    Lab outside(shippedScene("boxes"));
    for (const int frame : {0, 41})
        for (const char* id : {"heidmann", "carmack", "roettger-screen"})
            EXPECT_EQ(resultOf(outside.run(ideal(), with(method(id), GetParam()), kWidth, kHeight, frame)),
                      "exact 0/0")
                << id << " " << frame;
    for (const bool directional : {false, true}) {
        Dice dice(5);
        Lab inside(eyeInside(dice, directional));
        for (const Count count : {Count::Zfail, Count::ZpassCap, Count::ZpPlus, Count::PlusPlusZp})
            EXPECT_EQ(
                resultOf(inside.run(ideal(), with(stencilCounting(count), GetParam()), kWidth, kHeight, 0)),
                "exact 0/0")
                << name(count);
    }
}

/// The boxes, one of which has lost a triangle.
Scene openBoxes() {
    Scene scene = shippedScene("boxes");
    scene.objects[3].mesh.triangles.pop_back();
    return scene;
}

TEST(ManifoldSilhouette, IsRefusedAnOpenMeshWithObjectAndEdge) {
    Lab lab(openBoxes());
    const Cell cell = lab.run(ideal(), with(method("heidmann"), Silhouette::Manifold), kWidth, kHeight, 0);
    EXPECT_EQ(cell.verdict, Verdict::Refused);
    ASSERT_THAT(cell.missing, SizeIs(1));
    EXPECT_EQ(cell.missing[0].key, "silhouette");
    EXPECT_THAT(cell.missing[0].what, AllOf(HasSubstr("low_east"), HasSubstr("edge")));
    EXPECT_EQ(resultOf(lab.run(ideal(), method("heidmann"), kWidth, kHeight, 0)), "exact 0/0");
}

TEST(CapsAway, AreExactOnClosedCastersAndRefusedOpenOnes) {
    Axes axes = method("carmack");
    axes.capFaces = CapFaces::Away;
    Lab closed(shippedScene("boxes")), open(openBoxes());
    for (const int frame : {0, 17, 41})
        EXPECT_EQ(resultOf(closed.run(ideal(), axes, kWidth, kHeight, frame)), "exact 0/0") << frame;
    EXPECT_EQ(open.run(ideal(), axes, kWidth, kHeight, 0).verdict, Verdict::Refused);
}

TEST(Start, InTheMiddleOrAtTheEyesCountIsExactWithTheEyeInsideAVolume) {
    for (const bool directional : {false, true}) {
        Dice dice(31);
        for (int i = 0; i < 4; ++i) {
            Lab lab(eyeInside(dice, directional));
            Axes biased = method("heidmann");
            biased.start = Start::Bias;
            EXPECT_EQ(resultOf(lab.run(ideal(), biased, kWidth, kHeight, 0)), "exact 0/0") << i;
            for (Axes axes : robustMethods()) {
                if (axes.store != Store::Stencil) continue;
                axes.start = Start::Middle;
                EXPECT_EQ(resultOf(lab.run(ideal(), axes, kWidth, kHeight, 0)), "exact 0/0")
                    << methodId(axes) << " " << i;
            }
        }
    }
}

TEST(DepthMap, IsWrongAtMostNearShadowEdges) {
    Lab lab(shippedScene("boxes"));
    const Cell coarse =
        lab.run(ideal(), {.store = Store::DepthMap, .mapSize = 128, .mapBias = 0.02f}, kWidth, kHeight, 0);
    const Cell fine =
        lab.run(ideal(), {.store = Store::DepthMap, .mapSize = 2048, .mapBias = 0.002f}, kWidth, kHeight, 0);
    const Cell none = lab.run(ideal(), method("none"), kWidth, kHeight, 0);
    EXPECT_LT(fine.wrongEdge + fine.wrongInterior, (coarse.wrongEdge + coarse.wrongInterior) / 2)
        << resultOf(fine) << " and " << resultOf(coarse);
    EXPECT_LT(coarse.wrongEdge + coarse.wrongInterior, (none.wrongEdge + none.wrongInterior) / 2);
}

}  // namespace counting_test
}  // namespace gnomon
