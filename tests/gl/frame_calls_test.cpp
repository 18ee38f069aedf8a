// The entry points that a surface keeps from frame to frame.

#include "gl/frame_calls.h"

#include <gtest/gtest.h>

#include "fake_driver.h"
#include "gl/renderer.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {
namespace frame_calls_test {

constexpr int kWidth = 20, kHeight = 12;

TEST(FrameCalls, HoldEachFrameToItsOwnChip) {
    FakeDriver driver;
    FrameCalls calls(BufferFormat{}, driver.table(), Fidelity::Gl);
    const Profile ideal = chip("ideal"), voodoo = chip("voodoo2");
    EXPECT_NO_THROW(calls.begin(ideal).Enable(GL_STENCIL_TEST));
    EXPECT_THROW(calls.begin(voodoo).Enable(GL_STENCIL_TEST), CapabilityViolation);
    EXPECT_NO_THROW(calls.begin(ideal).Enable(GL_STENCIL_TEST));
}

TEST(FrameCalls, ForgetTheStateOfTheLastFrame) {
    FakeDriver driver;
    FrameCalls calls(BufferFormat{}, driver.table(), Fidelity::Gl);
    Profile noAlpha = chip("ideal");
    noAlpha.alphaBits = 0;
    const GlTable& gl = calls.begin(noAlpha);
    gl.ColorMask(1, 1, 1, 1);
    gl.DepthMask(0);
    EXPECT_THROW(gl.Clear(GL_COLOR_BUFFER_BIT), CapabilityViolation);
    gl.ColorMask(1, 1, 1, 0);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    EXPECT_EQ(calls.counts().passes.volume, 1);

    gl.ColorMask(1, 1, 1, 1);
    const GlTable& next = calls.begin(noAlpha);
    EXPECT_EQ(calls.counts().draws, 0);
    EXPECT_NO_THROW(next.Clear(GL_COLOR_BUFFER_BIT));
    next.DrawArrays(GL_TRIANGLES, 0, 3);
    EXPECT_EQ(calls.counts().passes, (PassCounts{.scene = 1}));
}

TEST(FrameCalls, LeadToADriverThatIsDecoratedAfterAFrame) {
    const Profile ideal = chip("ideal");
    const Frame frame = frameOf(twoBoxes(), kWidth, kHeight);
    TestSurface surface(bufferFormatOf(ideal), kWidth, kHeight);
    const Plan plan =
        planFrame(findMethod("carmack")->axes, shapeOf(int(frame.volumes().size()), kWidth, kHeight), ideal);
    const auto draw = [&] { return render(surface, ideal, plan, frame.surfaces, frame.lights()).counts; };
    const CallCounts first = draw();
    long draws = 0;
    surface.decorate([&draws](GlTable next) {
        GlTable gl = next;
        gl.DrawArrays = [next, &draws](GLenum mode, GLint begin, GLsizei count) {
            ++draws;
            next.DrawArrays(mode, begin, count);
        };
        return gl;
    });
    const CallCounts second = draw();
    EXPECT_EQ(draws, first.draws);
    EXPECT_EQ(second.draws, first.draws);
    EXPECT_EQ(second.passes, first.passes);
}

}  // namespace frame_calls_test
}  // namespace gnomon
