// What the counter sees at the calls, against the plans' own lengths and the paper's Table 1.

#include "gl/counter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "fake_driver.h"
#include "gl/renderer.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {
namespace counter_test {

constexpr std::array<float, 8> kWindow{-1, -1, 1, -1, 1, 1, -1, 1};
constexpr std::array<float, 8> kHalfWindow{-1, -1, 0, -1, 0, 1, -1, 1};
constexpr std::array<float, 8> kOneCornerTwice{-1, -1, 1, -1, 1, 1, 1, 1};

/// A counter over a driver that draws nothing, fed by hand.
struct Counted {
    FakeDriver driver{};
    Counter counter{};
    GlTable gl = counter.count(driver.table());

    void quad(const std::array<float, 8>& corners) {
        gl.VertexPointer(2, GL_FLOAT, 0, corners.data());
        gl.DrawArrays(GL_QUADS, 0, 4);
    }
    const PassCounts& passes() const { return counter.counts().passes; }
};

TEST(Counter, CallsFourCornersOfTheViewportARectangle) {
    Counted c;
    c.quad(kWindow);
    EXPECT_EQ(c.passes(), (PassCounts{.rectangle = 1}));
}

TEST(Counter, CallsNothingLessThanTheWholeViewportARectangle) {
    Counted c;
    c.quad(kHalfWindow);
    c.gl.BlendFunc(GL_ONE, GL_ONE);
    c.quad(kOneCornerTwice);
    EXPECT_EQ(c.passes(), (PassCounts{.scene = 2}));
}

// The pointer is an offset then, whatever stands at that address.
TEST(Counter, LooksForNoCornersWhereABufferIsBound) {
    Counted c;
    c.gl.BindBuffer(GL_ARRAY_BUFFER, 1);
    c.quad(kWindow);
    EXPECT_EQ(c.passes(), (PassCounts{.scene = 1}));
    c.gl.BindBuffer(GL_ARRAY_BUFFER, 0);
    c.quad(kWindow);
    EXPECT_EQ(c.passes(), (PassCounts{.scene = 1, .rectangle = 1}));
}

TEST(Counter, CountsEachRectangleUnderOneState) {
    Counted c;
    c.quad(kWindow);
    c.quad(kWindow);
    EXPECT_EQ(c.passes().rectangle, 2);
}

TEST(Counter, CallsConstantColourThatLeavesDepthAloneAVolume) {
    Counted c;
    c.gl.DepthMask(GL_FALSE);
    c.gl.DrawArrays(GL_TRIANGLES, 0, 300);
    EXPECT_EQ(c.passes(), (PassCounts{.volume = 1}));
}

TEST(Counter, CallsDepthWritesOrColoursPerVertexTheScene) {
    Counted c;
    c.gl.DrawArrays(GL_TRIANGLES, 0, 300);
    c.gl.DepthMask(GL_FALSE);
    c.gl.EnableClientState(GL_COLOR_ARRAY);
    c.gl.DrawArrays(GL_TRIANGLES, 0, 300);
    EXPECT_EQ(c.passes(), (PassCounts{.scene = 2}));
}

TEST(Counter, JoinsDrawsWithoutAStateCallBetweenThem) {
    Counted c;
    c.gl.DrawArrays(GL_TRIANGLES, 0, 300);
    c.gl.DrawArrays(GL_TRIANGLES, 300, 30);
    EXPECT_EQ(c.passes().scene, 1);
    EXPECT_EQ(c.counter.counts().draws, 2);
    EXPECT_EQ(c.counter.counts().vertices, 330);
}

TEST(Counter, BeginsAPassAfterEachStateCall) {
    const std::array<std::function<void(const GlTable&)>, 11> calls{{
        [](auto& gl) { gl.Clear(GL_COLOR_BUFFER_BIT); },
        [](auto& gl) { gl.ColorMask(1, 1, 1, 0); },
        [](auto& gl) { gl.Viewport(0, 0, 1, 1); },
        [](auto& gl) { gl.Enable(GL_BLEND); },
        [](auto& gl) { gl.Disable(GL_BLEND); },
        [](auto& gl) { gl.DepthFunc(GL_LEQUAL); },
        [](auto& gl) { gl.DepthMask(GL_TRUE); },
        [](auto& gl) { gl.StencilOp(GL_KEEP, GL_KEEP, GL_INCR); },
        [](auto& gl) { gl.BlendFunc(GL_ONE, GL_ONE); },
        [](auto& gl) { gl.BlendEquation(GL_MAX); },
        [](auto& gl) { gl.CullFace(GL_FRONT); },
    }};
    for (std::size_t i = 0; i < calls.size(); ++i) {
        Counted c;
        c.gl.DrawArrays(GL_TRIANGLES, 0, 3);
        calls[i](c.gl);
        c.gl.DrawArrays(GL_TRIANGLES, 0, 3);
        EXPECT_EQ(c.passes().scene, 2) << "call " << i;
    }
}

TEST(Counter, GoesOnWithARunWhereTheScissorMoves) {
    Counted c;
    c.gl.DrawArrays(GL_TRIANGLES, 0, 3);
    c.gl.Scissor(1, 2, 3, 4);
    c.gl.DrawArrays(GL_TRIANGLES, 3, 3);
    EXPECT_EQ(c.passes().scene, 1);
    EXPECT_EQ(c.driver.calls(), (std::vector<std::string>{"glDrawArrays", "glScissor", "glDrawArrays"}));
}

TEST(Counter, CountsThePartsOfOneCopyAsOne) {
    Counted c;
    c.gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, 61, 43);
    c.gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 61, 0, 60, 0, 1, 43);
    EXPECT_EQ(c.passes(), (PassCounts{.copy = 1}));
}

