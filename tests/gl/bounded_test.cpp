// Passes under a scissor: what they change, and that all else of the frame is kept, in OpenGL's arithmetic
// and in the chips'.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "gl/darkened.h"
#include "gl/renderer.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {
namespace bounded_test {

constexpr int kWidth = 64, kHeight = 48;

/// All that a frame holds and cost.
struct Buffers {
    Image colour{}, stencil{};  ///< no stencil: empty
    CallCounts counts{};
    std::vector<std::uint16_t> mask{};
};

/// The pixels of @p a in @p part, from the lower left corner, those of @p b elsewhere.
Image composed(const Image& a, const Image& b, const WindowRect& part) {
    Image all = b;
    for (int y = 0; y < b.height; ++y) {
        for (int x = 0; x < b.width; ++x) {
            if (!part.holds(x, b.height - 1 - y)) continue;
            const std::size_t at = (std::size_t(y) * b.width + x) * b.channels;
            std::copy_n(a.data.begin() + std::ptrdiff_t(at), b.channels,
                        all.data.begin() + std::ptrdiff_t(at));
        }
    }
    return all;
}

/// A frame of two boxes, with passes by hand.
class Studio {
  public:
    Studio(const std::string& chipId, Fidelity fidelity)
        : m_profile(chip(chipId)),
          m_surface(bufferFormatOf(m_profile), kWidth, kHeight, arithmeticOf(m_profile, {fidelity})),
          m_frame(frameOf(twoBoxes(), kWidth, kHeight)) {}

    Plan planOf(std::vector<Pass> passes, const MaskWindow& window = {}) const {
        Plan plan{.passes = std::move(passes)};
        plan.width = plan.maskWidth = kWidth, plan.height = plan.maskHeight = kHeight;
        plan.windows = {window};
        return plan;
    }

    Buffers draw(const Plan& plan) {
        Rendered rendered = render(m_surface, m_profile, plan, m_frame.surfaces, m_frame.lights());
        const bool hasStencil = m_surface.format().stencil > 0;
        return {readColour(m_surface, m_surface.format().alpha > 0),
                hasStencil ? readStencil(m_surface) : Image{}, rendered.counts,
                std::move(rendered.values.front())};
    }
    Buffers draw(std::vector<Pass> passes, const MaskWindow& window = {}) {
        return draw(planOf(std::move(passes), window));
    }

    Surface& surface() { return m_surface; }
    const Profile& profile() const { return m_profile; }
    int volumes() const { return int(m_frame.volumes().size()); }

  private:
    Profile m_profile;
    TestSurface m_surface;
    Frame m_frame;
};

Pass clearTo(float value) {
    return {.kind = PassKind::Clear, .label = "clear", .colour = glm::vec4(value), .clearsDepth = true};
}

Pass fillDepth() {
    Pass pass{.kind = PassKind::Scene, .label = "depth", .depthTest = true, .depthWrite = true};
    pass.write = kWriteNothing;
    return pass;
}

/// Adds an eighth.
const Blend kAdd{.enabled = true, .source = BlendFactor::One, .destination = BlendFactor::One};

Pass rectangle() {
    return {.kind = PassKind::Rectangle, .label = "rectangle", .colour = glm::vec4(0.125f), .blend = kAdd};
}

/// Front faces that pass the depth test, of one volume or of all.
Pass fronts(int volume = kAllVolumes) {
    Pass pass{.kind = PassKind::Volume, .label = "fronts", .parts = kAllParts, .volume = volume};
    pass.faces = Faces::Front;
    pass.colour = glm::vec4(0.125f);
    pass.depthTest = true;
    pass.blend = kAdd;
    return pass;
}

Pass bounded(Pass pass, Extent extent) {
    pass.extent = extent;
    return pass;
}

bool differsIn(const Image& a, const Image& b, const WindowRect& part) {
    return composed(a, b, part).data != b.data;
}

/// Formats that OSMesa has and those that are emulated: bytes, words of 16 bits, and a PlayStation 2's.
struct Chip {
    const char* id;
    Fidelity fidelity;
};
void PrintTo(const Chip& c, std::ostream* out) {
    *out << c.id << "/" << name(c.fidelity);
}

class BoundedPasses : public testing::TestWithParam<Chip> {
  protected:
    /// Draws @p pass after @p before: whole, left out, and bounded to @p part; the last must be the first
    /// within and the second outside.
    void expectBounded(const std::vector<Pass>& before, const Pass& pass, const WindowRect& part) {
        Pass whole = pass;
        whole.extent = Extent::Whole;
        std::vector<Pass> with = before, within = before;
        with.push_back(whole), within.push_back(pass);
        const Buffers kept = studio.draw(before), full = studio.draw(with),
                      got = studio.draw(within, {part, {part, part}});
        EXPECT_EQ(got.colour.data, composed(full.colour, kept.colour, part).data);
        if (!got.stencil.data.empty()) {
            EXPECT_EQ(got.stencil.data, composed(full.stencil, kept.stencil, part).data);
        }
        EXPECT_EQ(got.counts.passes, full.counts.passes);
        ASSERT_TRUE(differsIn(full.colour, kept.colour, part)) << "else nothing is shown";
        ASSERT_NE(full.colour.data, composed(full.colour, kept.colour, part).data);
    }

