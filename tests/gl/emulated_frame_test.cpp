// What the chip emulation does beside blending: clears, read-backs, textures, depth, the alpha test, logic
// operations, the caller's own programs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <set>

#include "gl/emulation.h"
#include "gl/words.h"
#include "profile/depth.h"
#include "profile/frame_channel.h"
#include "test_surface.h"

namespace gnomon {
namespace emulated_frame_test {

using testing::Each;
using testing::ElementsAre;

constexpr int kSide = 8;

constexpr std::array<float, 8> kAll{-1, -1, 1, -1, 1, 1, -1, 1};

void fill(const GlTable& gl) {
    gl.EnableClientState(GL_VERTEX_ARRAY);
    gl.VertexPointer(2, GL_FLOAT, 0, kAll.data());
    gl.DrawArrays(GL_QUADS, 0, 4);
}

/// One pixel as glReadPixels gives it.
std::array<int, 4> pixel(const GlTable& gl, int x = 0, int y = 0) {
    std::array<std::uint8_t, 4> bytes{};
    gl.ReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    return {bytes[0], bytes[1], bytes[2], bytes[3]};
}

float grey(int value) {
    return float(value) / 255;
}

void colour(const GlTable& gl, int value) {
    gl.Color4f(grey(value), grey(value), grey(value), grey(value));
}

const ChipArithmetic kVoodoo{.fidelity = Fidelity::Chip,
                             .unit = BlendUnit::VoodooMame,
                             .dither = DitherMode::Matrix4x4,
                             .undithered = DitherMode::Off};
const BufferFormat k565{.red = 5, .green = 6, .blue = 5, .alpha = 0, .depth = 16, .stencil = 0};
const BufferFormat k5551{.red = 5, .green = 5, .blue = 5, .alpha = 1, .depth = 24, .stencil = 0};

TEST(EmulatedFrame, ClearsAndStoresByTruncation) {
    TestSurface surface(k565, kSide, kSide, kVoodoo);
    const GlTable& gl = surface.driver();
    gl.ClearColor(grey(0x47), grey(0x47), grey(0x47), 0);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    EXPECT_THAT(pixel(gl), ElementsAre(0x42, 0x45, 0x42, 255)) << "8 of 31, 17 of 63, replicated";
    colour(gl, 0xff);
    fill(gl);
    EXPECT_THAT(pixel(gl, 7, 7), ElementsAre(255, 255, 255, 255));
}

TEST(EmulatedFrame, ClearsOnlyTheChannelsThatAreWritten) {
    for (const BufferFormat& format : {k5551, BufferFormat{}}) {
        TestSurface surface(format, kSide, kSide, {.fidelity = Fidelity::Chip, .unit = BlendUnit::Nv2a});
        const GlTable& gl = surface.driver();
        gl.ClearColor(1, 1, 1, 1);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        gl.ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
        gl.ClearColor(0, 0, 0, 0);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        EXPECT_THAT(pixel(gl), ElementsAre(255, 0, 255, 255));
        gl.ColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_TRUE);
        colour(gl, 0);
        fill(gl);
        EXPECT_THAT(pixel(gl), ElementsAre(0, 0, 255, 0));
    }
}

// glClear takes no notice of the viewport, of tests, or of what is enabled; and leaves all that alone.
TEST(EmulatedFrame, ClearsAllOfItWhateverIsEnabled) {
    TestSurface surface(k565, kSide, kSide, kVoodoo);
    const GlTable& gl = surface.driver();
    gl.Viewport(0, 0, 2, 2);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_NEVER);
    gl.Enable(GL_CULL_FACE);
    gl.CullFace(GL_FRONT_AND_BACK);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ZERO, GL_ZERO);
    gl.ClearColor(1, 1, 1, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    EXPECT_THAT(pixel(gl, 7, 7), ElementsAre(255, 255, 255, 255));
    colour(gl, 0);
    fill(gl);
    EXPECT_THAT(pixel(gl), ElementsAre(255, 255, 255, 255)) << "the depth test is still on";
    gl.DepthFunc(GL_ALWAYS);
    fill(gl);
    EXPECT_THAT(pixel(gl), ElementsAre(255, 255, 255, 255)) << "culling is still on";
    gl.Disable(GL_CULL_FACE);
    fill(gl);
    EXPECT_THAT(pixel(gl), ElementsAre(0, 0, 0, 255)) << "so is blending";
    EXPECT_THAT(pixel(gl, 2, 2), ElementsAre(255, 255, 255, 255)) << "and the viewport is the small one";
}

