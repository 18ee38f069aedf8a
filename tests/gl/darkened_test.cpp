// The rectangle with the mask's texture is drawn only where the mask darkens.

#include "gl/darkened.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gl/pass_runner.h"
#include "gl/renderer.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {

void PrintTo(const WindowRect& r, std::ostream* out) {
    *out << r.x << "," << r.y << " " << r.width << "x" << r.height;
}

namespace darkened_test {

/// A driver whose frame buffer is lit but for some pixels.
GlTable reading(std::vector<glm::ivec2> dark) {
    GlTable gl;
    gl.ReadPixels = [=](GLint, GLint y, GLsizei width, GLsizei height, GLenum, GLenum, void* out) {
        auto* bytes = static_cast<std::uint8_t*>(out);
        std::fill_n(bytes, width * height * 4, std::uint8_t(255));
        for (const glm::ivec2 p : dark)
            if (p.y >= y && p.y < y + height) bytes[((p.y - y) * width + p.x) * 4] = 254;
    };
    return gl;
}

WindowRect darkenedBy(std::vector<glm::ivec2> dark, MaskTexture texture = MaskTexture::Rgb) {
    return darkenedPart(reading(std::move(dark)),
                        {.width = 1000, .height = 800, .maskWidth = 500, .maskHeight = 400}, texture);
}

TEST(DarkenedPart, IsEmptyWhereTheMaskIsOneEverywhere) {
    EXPECT_TRUE(darkenedBy({}).empty());
    EXPECT_TRUE(darkenedBy({{7, 9}}, MaskTexture::Alpha).empty());  // red alone is not one
}

TEST(DarkenedPart, HoldsAllThatTheFilterMixesWithADarkTexel) {
    // Texel 7 lies around pixel 15; its neighbours' centres, pixels 13 and 17, have none of it any more.
    const WindowRect one = darkenedBy({{7, 9}});
    EXPECT_EQ(one, (WindowRect{11, 15, 8, 8}));
    const WindowRect two = darkenedBy({{250, 30}, {100, 399}});
    EXPECT_TRUE(two.holds(201, 799));
    EXPECT_TRUE(two.holds(503, 58));
    EXPECT_LT(two.width * two.height, 320 * 760);
}

TEST(DarkenedPart, EndsAtTheWindow) {
    EXPECT_EQ(darkenedBy({{0, 0}, {499, 399}}), (WindowRect{0, 0, 1000, 800}));
}

/// A frame as render() draws it, with or without what is left out.
std::vector<std::uint8_t> drawn(Surface& surface, const Profile& profile, const Plan& plan,
                                const Frame& frame, bool leavesOut) {
    surface.makeCurrent();
    const GlTable& driver = surface.driver();
    resetState(driver);
    const LightFrames lights = frame.lights();
    PassRunner runner(driver, surface, profile, plan, frame.surfaces, lights, VertexSource::HostMemory);
    if (leavesOut) runner.leaveOutLit();
    for (const Pass& pass : plan.passes) runner.run(pass);
    surface.objects().endFrame(driver);
    return readColour(surface).data;
}

struct Size {
    int width = 0, height = 0;
};

TEST(MaskRectangle, GivesTheSameImageWhereItLeavesOutWhatIsLit) {
    int smaller = 0;
    for (const std::string id : {"ideal", "geforce2mx", "tnt", "voodoo2", "voodoo3"}) {
        const Profile profile = chip(id);
        for (const Size size : {Size{61, 43}, Size{64, 48}}) {
            const Frame frame = frameOf(twoBoxes(), size.width, size.height);
            TestSurface surface(bufferFormatOf(profile), size.width, size.height);
            std::vector<WindowRect> scissors;
            surface.decorate([&scissors](GlTable next) {
                GlTable gl = next;
                gl.Scissor = [=, &scissors](GLint x, GLint y, GLsizei width, GLsizei height) {
                    scissors.push_back({x, y, width, height});
                    next.Scissor(x, y, width, height);
                };
                return gl;
            });
            for (const Axes& axes : allMethods()) {
                const bool isRead = axes.store == Store::Screen || axes.store == Store::Alpha;
                if (!isRead || axes.apply != Apply::Texture) continue;
                const Plan plan =
                    planFrame(axes, shapeOf(int(frame.volumes().size()), size.width, size.height), profile);
                if (!missing(profile, plan).empty()) continue;
                const auto whole = drawn(surface, profile, plan, frame, false);
                scissors.clear();
                EXPECT_EQ(drawn(surface, profile, plan, frame, true), whole) << id << " " << describe(axes);
                for (const WindowRect& s : scissors) smaller += s.width * s.height < size.width * size.height;
            }
        }
    }
    EXPECT_GT(smaller, 0);
}

TEST(MaskRectangle, IsDrawnWholeWhereItsSamplesAreCounted) {
    const Profile ideal = chip("ideal");
    const Frame frame = frameOf(twoBoxes(), 64, 48);
    TestSurface surface(bufferFormatOf(ideal), 64, 48);
    const Plan plan =
        planFrame(findMethod("roettger-half")->axes, shapeOf(int(frame.volumes().size()), 64, 48), ideal);
    const Rendered counted =
        render(surface, ideal, plan, frame.surfaces, frame.lights(), {.countsSamples = true});
    EXPECT_EQ(counted.passSamples.back(), 64 * 48);
    EXPECT_EQ(render(surface, ideal, plan, frame.surfaces, frame.lights()).image.data, counted.image.data);
}

}  // namespace darkened_test
}  // namespace gnomon