    Studio studio{GetParam().id, GetParam().fidelity};
};
INSTANTIATE_TEST_SUITE_P(Chips, BoundedPasses,
                         testing::Values(Chip{"ideal", Fidelity::Gl}, Chip{"ideal", Fidelity::Chip},
                                         Chip{"voodoo2", Fidelity::Gl}, Chip{"voodoo2", Fidelity::Chip},
                                         Chip{"tnt", Fidelity::Chip}, Chip{"ps2", Fidelity::Gl},
                                         Chip{"ps2", Fidelity::Chip}),
                         [](const auto& test) {
                             return std::string(test.param.id) + "_" + name(test.param.fidelity);
                         });

const WindowRect kPart{21, 9, 24, 16};

TEST_P(BoundedPasses, ClearTheirPartOfTheWindow) {
    expectBounded({clearTo(0.25f)}, bounded(clearTo(0.75f), Extent::Shadows), kPart);
}

TEST_P(BoundedPasses, FillTheirPartOfTheWindow) {
    expectBounded({clearTo(0.25f)}, bounded(rectangle(), Extent::Shadows), kPart);
}

TEST_P(BoundedPasses, FillThePartOfTheVolumeThatTheyAreOf) {
    Pass pass = bounded(rectangle(), Extent::Volumes);
    pass.volume = 1;
    const MaskWindow window{around(kPart, {0, 0, 9, 9}), {{0, 0, 9, 9}, kPart}};
    Pass whole = bounded(pass, Extent::Shadows);
    EXPECT_EQ(studio.draw({clearTo(0.25f), pass}, window).colour.data,
              studio.draw({clearTo(0.25f), whole}, {kPart, {}}).colour.data);
}

TEST_P(BoundedPasses, DrawOneVolumeInItsRectangle) {
    for (const int volume : {0, 1})
        expectBounded({clearTo(0.25f), fillDepth()}, bounded(fronts(volume), Extent::Volumes), kPart);
}

TEST_P(BoundedPasses, DrawAllVolumesInOneRectangle) {
    for (const Extent extent : {Extent::Shadows, Extent::Volumes})
        expectBounded({clearTo(0.25f), fillDepth()}, bounded(fronts(), extent), kPart);
}

// All at once they must do what one after the other does, and count as one pass.
TEST_P(BoundedPasses, DrawAllVolumesEachInItsOwnRectangle) {
    ASSERT_EQ(studio.volumes(), 2);
    const WindowRect left{0, 0, 32, 48}, right{27, 5, 30, 30};
    const MaskWindow window{around(left, right), {left, right}};
    const std::vector<Pass> before{clearTo(0.25f), fillDepth()};
    std::vector<Pass> inTurn = before, atOnce = before;
    for (const int volume : {0, 1}) inTurn.push_back(bounded(fronts(volume), Extent::Volumes));
    atOnce.push_back(bounded(fronts(), Extent::Volumes));
    const Buffers got = studio.draw(atOnce, window);
    EXPECT_EQ(got.colour.data, studio.draw(inTurn, window).colour.data);
    EXPECT_EQ(got.counts.passes, (PassCounts{.scene = 1, .volume = 1}));
    atOnce.back().extent = Extent::Shadows;
    EXPECT_NE(got.colour.data, studio.draw(atOnce, window).colour.data) << "each has but its own";
}

TEST_P(BoundedPasses, DrawNothingOfAVolumeWithoutRectangle) {
    const std::vector<Pass> before{clearTo(0.25f), fillDepth()};
    std::vector<Pass> one = before, all = before;
    one.push_back(bounded(fronts(1), Extent::Volumes)), all.push_back(bounded(fronts(), Extent::Volumes));
    const MaskWindow window{kPart, {{}, kPart}};
    EXPECT_EQ(studio.draw(all, window).colour.data, studio.draw(one, window).colour.data);
}

TEST_P(BoundedPasses, AreMadeWhereNothingIsLeft) {
    const std::vector<Pass> before{clearTo(0.25f), fillDepth()};
    const Buffers kept = studio.draw(before);
    for (const Pass& pass : {bounded(fronts(), Extent::Volumes), bounded(fronts(1), Extent::Volumes),
                             bounded(fronts(), Extent::Shadows), bounded(rectangle(), Extent::Shadows),
                             bounded(clearTo(1), Extent::Shadows)}) {
        std::vector<Pass> passes = before;
        passes.push_back(pass);
        const Buffers got = studio.draw(passes, {{}, {{}, {40, 20, 0, 8}}});
        EXPECT_EQ(got.colour.data, kept.colour.data);
        EXPECT_EQ(got.counts.passes, countPasses(studio.planOf(passes)));
    }
}

TEST_P(BoundedPasses, LeaveTheNextPassWhole) {
    const Pass part = bounded(rectangle(), Extent::Shadows);
    const Buffers once = studio.draw({clearTo(0), rectangle()}),
                  twice = studio.draw({clearTo(0), rectangle(), rectangle()});
    EXPECT_EQ(studio.draw({clearTo(0), part, rectangle()}, {kPart, {}}).colour.data,
              composed(twice.colour, once.colour, kPart).data);
    EXPECT_EQ(studio.draw({part, clearTo(0)}, {kPart, {}}).colour.data,
              studio.draw({clearTo(0)}).colour.data);
}

// The scissor of one frame is not the next one's.
TEST_P(BoundedPasses, LeaveTheNextFrameWhole) {
    const Buffers whole = studio.draw({clearTo(0.25f)});
    studio.draw({clearTo(0), bounded(rectangle(), Extent::Shadows)}, {kPart, {}});
    EXPECT_EQ(studio.draw({clearTo(0.25f)}).colour.data, whole.colour.data);
}

// ---- Copies ----

Plan maskThroughATexture(const Studio& studio) {
    const int volumes = studio.volumes();
    return planFrame(findMethod("screen-texture")->axes, shapeOf(volumes, kWidth, kHeight), studio.profile());
}

TEST(BoundedCopies, TakeTheWholeFrame) {
    for (const auto& [id, fidelity] : {std::pair("ideal", Fidelity::Gl), std::pair("ps2", Fidelity::Chip)}) {
        Studio studio(id, fidelity);
        Plan plan = maskThroughATexture(studio);
        const Buffers whole = studio.draw(plan);
        plan.windows = {{kPart, {kPart, kPart}}};
        for (Pass& pass : plan.passes)
            if (pass.kind == PassKind::Copy) pass.extent = Extent::Shadows;
        const Buffers got = studio.draw(plan);
        EXPECT_EQ(got.colour.data, whole.colour.data) << id;
        EXPECT_EQ(got.mask, whole.mask) << id;
        EXPECT_EQ(got.counts.passes, whole.counts.passes) << id;
    }
}

// A mask's texture is read by drawing it over all of the window, between two passes that are bounded.
TEST(BoundedCopies, AreReadWholeAndLeaveTheNextPassBounded) {
    Studio studio("ideal", Fidelity::Gl);
    Plan plan = maskThroughATexture(studio);
    const std::vector<std::uint16_t> mask = studio.draw(plan).mask;
    plan.windows = {{kPart, {kPart, kPart}}};
    for (int i = 0; i < 2; ++i) plan.passes.push_back(bounded(rectangle(), Extent::Shadows));
    MaskTap tap = plan.masks.front();
    plan.masks.clear();
    const Buffers unread = studio.draw(plan);
    tap.after = plan.passes.size() - 1;
    plan.masks = {tap};
    const Buffers read = studio.draw(plan);
    EXPECT_EQ(read.mask, mask);
    EXPECT_EQ(read.colour.data, unread.colour.data);
}

// In OpenGL the scissor test bounds draws and clears; reads and copies take no notice of it.
TEST(Scissor, BoundsNeitherReadsNorCopiesOfAnEmulatedFrame) {
    for (const char* id : {"ideal", "voodoo2", "ps2"}) {
        Studio studio(id, Fidelity::Chip);
        studio.draw({clearTo(0.25f), fillDepth(), fronts()});
        const Image frame = readColour(studio.surface());
        const GlTable& gl = studio.surface().driver();
        gl.Enable(GL_SCISSOR_TEST);
        gl.Scissor(3, 5, 7, 2);
        EXPECT_EQ(readColour(studio.surface()).data, frame.data) << id;

        GLuint texture = 0;
        gl.GenTextures(1, &texture);
        gl.BindTexture(GL_TEXTURE_2D, texture);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
        gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, kWidth, kHeight, 0);
        gl.Disable(GL_SCISSOR_TEST);
        gl.ClearColor(1, 0, 1, 1);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        static constexpr std::array<float, 8> kAll{-1, -1, 1, -1, 1, 1, -1, 1},
            kTexels{0, 0, 1, 0, 1, 1, 0, 1};
        gl.Enable(GL_TEXTURE_2D);
        gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
        gl.TexCoordPointer(2, GL_FLOAT, 0, kTexels.data());
        gl.VertexPointer(2, GL_FLOAT, 0, kAll.data());
        gl.Disable(GL_DEPTH_TEST), gl.Disable(GL_BLEND), gl.Disable(GL_CULL_FACE);
        gl.DrawArrays(GL_QUADS, 0, 4);
        EXPECT_EQ(readColour(studio.surface()).data, frame.data) << id;
        gl.DeleteTextures(1, &texture);
    }
}