TEST(EmulatedFrame, DithersWhereGlDitherIsEnabled) {
    TestSurface surface(k565, kSide, kSide, kVoodoo);
    const GlTable& gl = surface.driver();
    const auto values = [&] {
        std::set<int> reds;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) reds.insert(pixel(gl, x, y)[0]);
        return reds;
    };
    colour(gl, 0x44);
    fill(gl);
    EXPECT_EQ(values().size(), 1u);
    gl.Enable(GL_DITHER);
    fill(gl);
    EXPECT_EQ(values().size(), 2u);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    gl.ClearColor(grey(0x44), 0, 0, 0);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    EXPECT_EQ(values().size(), 2u) << "3dfx's fast fill dithers too";
    gl.Disable(GL_DITHER);
    fill(gl);
    EXPECT_EQ(values().size(), 1u);
}

// At fidelity gl, a format that OSMesa lacks stores the nearest code, as OpenGL does.
TEST(EmulatedFrame, RoundsInFormatsThatOsMesaLacks) {
    TestSurface surface(k5551, kSide, kSide);
    const GlTable& gl = surface.driver();
    for (int value = 0; value < 256; ++value) {
        colour(gl, value);
        fill(gl);
        const int nearest = replicated(rounded(value, 5), 5);
        EXPECT_THAT(pixel(gl), ElementsAre(nearest, nearest, nearest, value < 128 ? 0 : 255)) << value;
    }
}

TEST(EmulatedFrame, HasNoSumThatWrapsButItsOwn) {
    // No emulation of the chip's arithmetic, and a sum that no OpenGL has.
    for (const BufferFormat& format : {BufferFormat{}, k5551}) {
        TestSurface surface(format, kSide, kSide, {.fidelity = Fidelity::Chip});
        const GlTable& gl = surface.driver();
        colour(gl, 0xf8);
        fill(gl);
        gl.Enable(GL_BLEND);
        gl.BlendFunc(GL_ONE, GL_ONE);
        gl.BlendEquation(GL_FUNC_ADD_WRAP);
        colour(gl, 0x10);
        fill(gl);
        const int wrapped = format.red == 8 ? 8 : replicated(1, 5);
        EXPECT_EQ(pixel(gl)[0], wrapped);
        EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
        gl.BlendEquation(GL_FUNC_ADD);
        colour(gl, 0xff);
        fill(gl);
        EXPECT_EQ(pixel(gl)[0], 255);
    }
}

TEST(EmulatedFrame, InvertsByLogicOperation) {
    for (const BufferFormat& format : {BufferFormat{}, k5551}) {
        TestSurface surface(format, kSide, kSide, {.fidelity = Fidelity::Chip, .unit = BlendUnit::Flipper});
        const GlTable& gl = surface.driver();
        colour(gl, 0x40);
        fill(gl);
        gl.Enable(GL_BLEND);  // a logic operation takes its place
        gl.BlendFunc(GL_ONE, GL_ONE);
        gl.Enable(GL_COLOR_LOGIC_OP);
        gl.LogicOp(GL_INVERT);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_FALSE, GL_FALSE);
        fill(gl);
        const int inverse = format.red == 8 ? 0xbf : replicated(31 - 8, 5);
        const int kept = format.red == 8 ? 0x40 : replicated(8, 5);
        EXPECT_THAT(pixel(gl), ElementsAre(inverse, inverse, kept, format.red == 8 ? 0x40 : 0));
    }
}

TEST(EmulatedFrame, RefusesOtherLogicOperationsOnWords) {
    TestSurface surface(k5551, kSide, kSide, {.fidelity = Fidelity::Chip, .unit = BlendUnit::Flipper});
    const GlTable& gl = surface.driver();
    gl.Enable(GL_COLOR_LOGIC_OP);
    gl.LogicOp(GL_XOR);
    EXPECT_THROW(fill(gl), std::runtime_error);
    gl.LogicOp(GL_COPY);
    colour(gl, 0xff);
    fill(gl);
    EXPECT_EQ(pixel(gl)[0], 255);
}

