// Refusals of the capability layer, each spelled out: which chip refuses which call, and in what words.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_driver.h"
#include "gl/capability.h"
#include "gl/words.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {
namespace capability_refusals_test {

using testing::Contains;
using testing::Not;

/// Spelled out, with no rule between chip and expectation.
struct Refusal {
    std::string chip{}, name{};
    Calls calls{};
    std::string call{}, argument{}, capability{};
};
void PrintTo(const Refusal& r, std::ostream* out) {
    *out << r.chip << " " << r.name;
}

class EachKnownRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(EachKnownRefusal, NamesCallArgumentCapabilityAndSource) {
    const Profile profile = chip(GetParam().chip);
    const FakeDriver driver;
    const GlTable gl = restrictTo(profile, bufferFormatOf(profile), driver.table());
    const auto violation = violationOf([&] { GetParam().calls(gl); });
    ASSERT_TRUE(violation);
    EXPECT_EQ(violation->call, GetParam().call);
    EXPECT_EQ(violation->argument, GetParam().argument);
    EXPECT_EQ(violation->capability, GetParam().capability);
    EXPECT_EQ(violation->source, profile.sourceOf(GetParam().capability));
    EXPECT_THAT(driver.calls(), Not(Contains(GetParam().call)));
}

void blendedDraw(const GlTable& gl, GLenum source, GLenum destination) {
    gl.Enable(GL_BLEND);
    gl.BlendFunc(source, destination);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

INSTANTIATE_TEST_SUITE_P(
    Chips, EachKnownRefusal,
    testing::Values(
        Refusal{"voodoo1", "Stencil", [](auto& gl) { gl.Enable(GL_STENCIL_TEST); }, "glEnable",
                "GL_STENCIL_TEST", "stencil_bits"},
        Refusal{"voodoo2", "AlphaBesideDepth",
                [](auto& gl) {
                    gl.ColorMask(0, 0, 0, 1);
                    gl.DrawArrays(GL_TRIANGLES, 0, 3);
                },
                "glDrawArrays", "writing alpha", "alpha_excludes_depth"},
        Refusal{"voodoo3", "RedAlone", [](auto& gl) { gl.ColorMask(1, 0, 0, 0); }, "glColorMask",
                "1, 0, 0, 0", "write_mask"},
        Refusal{"voodoo1", "SourceColourAsSourceFactor",
                [](auto& gl) { gl.BlendFunc(GL_SRC_COLOR, GL_ZERO); }, "glBlendFunc", "GL_SRC_COLOR, GL_ZERO",
                "source_factors"},
        Refusal{"voodoo2", "Maximum", [](auto& gl) { gl.BlendEquation(GL_MAX); }, "glBlendEquation", "GL_MAX",
                "blend_equations"},
        Refusal{"voodoo1", "TextureOf512",
                [](auto& gl) { gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 512, 512, 0); },
                "glCopyTexImage2D", "512x512", "max_texture_size"},
        Refusal{"voodoo1", "FrameOf800x600", [](auto& gl) { gl.Viewport(0, 0, 800, 600); }, "glViewport",
                "800x600", "max_width"},
        Refusal{"voodoo1", "FrameOf640x481", [](auto& gl) { gl.Viewport(0, 0, 640, 481); }, "glViewport",
                "640x481", "max_height"},
        Refusal{"ps2", "SceneOverMask",
                [](auto& gl) {
                    gl.EnableClientState(GL_COLOR_ARRAY);
                    blendedDraw(gl, GL_DST_COLOR, GL_ZERO);
                },
                "glDrawArrays", "blending GL_DST_COLOR, GL_ZERO with a varying source colour", "blend_pairs"},
        Refusal{"ps2", "BlendedAlpha",
                [](auto& gl) {
                    gl.ColorMask(0, 0, 0, 1);
                    blendedDraw(gl, GL_ONE, GL_ONE);
                },
                "glDrawArrays", "blending alpha", "blend_writes_alpha"},
        Refusal{"ps2", "FartherDepthTest", [](auto& gl) { gl.DepthFunc(GL_GREATER); }, "glDepthFunc",
                "GL_GREATER", "depth_functions"},
        Refusal{"ps2", "FrameOf1024x768", [](auto& gl) { gl.Viewport(0, 0, 1024, 768); }, "glViewport",
                "1024x768", "frame_bytes"},
        Refusal{"tnt", "TwoSidedStencil",
                [](auto& gl) { gl.StencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_INCR); },
                "glStencilOpSeparate", "GL_FRONT", "two_sided_stencil"},
        Refusal{"tnt", "Maximum", [](auto& gl) { gl.BlendEquation(GL_MAX); }, "glBlendEquation", "GL_MAX",
                "blend_equations"},
        Refusal{"tnt", "ConstantFactor", [](auto& gl) { gl.BlendFunc(GL_CONSTANT_ALPHA, GL_ZERO); },
                "glBlendFunc", "GL_CONSTANT_ALPHA, GL_ZERO", "source_factors"},
        Refusal{"geforce2mx", "DepthClamp", [](auto& gl) { gl.Enable(GL_DEPTH_CLAMP); }, "glEnable",
                "GL_DEPTH_CLAMP", "depth_clamp"},
        Refusal{"geforce2mx", "DepthTexture",
                [](auto& gl) {
                    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 64, 64, 0, GL_DEPTH_COMPONENT,
                                  GL_FLOAT, nullptr);
                },
                "glTexImage2D", "GL_DEPTH_COMPONENT", "depth_textures"},
        Refusal{"geforce2mx", "AtomicCounter",
                [](auto& gl) { gl.BindBufferBase(GL_ATOMIC_COUNTER_BUFFER, 0, 1); }, "glBindBufferBase",
                "GL_ATOMIC_COUNTER_BUFFER", "atomic_counters"},
        Refusal{"geforce2mx", "SeventhClipPlane", [](auto& gl) { gl.Enable(GL_CLIP_PLANE0 + 6); }, "glEnable",
                "GL_CLIP_PLANE6", "clip_planes"},
        Refusal{"geforce2mx", "OddTexture",
                [](auto& gl) {
                    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 640, 480, 0, GL_RGB, GL_UNSIGNED_BYTE, nullptr);
                },
                "glTexImage2D", "640x480", "texture_non_power_of_two"},
        Refusal{"geforce2mx", "FactorsOfTheirOwnForAlpha",
                [](auto& gl) { gl.BlendFuncSeparate(GL_ONE, GL_ZERO, GL_ONE, GL_ONE); },
                "glBlendFuncSeparate", "GL_ONE, GL_ZERO, GL_ONE, GL_ONE", "separate_alpha_factors"}),
    [](const auto& test) { return test.param.chip + test.param.name; });

