// The capability layer, probed call by call over a driver that draws nothing. What a chip must refuse is
// worked out here from its facts, by rules of this file and not by the layer's; the refusals on which the
// paper's methods turn are spelled out once more without any rule.

#include "gl/capability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "fake_driver.h"
#include "gl/surface.h"
#include "gl/words.h"
#include "tools.h"

namespace gnomon {
namespace capability_test {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
template <class Word>
struct Named {
    GLenum value;
    const char* text;
    Word word;
};

constexpr std::array<Named<BlendFactor>, 15> kFactors{{
    {GL_ZERO, "GL_ZERO", BlendFactor::Zero},
    {GL_ONE, "GL_ONE", BlendFactor::One},
    {GL_SRC_COLOR, "GL_SRC_COLOR", BlendFactor::SrcColor},
    {GL_ONE_MINUS_SRC_COLOR, "GL_ONE_MINUS_SRC_COLOR", BlendFactor::OneMinusSrcColor},
    {GL_DST_COLOR, "GL_DST_COLOR", BlendFactor::DstColor},
    {GL_ONE_MINUS_DST_COLOR, "GL_ONE_MINUS_DST_COLOR", BlendFactor::OneMinusDstColor},
    {GL_SRC_ALPHA, "GL_SRC_ALPHA", BlendFactor::SrcAlpha},
    {GL_ONE_MINUS_SRC_ALPHA, "GL_ONE_MINUS_SRC_ALPHA", BlendFactor::OneMinusSrcAlpha},
    {GL_DST_ALPHA, "GL_DST_ALPHA", BlendFactor::DstAlpha},
    {GL_ONE_MINUS_DST_ALPHA, "GL_ONE_MINUS_DST_ALPHA", BlendFactor::OneMinusDstAlpha},
    {GL_SRC_ALPHA_SATURATE, "GL_SRC_ALPHA_SATURATE", BlendFactor::SrcAlphaSaturate},
    {GL_CONSTANT_COLOR, "GL_CONSTANT_COLOR", BlendFactor::ConstantColor},
    {GL_ONE_MINUS_CONSTANT_COLOR, "GL_ONE_MINUS_CONSTANT_COLOR", BlendFactor::OneMinusConstantColor},
    {GL_CONSTANT_ALPHA, "GL_CONSTANT_ALPHA", BlendFactor::ConstantAlpha},
    {GL_ONE_MINUS_CONSTANT_ALPHA, "GL_ONE_MINUS_CONSTANT_ALPHA", BlendFactor::OneMinusConstantAlpha},
}};
constexpr std::array<Named<BlendEquation>, 8> kEquations{{
    {GL_FUNC_ADD, "GL_ADD", BlendEquation::Add},
    {GL_FUNC_SUBTRACT, "GL_SUBTRACT", BlendEquation::Subtract},
    {GL_FUNC_REVERSE_SUBTRACT, "GL_REVERSE_SUBTRACT", BlendEquation::ReverseSubtract},
    {GL_MIN, "GL_MIN", BlendEquation::Min},
    {GL_MAX, "GL_MAX", BlendEquation::Max},
    {GL_FUNC_ADD_WRAP, "GL_ADD_WRAP", BlendEquation::AddWrap},
    {GL_FUNC_SIGNED_ADD, "GL_SIGNED_ADD", BlendEquation::SignedAdd},
    {GL_FUNC_SIGNED_REVERSE_SUBTRACT, "GL_SIGNED_REVERSE_SUBTRACT", BlendEquation::SignedReverseSubtract},
}};
constexpr std::array<Named<Compare>, 8> kCompares{{
    {GL_NEVER, "GL_NEVER", Compare::Never},
    {GL_LESS, "GL_LESS", Compare::Less},
    {GL_EQUAL, "GL_EQUAL", Compare::Equal},
    {GL_LEQUAL, "GL_LEQUAL", Compare::Lequal},
    {GL_GREATER, "GL_GREATER", Compare::Greater},
    {GL_NOTEQUAL, "GL_NOTEQUAL", Compare::Notequal},
    {GL_GEQUAL, "GL_GEQUAL", Compare::Gequal},
    {GL_ALWAYS, "GL_ALWAYS", Compare::Always},
}};
constexpr std::array<Named<StencilOp>, 8> kOps{{
    {GL_KEEP, "GL_KEEP", StencilOp::Keep},
    {GL_ZERO, "GL_ZERO", StencilOp::Zero},
    {GL_REPLACE, "GL_REPLACE", StencilOp::Replace},
    {GL_INCR, "GL_INCR", StencilOp::Incr},
    {GL_DECR, "GL_DECR", StencilOp::Decr},
    {GL_INVERT, "GL_INVERT", StencilOp::Invert},
    {GL_INCR_WRAP, "GL_INCR_WRAP", StencilOp::IncrWrap},
    {GL_DECR_WRAP, "GL_DECR_WRAP", StencilOp::DecrWrap},
}};
constexpr std::array<double, 4> kPlane{0, 1, 0, 0};

/// One call after others that every chip allows, and the capabilities that the chip lacks for it.
struct Probe {
    std::string name{};      ///< unique
    std::string entry{};     ///< "glEnable"
    std::string argument{};  ///< part of what a violation must call its argument
    std::set<std::string> lacks{};
    Calls call{};
    Calls prepare = [](const GlTable&) {};
};

/// All probes, the same for each chip, with what @p p lacks for each.
class Probes {
  public:
    explicit Probes(const Profile& profile) : p(profile) {
        stencil();
        geometry();
        depth();
        alphaTest();
        logicOps();
        blendPairs();
        blendSeparately();
        textures();
        masksAndFrames();
        programs();
        alphaBesideDepth();
        varyingSource();
    }
    std::vector<Probe> take() { return std::move(m_probes); }