TEST(EmulatedFrame, TestsAlphaBeforeItBlends) {
    TestSurface surface(k565, kSide, kSide, kVoodoo);
    const GlTable& gl = surface.driver();
    gl.Enable(GL_ALPHA_TEST);
    for (const auto& [function, passes] : {std::pair(GL_NEVER, 0),
                                           {GL_LESS, 1},
                                           {GL_EQUAL, 2},
                                           {GL_LEQUAL, 3},
                                           {GL_GREATER, 4},
                                           {GL_NOTEQUAL, 5},
                                           {GL_GEQUAL, 6},
                                           {GL_ALWAYS, 7}}) {
        gl.AlphaFunc(function, grey(100));
        for (const int alpha : {99, 100, 101}) {
            gl.ClearColor(0, 0, 0, 0);
            gl.Clear(GL_COLOR_BUFFER_BIT);
            colour(gl, alpha);
            fill(gl);
            const int bit = alpha < 100 ? 1 : alpha == 100 ? 2 : 4;
            EXPECT_EQ(pixel(gl)[0] != 0, (passes & bit) != 0) << enumName(function) << " " << alpha;
        }
    }
}

// A mask that becomes a texture: the copy sees what the chip holds, each base format its channels.
TEST(EmulatedFrame, CopiesWhatTheChipHoldsToTextures) {
    for (const BufferFormat& format : {BufferFormat{}, k5551}) {
        TestSurface surface(format, kSide, kSide, {.fidelity = Fidelity::Chip, .unit = BlendUnit::Nv2a});
        const GlTable& gl = surface.driver();
        for (const GLenum base : {GL_RGB, GL_INTENSITY, GL_ALPHA}) {
            gl.Color4f(grey(0x84), grey(0x42), grey(0x21), 1);
            fill(gl);
            GLuint texture = 0;
            gl.GenTextures(1, &texture);
            gl.BindTexture(GL_TEXTURE_2D, texture);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
            gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
            gl.CopyTexImage2D(GL_TEXTURE_2D, 0, base, 0, 0, kSide, kSide, 0);
            gl.ClearColor(0, 0, 0, 0);
            gl.Clear(GL_COLOR_BUFFER_BIT);
            gl.Enable(GL_BLEND);  // so that a program does it
            gl.BlendFunc(GL_ONE, GL_ZERO);
            gl.Color4f(grey(0x10), grey(0x20), grey(0x30), 0);
            gl.Enable(GL_TEXTURE_2D);
            fill(gl);
            gl.Disable(GL_TEXTURE_2D);
            gl.Disable(GL_BLEND);
            const std::array<int, 4> seen = pixel(gl);
            if (base == GL_RGB) {
                EXPECT_THAT(seen, ElementsAre(0x84, 0x42, 0x21, 0));
            }
            if (base == GL_INTENSITY) {
                EXPECT_THAT(seen, ElementsAre(0x84, 0x84, 0x84, format.red == 8 ? 0x84 : 255));
            }
            if (base == GL_ALPHA && format.red == 8) {
                EXPECT_THAT(seen, ElementsAre(0x10, 0x20, 0x30, 255));
            }
            gl.DeleteTextures(1, &texture);
        }
    }
}

/// Depth codes of one row of pixels, left to right, after points of (x, y, z, w) with @p beyond = (w - z)
/// / 2.
std::vector<std::uint32_t> depths(const BufferFormat& format, const ChipArithmetic& chip,
                                  const std::vector<glm::vec4>& points, int bits) {
    const int width = int(points.size());
    TestSurface surface(format, width, 1, chip);
    const GlTable& gl = surface.driver();
    gl.Viewport(0, 0, width, 1);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_ALWAYS);
    gl.EnableClientState(GL_VERTEX_ARRAY);
    std::vector<glm::vec4> placed = points;
    for (int i = 0; i < width; ++i) {
        placed[std::size_t(i)].x = placed[std::size_t(i)].w * float((2 * i + 1) / double(width) - 1);
        placed[std::size_t(i)].y = 0;
    }
    gl.VertexPointer(4, GL_FLOAT, 0, placed.data());
    gl.DrawArrays(GL_POINTS, 0, width);
    std::vector<float> read(points.size());
    gl.ReadPixels(0, 0, width, 1, GL_DEPTH_COMPONENT, GL_FLOAT, read.data());
    std::vector<std::uint32_t> codes;
    for (const float depth : read)
        codes.push_back(std::uint32_t(std::lround(double(depth) * double((1u << bits) - 1))));
    return codes;
}

