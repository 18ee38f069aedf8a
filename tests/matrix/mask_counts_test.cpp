// Counts in a colour or alpha buffer, held against truth and against the stencil's, and explained where nests
// are too deep for the channel.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "matrix/lab.h"
#include "scene/primitives.h"
#include "scenes.h"

namespace gnomon {
namespace mask_counts_test {

using testing::ElementsAre;
using testing::Pair;

constexpr int kWidth = 96, kHeight = 72;

/// The counts in colour and alpha, from all starts and with all overflows that are drawn.
std::vector<Axes> maskCounts() {
    std::vector<Axes> all;
    for (const char* id : {"screen-count", "alpha-count"})
        for (const Apply apply : {Apply::Blend, Apply::Texture})
            for (const Overflow overflow : {Overflow::Either, Overflow::Wrap, Overflow::Saturate})
                for (const Start start : {Start::Zero, Start::Middle}) {
                    Axes axes = method(id);
                    axes.apply = apply, axes.overflow = overflow, axes.start = start;
                    if (!contradiction(axes)) all.push_back(axes);
                }
    return all;
}

TEST(MaskCounts, AreExactAndShowTheStencilsShadows) {
    const Profile ideal = chip("ideal");
    for (const char* scene : {"boxes", "roettger", "knot"}) {
        Lab lab(shippedScene(scene));
        for (const Count count : {Count::ZpassCap, Count::Zfail}) {
            Pictures stencil;
            lab.run(ideal, with(method("heidmann"), count), kWidth, kHeight, 17, &stencil);
            for (const Axes& axes : maskCounts()) {
                Pictures own;
                const Cell cell = lab.run(ideal, with(axes, count), kWidth, kHeight, 17, &own);
                EXPECT_EQ(resultOf(cell), "exact 0/0") << scene << " " << cell.method;
                EXPECT_EQ(own.mask, stencil.mask) << scene << " " << cell.method;
            }
        }
    }
}

TEST(MaskCounts, AreEachJudgedByTheirOwnTruthWithTwoLights) {
    Scene scene = shippedScene("boxes");
    scene.lights.push_back(
        {.position = glm::vec4(glm::normalize(glm::vec3(-3.1f, 4.3f, 1.7f)), 0), .colour = glm::vec3(0.4f)});
    Lab lab(scene);
    for (const Axes& axes : maskCounts())
        EXPECT_EQ(resultOf(lab.run(chip("ideal"), axes, kWidth, kHeight, 0)), "exact 0/0") << methodId(axes);
}

TEST(MaskCounts, AreExactWithSmallMasksAwayFromShadowEdges) {
    Lab lab(shippedScene("boxes"));
    for (Axes axes : maskCounts()) {
        if (axes.apply != Apply::Texture) continue;
        axes.maskDivisor = 2;
        const Cell cell = lab.run(chip("ideal"), axes, kWidth, kHeight, 0);
        EXPECT_THAT(cell.causes,
                    ElementsAre(Pair("low mask resolution", cell.wrongEdge + cell.wrongInterior)))
            << resultOf(cell);
        EXPECT_LT(cell.wrongInterior, 10) << resultOf(cell);
    }
}

/// A nest of flat boxes between light and floor, small ones under large ones.
Scene nest(int small, int large) {
    Scene scene;
    const auto placed = [](Mesh mesh, float height) {
        for (glm::vec3& p : mesh.positions) p.y += height;
        return mesh;
    };
    scene.objects = {{.name = "floor", .mesh = rectangle({9, 9}), .casts = false}};
    for (int i = 0; i < small + large; ++i) {
        const double side = i < small ? 0.4 : 3;
        scene.objects.push_back({.name = "box " + std::to_string(i),
                                 .mesh = placed(box({side, 0.004, side + 0.003 * i}), 1 + 0.02f * float(i))});
    }
    scene.lights = {{.position = {0.1f, 20, 0.2f, 1}}};
    // Below the boxes: looking through the shadow of the small ones.
    scene.frames = {{.eye = {0.3f, 0.6f, 4}, .target = {0, 0, -0.8f}, .fovDegrees = 20, .nearPlane = 0.1f}};
    return scene;
}

/// Colours of 5, 6 and 5 bits, a stencil or none.
Profile fewBits() {
    Profile p = chip("ideal");
    p.colourFormats = {{"565", 5, 6, 5, 0}};
    p.alphaBits = p.stencilBits = 0;
    p.depthBits = {16};
    return p;
}

/// @p cell is wrong, and all of it for one reason.
void expectWrong(const Cell& cell, const std::string& cause) {
    EXPECT_EQ(cell.verdict, Verdict::Wrong) << resultOf(cell);
    EXPECT_THAT(cell.causes, ElementsAre(Pair(cause, cell.wrongEdge + cell.wrongInterior)));
}

Axes overflowing(const char* id, Overflow overflow) {
    Axes axes = method(id);
    axes.overflow = overflow;
    return axes;
}

// 31 of the 36 entries before the surface are kept, and 31 exits take them all.
TEST(DeepNests, ClampAMaskOf5Bits) {
    Lab fits(nest(26, 5)), tooDeep(nest(31, 5));
    for (const Apply apply : {Apply::Blend, Apply::Texture}) {
        Axes axes = overflowing("screen-count", Overflow::Saturate);
        axes.apply = apply;
        EXPECT_EQ(resultOf(fits.run(fewBits(), axes, kWidth, kHeight, 0)), "exact 0/0");
        expectWrong(tooDeep.run(fewBits(), axes, kWidth, kHeight, 0), "mask clamps");
        EXPECT_EQ(resultOf(tooDeep.run(chip("ideal"), axes, kWidth, kHeight, 0)), "exact 0/0") << "8 bits";
    }
}

// Fewer than 8 bits end at 0, from which doubling doesn't come back.
TEST(HalvedMask, Of5BitsUnderflowsOnAKnot) {
    Lab lab(shippedScene("knot"));
    const Cell cell = lab.run(fewBits(), method("roettger-screen-max"), kWidth, kHeight, 0);
    EXPECT_EQ(cell.verdict, Verdict::Wrong);
    EXPECT_THAT(cell.causes, testing::ElementsAre(testing::Key("mask underflows")));
}

TEST(ChipsArithmetic, RefusesWhatItsBlendUnitHasNot) {
    Lab lab(shippedScene("boxes"));
    FidelityChoice choice{.fidelity = Fidelity::Chip};
    lab.use(choice);
    const Cell refused = lab.run(chip("vsa100-16"), method("screen-count"), kWidth, kHeight, 0);
    EXPECT_EQ(refused.verdict, Verdict::Refused);
    ASSERT_EQ(refused.missing.size(), 1u);
    EXPECT_EQ(refused.missing[0].key, "blend_units");
    EXPECT_EQ(refused.missing[0].what,
              "blend one one by equation reverse_subtract in the blend unit voodoo_mame");
    choice.unit = BlendUnit::ProductsRound;
    lab.use(choice);
    const Cell drawn = lab.run(chip("vsa100-16"), method("screen-count"), kWidth, kHeight, 0);
    EXPECT_THAT(drawn.causes, testing::Contains(testing::Key("dither drift")))
        << "it dithers whether one likes it or not";
    lab.use({});
    EXPECT_EQ(lab.run(chip("vsa100-16"), method("screen-count"), kWidth, kHeight, 0).verdict, Verdict::Exact);
}

TEST(ChipsArithmetic, NamesRoundingAndDitherWhereOpenGlIsRight) {
    Lab lab(shippedScene("boxes"));
    lab.use({.fidelity = Fidelity::Chip});
    const Cell rounded = lab.run(chip("xbox-565"), method("roettger-screen"), kWidth, kHeight, 0);
    EXPECT_EQ(rounded.fidelity, "chip");
    EXPECT_THAT(rounded.causes, testing::ElementsAre(testing::Key("rounding residue")));
    EXPECT_EQ(lab.run(chip("voodoo2"), method("roettger-screen"), kWidth, kHeight, 0).verdict,
              Verdict::Exact);
    lab.use({.fidelity = Fidelity::Chip, .dithers = true});
    const Cell dithered = lab.run(chip("voodoo2"), method("roettger-screen"), kWidth, kHeight, 0);
    EXPECT_THAT(dithered.causes, testing::ElementsAre(testing::Key("dither drift")));
}

TEST(DeepNests, WrapAMaskOf5Bits) {
    const Axes axes = overflowing("screen-count", Overflow::Wrap);
    Lab fits(nest(26, 5)), tooDeep(nest(0, 32));
    EXPECT_EQ(resultOf(fits.run(fewBits(), axes, kWidth, kHeight, 0)), "exact 0/0");
    expectWrong(tooDeep.run(fewBits(), axes, kWidth, kHeight, 0), "mask wraps");
}

TEST(DeepNests, WrapOrSaturateAStencil) {
    Lab wraps(nest(0, 256)), saturates(nest(255, 5));
    expectWrong(wraps.run(chip("ideal"), overflowing("heidmann", Overflow::Wrap), 48, 36, 0),
                "stencil wraps to zero");
    expectWrong(saturates.run(chip("ideal"), overflowing("heidmann", Overflow::Saturate), 48, 36, 0),
                "stencil saturates");
    EXPECT_EQ(resultOf(saturates.run(chip("ideal"), overflowing("heidmann", Overflow::Wrap), 48, 36, 0)),
              "exact 0/0");
}

}  // namespace mask_counts_test
}  // namespace gnomon