// ---- Calls ----

// But for the rectangle that multiplies by a mask's texture (darkened.h), where the processor draws.
TEST(Scissor, IsNotTouchedByPlansThatAreWhole) {
    for (const NamedMethod& method : namedMethods()) {
        Studio studio("ideal", Fidelity::Gl);
        const auto touched = std::make_shared<int>(0);
        studio.surface().decorate([&](GlTable next) {
            GlTable gl = next;
            gl.Enable = [=](GLenum what) {
                *touched += what == GL_SCISSOR_TEST;
                next.Enable(what);
            };
            gl.Scissor = [=](GLint x, GLint y, GLsizei width, GLsizei height) {
                ++*touched;
                next.Scissor(x, y, width, height);
            };
            return gl;
        });
        const Axes& axes = method.axes;
        if (axes.store == Store::None) continue;
        const Plan plan = planFrame(axes, shapeOf(studio.volumes(), kWidth, kHeight), studio.profile());
        if (!missing(studio.profile(), plan).empty()) continue;
        studio.draw(plan);
        const bool multiplies = studio.surface().isSoftware() &&
                                std::any_of(plan.passes.begin(), plan.passes.end(), multipliesByMask);
        EXPECT_EQ(*touched, multiplies ? 2 : 0) << method.id;
        *touched = 0;
        studio.draw({clearTo(0), bounded(rectangle(), Extent::Shadows)}, {kPart, {}});
        EXPECT_EQ(*touched, 2) << "one that is bounded";
    }
}