  private:
    using Lacks = std::set<std::string>;

    void add(
        std::string entry, std::string argument, Lacks lacks, Calls call, std::string with = "",
        Calls prepare = [](const GlTable&) {}) {
        m_probes.push_back({entry + "(" + argument + ")" + (with.empty() ? "" : " " + with), entry, argument,
                            std::move(lacks), std::move(call), std::move(prepare)});
    }
    static Lacks unless(bool has, const char* key) { return has ? Lacks{} : Lacks{key}; }
    static Lacks both(Lacks a, const Lacks& b) {
        a.insert(b.begin(), b.end());
        return a;
    }

    void stencil() {
        const Lacks any = unless(p.stencilBits > 0, "stencil_bits");
        const Lacks sides = both(any, unless(p.twoSidedStencil, "two_sided_stencil"));
        add("glEnable", "GL_STENCIL_TEST", any, [](auto& gl) { gl.Enable(GL_STENCIL_TEST); });
        add("glClear", "GL_STENCIL_BUFFER_BIT", any, [](auto& gl) { gl.Clear(GL_STENCIL_BUFFER_BIT); });
        add(
            "glClear", "GL_STENCIL_BUFFER_BIT", any,
            [](auto& gl) { gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT); },
            "with colour and depth");
        add("glClearStencil", "128", any, [](auto& gl) { gl.ClearStencil(128); });
        add("glStencilMask", "0xff", any, [](auto& gl) { gl.StencilMask(0xff); });
        for (const auto& f : kCompares)
            add("glStencilFunc", f.text, any, [f](auto& gl) { gl.StencilFunc(f.value, 1, 0xff); });
        for (const auto& op : kOps) {
            const bool wraps = op.word == StencilOp::IncrWrap || op.word == StencilOp::DecrWrap;
            const Lacks lacks = both(any, unless(!wraps || p.stencilWrap, "stencil_wrap"));
            const std::string shown = p.stencilBits > 0 ? op.text : "GL_";
            add(
                "glStencilOp", shown, lacks, [op](auto& gl) { gl.StencilOp(GL_KEEP, GL_KEEP, op.value); },
                std::string(op.text) + " on pass");
            add(
                "glStencilOp", shown, lacks, [op](auto& gl) { gl.StencilOp(GL_KEEP, op.value, GL_KEEP); },
                std::string(op.text) + " on depth fail");
            for (const auto& [face, text] : {std::pair(GL_FRONT, "GL_FRONT"), std::pair(GL_BACK, "GL_BACK")})
                add(
                    "glStencilOpSeparate", text, both(lacks, sides),
                    [op, side = face](auto& gl) {
                        gl.StencilOpSeparate(GLenum(side), GL_KEEP, GL_KEEP, op.value);
                    },
                    op.text);
        }
        for (const auto& [face, text] : {std::pair(GL_FRONT, "GL_FRONT"), std::pair(GL_BACK, "GL_BACK")}) {
            for (const auto& f : kCompares)
                add(
                    "glStencilFuncSeparate", text, sides,
                    [f, side = face](auto& gl) { gl.StencilFuncSeparate(GLenum(side), f.value, 0, 0xff); },
                    f.text);
            add("glStencilMaskSeparate", text, sides,
                [side = face](auto& gl) { gl.StencilMaskSeparate(GLenum(side), 0xff); });
        }
        // Both sides alike is what one-sided stencil does anyway.
        add("glStencilFuncSeparate", "GL_FRONT_AND_BACK", any,
            [](auto& gl) { gl.StencilFuncSeparate(GL_FRONT_AND_BACK, GL_ALWAYS, 0, 0xff); });
    }