TEST(EmulatedDepth, StoresTheVoodoosW) {
    std::vector<glm::vec4> points;
    std::vector<std::uint32_t> expected;
    for (int exponent = 0; exponent < 16; ++exponent)
        for (int step = 0; step < 40; ++step) {
            // near / w in multiples of 2^-24, which floats of z = w - 2 near hold.
            const std::uint64_t inverse =
                ((std::uint64_t{1} << (23 - exponent)) +
                 std::uint64_t(step) * ((std::uint64_t{1} << (23 - exponent)) / 64));
            points.push_back({0, 0, 1 - 2 * std::ldexp(float(inverse), -24), 1});
            expected.push_back(voodooW(inverse << 24));
        }
    EXPECT_EQ(depths(k565, {.fidelity = Fidelity::Chip, .depth = DepthEncoding::VoodooW}, points, 16),
              expected);
}

TEST(EmulatedDepth, StoresTheN64s) {
    std::vector<glm::vec4> points;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t z = 0; z < 0x40000; z += 149) {
        points.push_back({0, 0, std::ldexp(float(z), -17) - 1, 1});
        expected.push_back(n64Depth(z));
    }
    EXPECT_EQ(depths(k5551, {.fidelity = Fidelity::Chip, .depth = DepthEncoding::N64}, points, 14), expected);
}

TEST(EmulatedDepth, StoresSixteenBitsBesideAStencil) {
    const BufferFormat format{.depth = 16, .stencil = 8};
    std::vector<glm::vec4> points;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t z = 1; z < 1u << 20; z += 1021) {
        points.push_back({0, 0, std::ldexp(float(z), -19) - 1, 1});
        expected.push_back(linearDepth(std::uint64_t{z} << 12, 16));
    }
    EXPECT_EQ(depths(format, {}, points, 16), expected);
}

TEST(EmulatedFrame, CountsInAStencilBesideSixteenBitsOfDepth) {
    TestSurface surface({.depth = 16, .stencil = 8}, kSide, kSide);
    const GlTable& gl = surface.driver();
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    gl.Enable(GL_DEPTH_TEST);
    gl.Enable(GL_STENCIL_TEST);
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.DepthMask(GL_FALSE);
    gl.StencilFunc(GL_ALWAYS, 0, ~0u);
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    for (int i = 0; i < 3; ++i) fill(gl);
    std::uint8_t count = 0;
    gl.ReadPixels(3, 3, 1, 1, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, &count);
    EXPECT_EQ(count, 3);
}

TEST(EmulatedFrame, RefusesWhatABlendUnitHasNot) {
    TestSurface surface(BufferFormat{}, kSide, kSide, {.fidelity = Fidelity::Chip, .unit = BlendUnit::Virge});
    const GlTable& gl = surface.driver();
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    EXPECT_THROW(fill(gl), std::runtime_error);
}

// What OpenGL itself does right stays OpenGL's: no program is made for it.
TEST(EmulatedFrame, LeavesOpaqueDrawsOf8888Alone) {
    TestSurface surface(BufferFormat{}, kSide, kSide,
                        {.fidelity = Fidelity::Chip, .unit = BlendUnit::PowerVr});
    GlTable counting = surface.driver();
    const GlTable& gl = surface.driver();
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.Enable(GL_DEPTH_TEST);
    colour(gl, 77);
    fill(gl);
    EXPECT_THAT(pixel(gl), ElementsAre(77, 77, 77, 77));
    // The next program that OpenGL would name is the first.
    const GLuint first = gl.CreateProgram();
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_DST_COLOR, GL_ONE);
    fill(gl);
    const GLuint next = gl.CreateProgram();
    EXPECT_GT(next, first + 1) << "blending needs one";
    gl.Disable(GL_BLEND);
    fill(gl);
    EXPECT_EQ(gl.CreateProgram(), next + 1) << "an opaque draw needs none";
}

}  // namespace emulated_frame_test
}  // namespace gnomon
