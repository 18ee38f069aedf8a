// Masks at fidelity chip, pixel by pixel, against the passes done over again with the integer functions of
// profile/: the faces that each pass draws in a pixel are counted by another surface, without any blending
// that could round.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gl/pixel_words.h"
#include "gl/renderer.h"
#include "gl/words.h"
#include "profile/frame_channel.h"
#include "scene/scene_file.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {
namespace chip_mask_test {

constexpr int kWidth = 160, kHeight = 120;

/// Faces of a pass that pass its depth test, per pixel, rows from the top.
class FaceCounter {
  public:
    FaceCounter(const BufferFormat& like, const ChipArithmetic& chip, const Frame& frame)
        : m_surface({.depth = like.depth, .stencil = 0}, kWidth, kHeight, {.depth = chip.depth}),
          m_frame(frame) {
        const GlTable& gl = m_surface.driver();
        gl.Viewport(0, 0, kWidth, kHeight);
        gl.Clear(GL_DEPTH_BUFFER_BIT);
        gl.Enable(GL_DEPTH_TEST);
        gl.EnableClientState(GL_VERTEX_ARRAY);
        gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        draw(m_frame.surfaces.positions);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        gl.DepthMask(GL_FALSE);
        gl.Enable(GL_BLEND);
        gl.BlendFunc(GL_ONE, GL_ONE);
        gl.Color4f(1 / 255.0f, 0, 0, 0);
    }

    std::vector<int> count(const Pass& pass) {
        m_surface.makeCurrent();
        const GlTable& gl = m_surface.driver();
        gl.ClearColor(0, 0, 0, 0);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        pass.faces == Faces::Both ? gl.Disable(GL_CULL_FACE) : gl.Enable(GL_CULL_FACE);
        gl.CullFace(pass.faces == Faces::Front ? GL_BACK : GL_FRONT);
        gl.DepthFunc(glEnum(pass.depthFunction));
        for (int part = 0; part < kParts; ++part) {
            if (!pass.parts.has(Part(part))) continue;
            const FrameVolumes& volumes = m_frame.volumes();
            draw(pass.volume == kAllVolumes ? volumes.all(Part(part))
                                            : volumes.of(Part(part), std::size_t(pass.volume)));
        }
        const Image image = readColour(m_surface);
        std::vector<int> counts;
        for (std::size_t i = 0; i < image.data.size(); i += 3) counts.push_back(image.data[i]);
        return counts;
    }

  private:
    void draw(std::span<const glm::vec4> triangles) {
        m_surface.driver().VertexPointer(4, GL_FLOAT, 0, triangles.data());
        m_surface.driver().DrawArrays(GL_TRIANGLES, 0, GLsizei(triangles.size()));
    }