// A chip with programs may still lack each of the things that they can ask for.
TEST(ProgrammableChip, IsRefusedWhatItsProgramsLack) {
    Profile p = chip("ideal");
    p.geometryShaders = p.framebufferFetch = p.atomicCounters = false;
    const FakeDriver driver;
    const GlTable gl = restrictTo(p, bufferFormatOf(p), driver.table());
    EXPECT_NO_THROW(gl.CreateShader(GL_FRAGMENT_SHADER));
    const auto refused = [&](const std::function<void()>& calls) {
        const auto violation = violationOf(calls);
        return violation ? violation->capability : "";
    };
    const auto source = [&](const char* text) {
        return [&gl, text] { gl.ShaderSource(1, 1, &text, nullptr); };
    };
    EXPECT_EQ(refused([&] { gl.CreateShader(GL_GEOMETRY_SHADER); }), "geometry_shaders");
    EXPECT_EQ(refused(source("#extension GL_EXT_shader_framebuffer_fetch : enable")), "framebuffer_fetch");
    EXPECT_EQ(refused(source("uniform atomic_uint n;")), "atomic_counters");
    EXPECT_EQ(refused(source("void main() {}")), "");
    // Only the given length of a text counts.
    const char* text = "void main() {} // atomic_uint";
    const GLint length = 14;
    EXPECT_EQ(refused([&] { gl.ShaderSource(1, 1, &text, &length); }), "");
}