// Neighbours share a draw where they share a rectangle.
TEST(Scissor, MovesOnceForEachRunOfEqualRectangles) {
    Studio studio("ideal", Fidelity::Gl);
    Pass pass = bounded(fronts(), Extent::Volumes);
    pass.parts = Part::Sides | Parts(Part::LightCap);
    const auto draws = [&](const WindowRect& first, const WindowRect& second) {
        return studio.draw({pass}, {around(first, second), {first, second}}).counts.draws;
    };
    EXPECT_EQ(draws(kPart, kPart), 2) << "one for each part";
    EXPECT_EQ(draws(kPart, {1, 1, 9, 9}), 4);
    EXPECT_EQ(draws(kPart, {}), 2);
    EXPECT_EQ(draws({}, {}), 1) << "an empty list, so that the pass is made";
}

// ---- Masks ----

TEST(MaskOutside, StandsForPixelsOfWhichNoMaskIsDrawn) {
    Studio studio("ideal", Fidelity::Gl);
    Plan plan = studio.planOf({clearTo(0.25f), fillDepth(), fronts()}, {kPart, {kPart, kPart}});
    plan.masks = {{.after = 3, .place = MaskPlace::Colour}};
    const std::vector<std::uint16_t> all = studio.draw(plan).mask;
    plan.masks.front().outside = 255;
    const std::vector<std::uint16_t> got = studio.draw(plan).mask;
    ASSERT_EQ(std::count(all.begin(), all.end(), 255), 0);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const auto p = std::size_t(y * kWidth + x);
            ASSERT_EQ(got[p], kPart.holds(x, kHeight - 1 - y) ? all[p] : 255) << x << "," << y;
        }
    }
}

}  // namespace bounded_test
}  // namespace gnomon
