// Drawn cells hold what is predicted, and wrong pixels have a cause: whole frames with OpenGL. tests/predict
// holds the predictor by itself; planted_faults_test.cpp and false_predictions_test.cpp see it notice.

#include <gmock/gmock.h>

#include <numeric>

#include "matrix/lab.h"
#include "scenes.h"

namespace gnomon {
namespace prediction_test {

int causesIn(const Cell& cell) {
    return std::accumulate(cell.causes.begin(), cell.causes.end(), 0,
                           [](int sum, const auto& cause) { return sum + cause.second; });
}

/// Nothing unpredicted, nothing unexplained, and a cause for each wrong pixel.
void expectPredicted(const Cell& cell) {
    if (cell.verdict == Verdict::Refused) return;
    EXPECT_NE(cell.verdict, Verdict::Failed) << cell.id() << ": " << cell.error;
    EXPECT_EQ(cell.unpredicted, 0) << cell.id() << ": " << resultOf(cell);
    EXPECT_EQ(causesIn(cell), cell.wrongEdge + cell.wrongInterior) << cell.id();
    EXPECT_THAT(cell.causes, testing::Not(testing::Contains(testing::Key("unexplained")))) << cell.id();
}

class PredictedFrames : public testing::TestWithParam<const char*> {};

TEST_P(PredictedFrames, HoldWhatExactArithmeticSaysWithEveryMethod) {
    Lab lab(shippedScene(GetParam()));
    for (const char* profile : {"ideal", "tnt", "voodoo2", "ps2", "psp-5551", "geforce2mx-565"})
        for (const NamedMethod& named : namedMethods())
            expectPredicted(lab.run(chip(profile), named.axes, 96, 72, 23));
    for (const bool dithers : {false, true}) {
        lab.use({.fidelity = Fidelity::Chip, .dithers = dithers});
        for (const char* profile : {"voodoo1", "ps2", "xbox-565", "gamecube", "dreamcast"})
            for (const NamedMethod& named : namedMethods())
                expectPredicted(lab.run(chip(profile), named.axes, 96, 72, 23));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PredictedFrames, testing::Values("roettger", "boxes", "knot"));

// A volume that lies before the near plane altogether is not drawn, and the next takes its number.
TEST(PredictedFrame, CountNoVolumeThatTheNearPlaneLeavesOut) {
    for (const float near : {7.0f, 9.0f, 12.0f}) {
        Scene scene = shippedScene("boxes");
        for (Camera& camera : scene.frames) camera.nearPlane = near;
        Lab lab(std::move(scene));
        for (const char* id : {"roettger-screen", "roettger-alpha-max", "screen-zfail", "parity"})
            expectPredicted(lab.run(chip("ideal"), method(id), 96, 72, 0));
    }
}

// A mask that goes over the scene as a texture is dithered where it is drawn, too.
TEST(PredictedFrame, DitherAMaskThatIsDrawnAsATexture) {
    Lab lab(shippedScene("boxes"));
    lab.use({.fidelity = Fidelity::Chip, .dithers = true});
    for (const char* profile : {"voodoo1", "voodoo2", "banshee"}) {
        const Cell cell = lab.run(chip(profile), method("screen-texture"), 128, 96, 0);
        EXPECT_NE(cell.verdict, Verdict::Refused);
        expectPredicted(cell);
    }
}

// Mesa keeps an old colour where a colour array is enabled and nothing drawn: gl/renderer.cpp, scene().
TEST(PredictedFrame, OfAnEmptySceneDependOnNoCellBefore) {
    Lab lab(loadScene(kSource / "scenes" / "hard" / "empty.toml"));
    for (const NamedMethod& named : namedMethods()) {
        const Cell cell = lab.run(chip("ideal"), named.axes, 48, 36, 0);
        expectPredicted(cell);
        EXPECT_EQ(resultOf(cell), "exact 0/0") << named.id;
    }
}

}  // namespace prediction_test
}  // namespace gnomon