    TestSurface m_surface;
    const Frame& m_frame;
};

struct Case {
    const char* profile = "";
    const char* method = "";
    const char* scene = "";
    bool dithers = false;
};

class EachMask : public testing::TestWithParam<Case> {};

/// What one fragment of @p pass makes of a code of channel @p c.
int drawn(const Pass& pass, const FrameChannel& channel, int code) {
    using enum BlendFactor;
    const Blend& b = pass.blend;
    const int grey = int((pass.write.alpha ? pass.colour.a : pass.colour.r) * 255 + 0.5f);
    const auto is = [&](BlendFactor source, BlendFactor destination) {
        return b.equation == BlendEquation::Add && b.source == source && b.destination == destination;
    };
    if (is(DstColor, One)) return *apply(channel, MaskOperation::Double, code);
    if (is(DstColor, Zero)) return *apply(channel, MaskOperation::Halve, code, grey);
    if (is(OneMinusDstColor, Zero)) return *apply(channel, MaskOperation::Invert, code);
    if (b.source == One && b.destination == One && b.equation != BlendEquation::Max) {
        const auto sum = blendUnclamped(channel.unit, {.source = enteringSource(channel, grey),
                                                       .destination = readBack(channel, code),
                                                       .operation = operationOf(b.equation)});
        return stored(channel, *sum, b.equation == BlendEquation::AddWrap);
    }
    EXPECT_EQ(b.equation, BlendEquation::Max);
    return stored(channel, std::max(enteringSource(channel, grey), readBack(channel, code)));
}

TEST_P(EachMask, IsWhatTheIntegerFunctionsSayInEveryPixel) {
    const Case& c = GetParam();
    const Profile profile = chip(c.profile);
    const FidelityChoice choice{.fidelity = Fidelity::Chip, .dithers = c.dithers};
    const ChipArithmetic chip = arithmeticOf(profile, choice);
    const BufferFormat format = bufferFormatOf(profile);
    const Scene scene =
        loadSceneFile(std::filesystem::path(GNOMON_SOURCE) / "scenes" / (std::string(c.scene) + ".toml"));
    const Frame frame = frameOf(scene, kWidth, kHeight);
    const Axes axes = findMethod(c.method)->axes;
    const Plan plan = planFrame(axes, shapeOf(int(frame.volumes().size()), kWidth, kHeight), profile);
    ASSERT_TRUE(missing(profile, plan).empty());
    TestSurface surface(format, kWidth, kHeight, chip);
    FaceCounter faces(format, chip, frame);
    const bool inAlpha = axes.store == Store::Alpha;
    const std::vector<int> channels = inAlpha ? std::vector<int>{3} : std::vector<int>{0, 1, 2};

    std::vector<std::vector<int>> codes(4);
    std::size_t compared = 0, moved = 0;
    bool finished = false;
    const auto channelAt = [&](int channel, std::size_t i) {
        const int x = int(i) % kWidth, y = int(i) / kWidth;
        return FrameChannel{chip.unit, channelBits(format, channel),
                            channel == 3 ? DitherMode::Off : chip.undithered,
                            ditherCell(chip.undithered, x, y)};
    };
    const std::size_t last = plan.masks.empty() ? 0 : plan.masks.front().after;
    const auto follow = [&](std::size_t index) {
        const Pass& pass = plan.passes[index];
        finished = finished || index >= last || pass.kind == PassKind::Copy;
        if (finished) return;
        const bool writes = inAlpha ? pass.write.alpha : pass.write.red;
        if (!writes || pass.kind == PassKind::Scene) return;  // a scene before the mask is in other channels
        const std::vector<int> counts = pass.kind == PassKind::Volume
                                            ? faces.count(pass)
                                            : std::vector<int>(std::size_t(kWidth) * kHeight, 1);
        surface.makeCurrent();
        for (const int channel : channels) {
            std::vector<int>& expected = codes[std::size_t(channel)];
            expected.resize(counts.size());
            for (std::size_t i = 0; i < counts.size(); ++i) {
                const FrameChannel at = channelAt(channel, i);
                if (pass.kind == PassKind::Clear)
                    expected[i] = stored(at, enteringSource(at, int(pass.colour.a * 255 + 0.5f)));
                else
                    for (int n = 0; n < counts[i]; ++n) expected[i] = drawn(pass, at, expected[i]);
                moved += counts[i] != 0;
            }
        }
        const Image image = readColour(surface, true);
        int wrong = 0;
        for (const int channel : channels) {
            const int bits = channelBits(format, channel);
            for (std::size_t i = 0; i < counts.size(); ++i) {
                const int code = image.data[4 * i + std::size_t(channel)] >> (8 - bits);
                wrong += code != codes[std::size_t(channel)][i];
                ++compared;
            }
        }
        EXPECT_EQ(wrong, 0) << index << ": " << pass.label;
    };
    render(surface, profile, plan, frame.surfaces, frame.lights(), {.afterPass = follow});
    // Each pass that the mask is made of, and at least a start, fronts and backs.
    const auto end = std::find_if(plan.passes.begin(), plan.passes.begin() + std::ptrdiff_t(last),
                                  [](const Pass& pass) { return pass.kind == PassKind::Copy; });
    const auto makes = std::count_if(plan.passes.begin(), end, [&](const Pass& pass) {
        return pass.kind != PassKind::Scene && (inAlpha ? pass.write.alpha : pass.write.red);
    });
    EXPECT_GE(makes, 3);
    EXPECT_EQ(compared, std::size_t(makes) * channels.size() * std::size_t(kWidth) * kHeight);
    EXPECT_GT(moved, 1000u);
}

INSTANTIATE_TEST_SUITE_P(
    Chips, EachMask,
    testing::Values(
        Case{"voodoo1", "roettger-screen", "boxes"}, Case{"voodoo1", "roettger-screen", "boxes", true},
        Case{"voodoo2", "screen-zfail", "roettger"}, Case{"voodoo3", "roettger-screen", "knot"},
        Case{"voodoo3", "roettger-screen", "knot", true}, Case{"ps2", "screen-texture", "boxes"},
        Case{"ps2", "screen-texture", "knot"}, Case{"tnt", "roettger-alpha", "boxes"},
        Case{"tnt", "roettger-screen", "knot"}, Case{"geforce2mx", "roettger-alpha-max", "boxes"},
        Case{"geforce2mx", "alpha-zfail", "knot"}, Case{"ideal", "roettger-screen-max", "roettger"},
        Case{"dreamcast", "roettger-alpha", "knot"}, Case{"gamecube", "roettger-alpha", "boxes"},
        Case{"gamecube", "alpha-count", "knot"}, Case{"gamecube-888", "screen-zfail", "boxes"},
        Case{"psp", "roettger-screen", "knot"}, Case{"psp-4444", "roettger-screen-max", "boxes"},
        Case{"psp-5551", "screen-count", "boxes"}, Case{"ps2-5551", "screen-count", "knot"},
        Case{"ps2", "screen-count", "boxes"}, Case{"xbox", "alpha-count", "boxes"},
        Case{"xbox-565", "roettger-screen", "knot"}, Case{"vsa100-16", "roettger-screen", "boxes"},
        Case{"banshee", "screen-zfail", "knot"}, Case{"i740", "roettger-screen", "boxes"}),
    [](const auto& test) {
        std::string text = fmt::format("{}_{}_{}{}", test.param.profile, test.param.method, test.param.scene,
                                       test.param.dithers ? "_dithered" : "");
        for (char& letter : text) letter = letter == '-' ? '_' : letter;
        return text;
    });

}  // namespace chip_mask_test
}  // namespace gnomon