    void geometry() {
        for (int i = 0; i < 8; ++i) {
            const std::string plane = "GL_CLIP_PLANE" + std::to_string(i);
            const Lacks lacks = unless(i < p.clipPlanes, "clip_planes");
            add("glEnable", plane, lacks, [i](auto& gl) { gl.Enable(GLenum(GL_CLIP_PLANE0 + i)); });
            add("glClipPlane", plane, lacks,
                [i](auto& gl) { gl.ClipPlane(GLenum(GL_CLIP_PLANE0 + i), kPlane.data()); });
        }
        const Lacks factor = unless(p.polygonOffsetFactor, "polygon_offset_factor");
        const Lacks units = unless(p.polygonOffsetUnits, "polygon_offset_units");
        add("glPolygonOffset", "factor", factor, [](auto& gl) { gl.PolygonOffset(1, 0); });
        add("glPolygonOffset", "units", units, [](auto& gl) { gl.PolygonOffset(0, 1); });
        add(
            "glPolygonOffset", "", both(factor, units), [](auto& gl) { gl.PolygonOffset(1, 1); }, "both");
        add("glEnable", "GL_POLYGON_OFFSET_FILL", factor.empty() || units.empty() ? Lacks{} : units,
            [](auto& gl) { gl.Enable(GL_POLYGON_OFFSET_FILL); });
    }

    void depth() {
        for (const auto& f : kCompares)
            add("glDepthFunc", f.text, unless(p.depthFunctions.contains(f.word), "depth_functions"),
                [f](auto& gl) { gl.DepthFunc(f.value); });
    }

    void alphaTest() {
        add("glEnable", "GL_ALPHA_TEST", unless(!p.alphaFunctions.empty(), "alpha_functions"),
            [](auto& gl) { gl.Enable(GL_ALPHA_TEST); });
        for (const auto& f : kCompares)
            add("glAlphaFunc", f.text, unless(p.alphaFunctions.contains(f.word), "alpha_functions"),
                [f](auto& gl) { gl.AlphaFunc(f.value, 0.5f); });
    }

    void logicOps() {
        const Lacks any = unless(p.logicOps, "logic_ops");
        add("glEnable", "GL_COLOR_LOGIC_OP", any, [](auto& gl) { gl.Enable(GL_COLOR_LOGIC_OP); });
        for (const auto& [operation, text] :
             {std::pair(GL_INVERT, "GL_INVERT"), std::pair(GL_COPY, "0x1503"), std::pair(GL_XOR, "0x1506")})
            add("glLogicOp", text, any, [op = operation](auto& gl) { gl.LogicOp(GLenum(op)); });
    }

    const char* pairKey() const { return p.id == "ps2" ? "blend_pairs" : "source_factors"; }

    void blendPairs() {
        for (const auto& s : kFactors)
            for (const auto& d : kFactors) {
                const BlendPair pair{s.word, d.word};
                const bool somehow =
                    (p.sourceFactors.contains(s.word) && p.destinationFactors.contains(d.word)) ||
                    p.blendPairs.contains(pair) || p.constantSourcePairs.contains(pair);
                const std::string text = std::string(s.text) + ", " + d.text;
                add("glBlendFunc", text, unless(somehow, pairKey()),
                    [s, d](auto& gl) { gl.BlendFunc(s.value, d.value); });
                add("glBlendFuncSeparate", text, unless(somehow, pairKey()),
                    [s, d](auto& gl) { gl.BlendFuncSeparate(s.value, d.value, s.value, d.value); });
            }
        const auto isConstant = [](BlendFactor f) { return f >= BlendFactor::ConstantColor; };
        const auto pairHas = [&](const BlendPair& b) { return isConstant(b.first) || isConstant(b.second); };
        const bool constants = std::any_of(p.sourceFactors.begin(), p.sourceFactors.end(), isConstant) ||
                               std::any_of(p.blendPairs.begin(), p.blendPairs.end(), pairHas);
        add("glBlendColor", "constant colour", unless(constants, pairKey()),
            [](auto& gl) { gl.BlendColor(0.5f, 0.5f, 0.5f, 0.5f); });
    }