TEST(Ps2, RefusesConstantPairsToDrawsWithAProgram) {
    Profile ps2 = chip("ps2");
    ps2.shaders = true;
    const FakeDriver driver;
    const GlTable gl = restrictTo(ps2, bufferFormatOf(ps2), driver.table());
    gl.ColorMask(1, 1, 1, 0);
    EXPECT_NO_THROW(blendedDraw(gl, GL_DST_COLOR, GL_ZERO));
    gl.UseProgram(1);
    EXPECT_THROW(gl.DrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, nullptr), CapabilityViolation);
    gl.UseProgram(0);
    EXPECT_NO_THROW(gl.DrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, nullptr));
}

// A Voodoo that chose destination alpha instead of depth has it, with the factors 0 and 1 only.
TEST(VoodooWithAlphaInsteadOfDepth, AddsAlphaButCannotDoubleIt) {
    const Profile voodoo = chip("voodoo2");
    const FakeDriver driver;
    const GlTable gl = restrictTo(
        voodoo, {.red = 5, .green = 6, .blue = 5, .alpha = 8, .depth = 0, .stencil = 0}, driver.table());
    gl.ColorMask(0, 0, 0, 1);
    EXPECT_NO_THROW(blendedDraw(gl, GL_ONE, GL_ONE));
    const auto violation = violationOf([&] { blendedDraw(gl, GL_DST_COLOR, GL_ONE); });
    ASSERT_TRUE(violation);
    EXPECT_EQ(violation->capability, "alpha_source_factors");
}

// The chip's FIX is OpenGL's constant alpha, so the call that sets it must be there with the pairs.
TEST(Ps2, SetsTheConstantThatItsPairsUse) {
    const Profile ps2 = chip("ps2");
    const FakeDriver driver;
    const GlTable gl = restrictTo(ps2, bufferFormatOf(ps2), driver.table());
    gl.BlendFunc(GL_CONSTANT_ALPHA, GL_ZERO);
    EXPECT_NO_THROW(gl.BlendColor(0, 0, 0, 0.5f));
}

// llvmpipe itself can do all of this; what refuses is the layer, and OpenGL's state stays as it was.
TEST(RealDriver, NeverSeesARefusedCall) {
    const Profile voodoo = chip("voodoo1");
    TestSurface surface(bufferFormatOf(voodoo), 8, 8);
    const GlTable gl = restrictTo(voodoo, surface.format(), surface.driver());
    const auto pixel = [&] {
        std::array<std::uint8_t, 3> p{};
        surface.driver().ReadPixels(4, 4, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, p.data());
        return p;
    };
    const std::array<float, 8> window{-1, -1, 1, -1, 1, 1, -1, 1};
    gl.ClearColor(1, 1, 1, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    gl.EnableClientState(GL_VERTEX_ARRAY);
    gl.VertexPointer(2, GL_FLOAT, 0, window.data());
    gl.Color4f(0, 0, 0, 1);

    EXPECT_THROW(gl.ColorMask(1, 0, 0, 0), CapabilityViolation);
    EXPECT_THROW(gl.Enable(GL_STENCIL_TEST), CapabilityViolation);
    EXPECT_THROW(gl.Enable(GL_CLIP_PLANE0), CapabilityViolation);
    EXPECT_THROW(gl.BlendEquation(GL_MAX), CapabilityViolation);
    EXPECT_THROW(gl.BlendFunc(GL_SRC_COLOR, GL_ZERO), CapabilityViolation);
    gl.ColorMask(1, 1, 1, 1);
    EXPECT_THROW(gl.DrawArrays(GL_QUADS, 0, 4), CapabilityViolation);
    EXPECT_EQ(pixel(), (std::array<std::uint8_t, 3>{255, 255, 255}));

    gl.ColorMask(1, 1, 1, 0);
    gl.DrawArrays(GL_QUADS, 0, 4);
    EXPECT_EQ(pixel(), (std::array<std::uint8_t, 3>{0, 0, 0}));
    EXPECT_EQ(surface.driver().GetError(), GLenum(GL_NO_ERROR));
}

}  // namespace capability_refusals_test
}  // namespace gnomon