TEST(Counter, PassesEveryCallOn) {
    Counted c;
    c.gl.Enable(GL_BLEND);
    c.gl.BlendFunc(GL_ONE, GL_ONE);
    c.quad(kWindow);
    c.gl.Finish();
    EXPECT_THAT(c.driver.calls(), testing::ElementsAre("glEnable", "glBlendFunc", "glVertexPointer",
                                                       "glDrawArrays", "glFinish"));
}

TEST(Counter, BeginsAnewAfterAReset) {
    Counted c;
    c.gl.DrawArrays(GL_TRIANGLES, 0, 3);
    c.counter.reset();
    EXPECT_EQ(c.passes(), PassCounts{});
    EXPECT_EQ(c.counter.counts().draws, 0);
    c.gl.DrawArrays(GL_TRIANGLES, 0, 3);
    EXPECT_EQ(c.passes().scene, 1);
}

/// What is counted of one frame of the two boxes on the chip without limits.
PassCounts countedOf(const Axes& axes) {
    static const Profile ideal = chip("ideal");
    static TestSurface surface(bufferFormatOf(ideal), 21, 13, arithmeticOf(ideal, {}));
    static const Frame frame = frameOf(twoBoxes(), 21, 13);
    const Plan plan = planFrame(axes, shapeOf(int(frame.volumes().size()), 21, 13), ideal);
    return render(surface, ideal, plan, frame.surfaces, frame.lights()).counts.passes;
}

TEST(CountedPasses, AreThoseOfThePlanForEveryMethod) {
    for (const Axes& axes : allMethods())
        EXPECT_EQ(countedOf(axes), countPasses(planFrame(axes, shapeOf(2, 21, 13), chip("ideal"))))
            << describe(axes);
}

struct Published {
    const char* method;
    Shade shade;
    int scene, rectangles;
};
void PrintTo(const Published& p, std::ostream* out) {
    *out << p.method << " " << name(p.shade);
}

class Table1 : public testing::TestWithParam<Published> {};

// Roettger et al. 2002, Table 1: rendering passes / rectangles drawn across the window. The numbers in
// brackets are those of the maximum blend equation, which leaves the scene's passes as they are.
TEST_P(Table1, IsWhatIsCountedAtTheCalls) {
    const auto& [method, shade, scene, rectangles] = GetParam();
    Axes axes = findMethod(method)->axes;
    axes.shade = shade;
    EXPECT_EQ(countedOf(axes), (PassCounts{.scene = scene, .volume = 2 * 2, .rectangle = rectangles}));
}

INSTANTIATE_TEST_SUITE_P(Roettger2002, Table1,
                         testing::Values(Published{"roettger-alpha", Shade::Black, 1, 4},
                                         Published{"roettger-alpha", Shade::Ambient, 2, 4},
                                         Published{"roettger-alpha", Shade::Attenuated, 1, 4},
                                         Published{"roettger-alpha-max", Shade::Attenuated, 1, 2},
                                         Published{"roettger-screen", Shade::Black, 2, 3},
                                         Published{"roettger-screen", Shade::Ambient, 3, 3},
                                         Published{"roettger-screen", Shade::Attenuated, 2, 3},
                                         Published{"roettger-screen-max", Shade::Attenuated, 2, 1}),
                         [](const auto& test) {
                             std::string id = test.param.method + ("-" + name(test.param.shade));
                             std::replace(id.begin(), id.end(), '-', '_');
                             return id;
                         });

}  // namespace counter_test
}  // namespace gnomon