    /// With the factors 0 and 1 alone, which all chips have.
    void blendSeparately() {
        const Lacks apart = unless(p.separateAlphaFactors, "separate_alpha_factors");
        for (int bits = 0; bits < 16; ++bits) {
            const auto f = [bits](int i) { return GLenum(bits >> i & 1); };
            if (f(0) == f(2) && f(1) == f(3)) continue;
            std::string text;
            for (int i = 0; i < 4; ++i) text += (i ? ", " : "") + std::string(kFactors[f(i)].text);
            add("glBlendFuncSeparate", text, apart,
                [f](auto& gl) { gl.BlendFuncSeparate(f(0), f(1), f(2), f(3)); });
        }
        const auto lacks = [&](const auto& e) {
            return unless(p.blendEquations.contains(e.word), "blend_equations");
        };
        for (const auto& a : kEquations) {
            add("glBlendEquation", a.text, lacks(a), [a](auto& gl) { gl.BlendEquation(a.value); });
            for (const auto& b : kEquations)
                add(
                    "glBlendEquationSeparate", "",
                    both(both(lacks(a), lacks(b)), a.word == b.word ? Lacks{} : apart),
                    [a, b](auto& gl) { gl.BlendEquationSeparate(a.value, b.value); },
                    std::string(a.text) + " " + b.text);
        }
    }

    Lacks texture(int width, int height) const {
        const auto isPower = [](int n) { return (n & (n - 1)) == 0; };
        const int aspect = std::max(width, height) / std::min(width, height);
        Lacks lacks = unless(std::max(width, height) <= p.maxTextureSize, "max_texture_size");
        if (p.maxTextureAspect && aspect > p.maxTextureAspect) lacks.insert("max_texture_aspect");
        if (!(isPower(width) && isPower(height)) && !p.textureNonPowerOfTwo)
            lacks.insert("texture_non_power_of_two");
        return lacks;
    }

    void textures() {
        for (const auto& [w, h] :
             {std::pair(1, 1), std::pair(256, 256), std::pair(512, 512), std::pair(1024, 1024),
              std::pair(2048, 2048), std::pair(4096, 4096), std::pair(16384, 16384), std::pair(512, 256),
              std::pair(256, 32), std::pair(256, 16), std::pair(16, 256), std::pair(64, 1),
              std::pair(100, 100), std::pair(96, 64), std::pair(64, 96), std::pair(3, 3), std::pair(255, 256),
              std::pair(320, 240), std::pair(640, 480)}) {
            const std::string size = std::to_string(w) + "x" + std::to_string(h);
            add("glTexImage2D", size, texture(w, h), [width = w, height = h](auto& gl) {
                gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, nullptr);
            });
            add("glCopyTexImage2D", size, texture(w, h), [width = w, height = h](auto& gl) {
                gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, width, height, 0);
            });
        }
        for (int i = 0; i < 8; ++i)
            add("glActiveTexture", "GL_TEXTURE" + std::to_string(i),
                unless(i < p.textureUnits, "texture_units"),
                [i](auto& gl) { gl.ActiveTexture(GLenum(GL_TEXTURE0 + i)); });
    }

    void masksAndFrames() {
        for (int bits = 0; bits < 16; ++bits) {
            const bool r = bits & 8, g = bits & 4, b = bits & 2, a = bits & 1;
            std::string text;
            for (const bool c : {r, g, b, a}) text += (text.empty() ? "" : ", ") + std::string(c ? "1" : "0");
            const bool whole = (r && g && b) || (!r && !g && !b);
            add("glColorMask", text, unless(whole || p.writeMask == WriteMask::Channel, "write_mask"),
                [=](auto& gl) { gl.ColorMask(r, g, b, a); });
        }
        // Bytes of two colour buffers and depth: 16-bit pixels on the Voodoos, 32-bit ones elsewhere.
        const std::int64_t perPixel = p.id.starts_with("voodoo") ? 6 : 12;
        for (const auto& [x, y, w, h] :
             {std::array{0, 0, 320, 240}, std::array{0, 0, 641, 16}, std::array{0, 0, 16, 481},
              std::array{0, 0, 801, 16}, std::array{0, 0, 16, 601}, std::array{1, 0, 800, 600},
              std::array{0, 1, 800, 600}, std::array{0, 0, 1024, 768}, std::array{0, 0, 2049, 16},
              std::array{0, 0, 16, 2049}, std::array{0, 0, 2048, 2048}, std::array{0, 0, 4096, 4096}}) {
            const int right = x + w, top = y + h;
            Lacks lacks;
            if (p.maxWidth && right > p.maxWidth) lacks.insert("max_width");
            if (p.maxHeight && top > p.maxHeight) lacks.insert("max_height");
            if (p.frameBytes && right * top * perPixel > p.frameBytes) lacks.insert("frame_bytes");
            add("glViewport", std::to_string(right) + "x" + std::to_string(top), lacks,
                [left = x, bottom = y, width = w, height = h](auto& gl) {
                    gl.Viewport(left, bottom, width, height);
                });
        }
    }

    void programs() {
        const Lacks lacks = unless(p.shaders, "shaders");
        const Lacks geometry = both(lacks, unless(p.geometryShaders, "geometry_shaders"));
        for (const auto& [type, text] :
             {std::pair(GL_VERTEX_SHADER, "GL_VERTEX_SHADER"),
              std::pair(GL_FRAGMENT_SHADER, "GL_FRAGMENT_SHADER"),
              std::pair(GL_GEOMETRY_SHADER, "GL_GEOMETRY_SHADER"),
              std::pair(GL_TESS_CONTROL_SHADER, "0x8e88"), std::pair(GL_TESS_EVALUATION_SHADER, "0x8e87"),
              std::pair(GL_COMPUTE_SHADER, "0x91b9")})
            add("glCreateShader", text, type == GL_GEOMETRY_SHADER ? geometry : lacks,
                [kind = type](auto& gl) { gl.CreateShader(GLenum(kind)); });
        add("glCreateProgram", "", lacks, [](auto& gl) { gl.CreateProgram(); });
        add("glUseProgram", "7", lacks, [](auto& gl) { gl.UseProgram(7); });
        for (const auto& [argument, text, has, key] :
             {std::tuple("GL_EXT_shader_framebuffer_fetch",
                         "#extension GL_EXT_shader_framebuffer_fetch : require\n", p.framebufferFetch,
                         "framebuffer_fetch"),
              std::tuple("atomic_uint", "layout(binding = 0) uniform atomic_uint n;", p.atomicCounters,
                         "atomic_counters")})
            add("glShaderSource", argument, unless(has, key), [source = text](auto& gl) {
                const std::array<const char*, 2> parts{"#version 420\n", source};
                gl.ShaderSource(1, 2, parts.data(), nullptr);
            });
        add("glBindBufferBase", "GL_ATOMIC_COUNTER_BUFFER", unless(p.atomicCounters, "atomic_counters"),
            [](auto& gl) { gl.BindBufferBase(GL_ATOMIC_COUNTER_BUFFER, 0, 1); });
        const Lacks map = unless(p.depthTextures, "depth_textures");
        add("glTexImage2D", "GL_DEPTH_COMPONENT", map, [](auto& gl) {
            gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 64, 64, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                          nullptr);
        });
        add(
            "glCopyTexImage2D", map.empty() ? "" : "GL_DEPTH_COMPONENT24", map,
            [](auto& gl) { gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 0, 0, 64, 64, 0); },
            "depth");
        add("glBindFramebuffer", "3", map, [](auto& gl) { gl.BindFramebuffer(GL_FRAMEBUFFER, 3); });
        add("glBindFramebuffer", "0", {}, [](auto& gl) { gl.BindFramebuffer(GL_FRAMEBUFFER, 0); });
        add("glEnable", "GL_DEPTH_CLAMP", unless(p.depthClamp, "depth_clamp"),
            [](auto& gl) { gl.Enable(GL_DEPTH_CLAMP); });
    }

    static void draw(const GlTable& gl) { gl.DrawArrays(GL_TRIANGLES, 0, 3); }

    /// Each alone is allowed; together they need destination alpha while depth is there.
    void alphaBesideDepth() {
        const Lacks beside = unless(!p.alphaExcludesDepth, "alpha_excludes_depth");
        const Calls alphaOnly = [](auto& gl) { gl.ColorMask(0, 0, 0, 1); };
        const Calls all = [](auto& gl) { gl.ColorMask(1, 1, 1, 1); };
        add("glDrawArrays", "alpha", beside, draw, "writing alpha alone", alphaOnly);
        add("glDrawArrays", "alpha", beside, draw, "writing colour and alpha", all);
        add(
            "glClear", "alpha", beside, [](auto& gl) { gl.Clear(GL_COLOR_BUFFER_BIT); }, "alone", alphaOnly);
        add(
            "glClear", "alpha", beside, [](auto& gl) { gl.Clear(GL_COLOR_BUFFER_BIT); }, "and colour", all);
        for (const auto& [s, d, text] :
             {std::tuple(GL_ZERO, GL_DST_ALPHA, "GL_ZERO, GL_DST_ALPHA"),
              std::tuple(GL_DST_ALPHA, GL_ONE, "GL_DST_ALPHA, GL_ONE"),
              std::tuple(GL_ONE_MINUS_DST_ALPHA, GL_ZERO, "GL_ONE_MINUS_DST_ALPHA, GL_ZERO"),
              std::tuple(GL_ZERO, GL_ONE_MINUS_DST_ALPHA, "GL_ZERO, GL_ONE_MINUS_DST_ALPHA"),
              std::tuple(GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA, "GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA")})
            add("glDrawArrays", text, beside, draw, "reading alpha", [source = s, destination = d](auto& gl) {
                gl.ColorMask(1, 1, 1, 0);
                gl.Enable(GL_BLEND);
                gl.BlendFunc(GLenum(source), GLenum(destination));
            });
        for (const auto& [format, text] : {std::pair(GL_ALPHA, "GL_ALPHA"), std::pair(GL_ALPHA4, "GL_ALPHA4"),
                                           std::pair(GL_ALPHA8, "GL_ALPHA8")}) {
            add(
                "glCopyTexImage2D", "alpha", beside,
                [inner = format](auto& gl) {
                    gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GLenum(inner), 0, 0, 64, 64, 0);
                },
                text);
            add(
                "glCopyTexSubImage2D", "alpha", beside,
                [](auto& gl) { gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, 64, 64); }, text,
                [inner = format](auto& gl) {
                    gl.TexImage2D(GL_TEXTURE_2D, 0, inner, 64, 64, 0, GL_ALPHA, GL_UNSIGNED_BYTE, nullptr);
                });
        }
        // Section 4.2's doubling in alpha: neither beside depth, nor by a blender that leaves alpha alone.
        add("glDrawArrays", "alpha", both(beside, unless(p.blendWritesAlpha, "blend_writes_alpha")), draw,
            "doubling alpha", [](auto& gl) {
                gl.ColorMask(0, 0, 0, 1);
                gl.Enable(GL_BLEND);
                gl.BlendFunc(GL_DST_COLOR, GL_ONE);
            });
    }

    /// The mask's pairs under source colours that vary, and under a grey that doesn't.
    void varyingSource() {
        struct Source {
            const char* name;
            bool varies;
            Calls set;
        };
        const std::array<Source, 5> sources{{
            {"colour array", true, [](auto& gl) { gl.EnableClientState(GL_COLOR_ARRAY); }},
            {"texture", true, [](auto& gl) { gl.Enable(GL_TEXTURE_2D); }},
            {"reddish colour", true, [](auto& gl) { gl.Color4f(0.6f, 0.5f, 0.5f, 1); }},
            {"bluish colour", true, [](auto& gl) { gl.Color4f(0.5f, 0.5f, 0.6f, 1); }},
            {"grey", false, [](auto& gl) { gl.Color4f(0.5f, 0.5f, 0.5f, 1); }},
        }};
        for (const auto& [s, d, text] :
             {std::tuple(GL_DST_COLOR, GL_ONE, "GL_DST_COLOR, GL_ONE"),
              std::tuple(GL_DST_COLOR, GL_ZERO, "GL_DST_COLOR, GL_ZERO"),
              std::tuple(GL_ZERO, GL_SRC_COLOR, "GL_ZERO, GL_SRC_COLOR"),
              std::tuple(GL_ONE_MINUS_DST_COLOR, GL_ZERO, "GL_ONE_MINUS_DST_COLOR, GL_ZERO")})
            for (const Source& source : sources)
                add("glDrawArrays", text, unless(p.id != "ps2" || !source.varies, "blend_pairs"), draw,
                    source.name, [from = s, to = d, set = source.set](auto& gl) {
                        gl.ColorMask(1, 1, 1, 0);
                        gl.Enable(GL_BLEND);
                        gl.BlendFunc(GLenum(from), GLenum(to));
                        set(gl);
                    });
    }

    const Profile& p;
    std::vector<Probe> m_probes{};
};

std::vector<Probe> probesOf(const Profile& profile) {
    return Probes(profile).take();
}

void expectAsForeseen(const Profile& profile, const Probe& probe) {
    SCOPED_TRACE(probe.name);
    const FakeDriver driver;
    const GlTable gl = restrictTo(profile, bufferFormatOf(profile), driver.table());
    ASSERT_NO_THROW(probe.prepare(gl));
    const auto before = driver.calls();
    const auto violation = violationOf([&] { probe.call(gl); });
    if (probe.lacks.empty()) {
        ASSERT_FALSE(violation) << violation->what();
        ASSERT_EQ(driver.calls().size(), before.size() + 1);
        EXPECT_EQ(driver.calls().back(), probe.entry);
        return;
    }
    ASSERT_TRUE(violation) << "reached the driver";
    EXPECT_EQ(driver.calls(), before) << "refused, yet the driver was reached";
    EXPECT_EQ(violation->call, probe.entry);
    EXPECT_THAT(violation->argument, HasSubstr(probe.argument));
    EXPECT_THAT(probe.lacks, Contains(violation->capability));
    EXPECT_EQ(violation->source, profile.sourceOf(violation->capability));
    for (const std::string& part :
         {violation->call, violation->argument, violation->capability, violation->source})
        EXPECT_THAT(violation->what(), HasSubstr(part));
}

class EachLimitedChip : public testing::TestWithParam<std::string> {};

TEST_P(EachLimitedChip, RefusesWhatItLacksBeforeTheDriverAndLetsTheRestThrough) {
    const Profile profile = chip(GetParam());
    for (const Probe& probe : probesOf(profile)) expectAsForeseen(profile, probe);
}

// Issue 2, part 3.
TEST_P(EachLimitedChip, IsProbedBySixtyForbiddenCallsOrMore) {
    std::set<std::string> forbidden, all;
    for (const Probe& probe : probesOf(chip(GetParam()))) {
        EXPECT_TRUE(all.insert(probe.name).second) << probe.name << " twice";
        if (!probe.lacks.empty()) forbidden.insert(probe.name);
    }
    EXPECT_GE(forbidden.size(), 60u);
}

INSTANTIATE_TEST_SUITE_P(Chips, EachLimitedChip, testing::ValuesIn(kLimitedChips),
                         [](const auto& test) { return test.param; });

TEST(Scissor, IsThereOnEachChip) {
    int chips = 0;
    for (const auto& file : std::filesystem::directory_iterator(kFolder)) {
        const Profile profile = loadProfile(file.path());
        const FakeDriver driver;
        const GlTable gl = restrictTo(profile, bufferFormatOf(profile), driver.table());
        gl.Enable(GL_SCISSOR_TEST);
        gl.Scissor(1, 2, 3, 4);
        gl.Disable(GL_SCISSOR_TEST);
        EXPECT_THAT(driver.calls(), testing::ElementsAre("glEnable", "glScissor", "glDisable")) << profile.id;
        ++chips;
    }
    EXPECT_GT(chips, 10);
}

TEST(Ideal, LetsEachProbeReachTheDriver) {
    const Profile ideal = chip("ideal");
    for (const Probe& probe : probesOf(ideal)) {
        // The signed sums are NV2A's alone.
        const bool isNv2as = probe.name.find("GL_SIGNED_") != std::string::npos;
        EXPECT_EQ(probe.lacks.empty(), !isNv2as) << probe.name;
        expectAsForeseen(ideal, probe);
    }
}

}  // namespace capability_test
}  // namespace gnomon
