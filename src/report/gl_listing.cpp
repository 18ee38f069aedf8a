#include "report/gl_listing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "profile/blend.h"
#include "profile/words.h"
#include "report/plan_notes.h"
#include "report/table.h"

namespace gnomon {
namespace {

/// "GL_DST_COLOR" of "dst_color".
template <class Word>
std::string glWord(Word word) {
    return "GL_" + upperCase(name(word));
}

const char* glBool(bool is) {
    return is ? "GL_TRUE" : "GL_FALSE";
}

bool hasConstant(const Blend& blend) {
    return blend.enabled && (isConstant(blend.source) || isConstant(blend.destination));
}
bool isExtreme(BlendEquation e) {
    return e == BlendEquation::Min || e == BlendEquation::Max;
}
/// The equation's enumerant; "" for one that OpenGL has not.
std::string glEquation(BlendEquation e) {
    if (isExtreme(e)) return glWord(e);
    const bool known =
        e == BlendEquation::Add || e == BlendEquation::Subtract || e == BlendEquation::ReverseSubtract;
    return known ? fmt::format("GL_FUNC_{}", glWord(e).substr(3)) : "";
}

bool isTextured(const Pass& pass) {
    return pass.kind == PassKind::Rectangle && pass.texture != MaskTexture::None;
}

/// Which state any pass of a plan changes from OpenGL's default.
struct Used {
    explicit Used(const Plan& plan) {
        for (const Pass& p : plan.passes) {
            const bool draws = p.kind != PassKind::Clear && p.kind != PassKind::Copy;
            scissor |= p.extent != Extent::Whole && p.kind != PassKind::Copy;
            viewport |= p.target == Target::Mask || p.target == Target::OnePixel;
            map |= p.target == Target::DepthMap;
            stencilMask |= p.stencil.writeMask != ~0u;
            if (!draws) continue;
            depth |= p.depthTest || p.depthWrite;
            cull |= p.kind == PassKind::Volume && p.faces != Faces::Both;
            stencil |= p.stencil.enabled;
            blend |= p.blend.enabled;
            equation |= p.blend.enabled && p.blend.equation != BlendEquation::Add;
            alpha |= p.alphaTest.enabled;
            logic |= p.logicInvert;
            depthClamp |= p.depthClamp;
            texture |= isTextured(p);
            program |=
                p.program != Program::None || p.shading == Shading::Mask || p.drawn == Drawn::Silhouettes;
        }
    }

    bool scissor = false, viewport = false, map = false, depth = false, cull = false, stencil = false,
         stencilMask = false, blend = false, equation = false, alpha = false, logic = false,
         depthClamp = false, texture = false, program = false;
};

/// A comment of C, in as many lines as it needs.
std::string comment(const std::string& words) {
    return fmt::format("{}\n", wrapText(fmt::format("/* {} */", words), 3));
}

/// Writes the calls of one pass, a line each.
class Calls {
  public:
    Calls(const Pass& pass, const Plan& plan, const Used& used) : m_pass(pass), m_plan(plan), m_used(used) {
        target();
        switch (pass.kind) {
            case PassKind::Clear:
                clear();
                break;
            case PassKind::Copy:
                copy();
                break;
            case PassKind::Scene:
                state();
                scene();
                break;
            case PassKind::Volume:
                state();
                volume();
                break;
            case PassKind::Rectangle:
                state();
                rectangle();
                break;
        }
    }

    const std::string& text() const { return m_text; }

  private:
    template <class... Args>
    void line(fmt::format_string<Args...> words, Args&&... args) {
        m_text += fmt::format(words, std::forward<Args>(args)...);
        m_text += '\n';
    }

    void turn(const char* what, bool isUsed, bool isOn) {
        if (isUsed) line("gl{}({});", isOn ? "Enable" : "Disable", what);
    }

    void target() {
        const bool toMap = m_pass.target == Target::DepthMap;
        if (m_used.map) {
            if (toMap)
                line("glBindFramebuffer(GL_FRAMEBUFFER, mapOfFace[{}]);", m_pass.mapFace);
            else
                line("glBindFramebuffer(GL_FRAMEBUFFER, 0);");
        }
        if (!m_used.viewport && !m_used.map) return;
        const bool toMask = m_pass.target == Target::Mask, toPixel = m_pass.target == Target::OnePixel;
        line("glViewport(0, 0, {}, {});",
             toMap     ? m_plan.mapSize
             : toMask  ? m_plan.maskWidth
             : toPixel ? 1
                       : m_plan.width,
             toMap     ? m_plan.mapSize
             : toMask  ? m_plan.maskHeight
             : toPixel ? 1
                       : m_plan.height);
    }

    void scissor(const WindowRect& r) {
        // OpenGL takes no negative sizes; an empty rectangle keeps all.
        const WindowRect rect = r.empty() ? WindowRect{} : r;
        line("glScissor({}, {}, {}, {});", rect.x, rect.y, rect.width, rect.height);
    }

    const MaskWindow& window() const { return m_plan.windows[std::size_t(m_pass.light)]; }

    bool hasOwnScissors() const { return m_pass.extent == Extent::Volumes && m_pass.volume == kAllVolumes; }

    void extent() {
        turn("GL_SCISSOR_TEST", m_used.scissor, m_pass.extent != Extent::Whole);
        if (m_pass.extent == Extent::Whole || hasOwnScissors()) return;
        scissor(m_pass.extent == Extent::Shadows ? window().all
                                                 : window().volumes[std::size_t(m_pass.volume)]);
    }

    void colourMask() {
        const ColourWrite& w = m_pass.write;
        line("glColorMask({}, {}, {}, {});", glBool(w.red), glBool(w.green), glBool(w.blue), glBool(w.alpha));
    }

    void stencilMask() {
        if (m_used.stencilMask) line("glStencilMask({:#x}u);", m_pass.stencil.writeMask);
    }

    void clear() {
        extent();
        std::vector<const char*> bits;
        colourMask();
        if (m_pass.write.any()) {
            const glm::vec4& c = m_pass.colour;
            if (m_pass.clearsToBackground)
                line("glClearColor(background[0], background[1], background[2], {:.9g});", c.a);
            else
                line("glClearColor({:.9g}, {:.9g}, {:.9g}, {:.9g});", c.r, c.g, c.b, c.a);
            bits.push_back("GL_COLOR_BUFFER_BIT");
        }
        if (m_pass.clearsDepth) {
            line("glDepthMask(GL_TRUE);");
            line("glClearDepth(1);");
            bits.push_back("GL_DEPTH_BUFFER_BIT");
        }
        if (m_pass.clearsStencil) {
            stencilMask();
            if (m_pass.stencilIsBlockers)
                line("glClearStencil(blockers);");
            else
                line("glClearStencil({});", m_pass.stencilValue);
            bits.push_back("GL_STENCIL_BUFFER_BIT");
        }
        if (!bits.empty()) line("glClear({});", fmt::join(bits, " | "));
    }

    void copy() {
        const char* format = m_pass.texture == MaskTexture::Alpha       ? "GL_ALPHA"
                             : m_pass.texture == MaskTexture::Intensity ? "GL_INTENSITY"
                                                                        : "GL_RGB";
        const bool ofFrame = m_pass.frameTexture;
        const int width = ofFrame ? m_plan.width : m_plan.maskWidth,
                  height = ofFrame ? m_plan.height : m_plan.maskHeight,
                  columns = ofFrame ? m_plan.frameTextureWidth : m_plan.textureWidth,
                  rows = ofFrame ? m_plan.frameTextureHeight : m_plan.textureHeight;
        line("glBindTexture(GL_TEXTURE_2D, {});", ofFrame ? "frameTexture" : "maskTexture");
        const char* filter = m_pass.nearest ? "GL_NEAREST" : "GL_LINEAR";
        line("glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, {});", filter);
        line("glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, {});", filter);
        line("glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);");
        line("glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);");
        if (width == columns && height == rows) {
            line("glCopyTexImage2D(GL_TEXTURE_2D, 0, {}, 0, 0, {}, {}, 0);", format, width, height);
            return;
        }
        line("glTexImage2D(GL_TEXTURE_2D, 0, {}, {}, {}, 0, {}, GL_UNSIGNED_BYTE, NULL);", format, columns,
             rows, m_pass.texture == MaskTexture::Intensity ? "GL_LUMINANCE" : format);
        const auto part = [&](int s, int t, int x, int y, int w, int h) {
            line("glCopyTexSubImage2D(GL_TEXTURE_2D, 0, {}, {}, {}, {}, {}, {});", s, t, x, y, w, h);
        };
        part(0, 0, 0, 0, width, height);
        // The last row and column once more, so that filtering clamps at the edge.
        if (width < columns) part(width, 0, width - 1, 0, 1, height);
        if (height < rows) part(0, height, 0, height - 1, width, 1);
        if (width < columns && height < rows) part(width, height, width - 1, height - 1, 1, 1);
    }

    void state() {
        extent();
        colourMask();
        const bool depth = m_pass.depthTest || m_pass.depthWrite;
        turn("GL_DEPTH_TEST", m_used.depth, depth);
        if (depth)
            line("glDepthFunc({});", glWord(m_pass.depthTest ? m_pass.depthFunction : Compare::Always));
        line("glDepthMask({});", glBool(m_pass.depthWrite));
        turn("GL_DEPTH_CLAMP", m_used.depthClamp, m_pass.depthClamp);
        const bool culls = m_pass.kind == PassKind::Volume && m_pass.faces != Faces::Both;
        turn("GL_CULL_FACE", m_used.cull, culls);
        if (culls) line("glCullFace({});", m_pass.faces == Faces::Front ? "GL_BACK" : "GL_FRONT");
        stencil();
        turn("GL_ALPHA_TEST", m_used.alpha, m_pass.alphaTest.enabled);
        if (m_pass.alphaTest.enabled)
            line("glAlphaFunc({}, {:.9g});", glWord(m_pass.alphaTest.function), m_pass.alphaTest.reference);
        blend();
        turn("GL_COLOR_LOGIC_OP", m_used.logic, m_pass.logicInvert);
        if (m_pass.logicInvert) line("glLogicOp(GL_INVERT);");
        turn("GL_TEXTURE_2D", m_used.texture, isTextured(m_pass));
        program();
    }

    void stencil() {
        const Stencil& s = m_pass.stencil;
        turn("GL_STENCIL_TEST", m_used.stencil, s.enabled);
        if (!s.enabled) return;
        stencilMask();
        const std::string reference = s.minusBlockers ? fmt::format("({} - blockers) & 0xff", s.reference)
                                                      : fmt::format("{}", s.reference);
        line("glStencilFunc({}, {}, {:#x}u);", glWord(s.function), reference, s.readMask);
        if (s.front == s.back) {
            line("glStencilOp(GL_KEEP, {}, {});", glWord(s.front.onDepthFail), glWord(s.front.onPass));
            return;
        }
        for (const auto& [face, side] : {std::pair("GL_FRONT", s.front), std::pair("GL_BACK", s.back)})
            line("glStencilOpSeparate({}, GL_KEEP, {}, {});", face, glWord(side.onDepthFail),
                 glWord(side.onPass));
    }

    void blend() {
        const Blend& b = m_pass.blend;
        turn("GL_BLEND", m_used.blend, b.enabled);
        if (!b.enabled) return;
        if (const std::string equation = glEquation(b.equation); equation.empty())
            line("/* blend equation {}: OpenGL has none */", name(b.equation));
        else if (m_used.equation)
            line("glBlendEquation({});", equation);
        if (!isExtreme(b.equation)) line("glBlendFunc({}, {});", glWord(b.source), glWord(b.destination));
        if (hasConstant(b)) line("glBlendColor({0:.9g}, {0:.9g}, {0:.9g}, {0:.9g});", b.constant);
    }

    void program() {
        if (!m_used.program) return;
        if (m_pass.program == Program::CountFaces)
            line("/* program: red and green as 16 bits, front {:+d}, back {:+d} */", m_pass.frontCount,
                 -m_pass.frontCount);
        else if (m_pass.program == Program::ShadeCount)
            line("/* program: colours times {:.9g} where the 16 bits of red and green are not 0 */",
                 m_plan.shadowShare);
        else if (m_pass.shading == Shading::Mask)
            line("/* program: {:.9g} where the depth map holds a caster before the point, else 1 */",
                 m_plan.shadowShare);
        else if (m_pass.drawn == Drawn::Silhouettes)
            line("/* program: a geometry shader makes volumes and counts what hides the eye */");
        else
            line("/* no program */");
    }

    void scene() {
        if (m_pass.target == Target::DepthMap) {
            line("drawCasters({}, {});", m_pass.light, m_pass.mapFace);
            return;
        }
        if (drawsBackdrop(m_pass)) {
            if (m_pass.blackBackdrop)
                line("drawBackdrop(BLACK);");
            else
                line("drawBackdrop(BACKGROUND);");
        }
        const char* colours = !m_pass.write.any()                      ? "NO_COLOUR"
                              : m_pass.shading == Shading::Lit         ? "LIT"
                              : m_pass.shading == Shading::Diffuse     ? "DIFFUSE"
                              : m_pass.shading == Shading::Ambient     ? "AMBIENT"
                              : m_pass.shading == Shading::Black       ? "BLACK"
                              : m_pass.shading == Shading::HalfDiffuse ? "HALF_DIFFUSE"
                              : m_pass.shading == Shading::RestDiffuse ? "REST_OF_DIFFUSE"
                                                                       : "DEPTH_MAP";
        line("drawScene({}, {});", colours, m_pass.light);
    }

    /// "SIDES | FAR_CAPS".
    std::string parts() const {
        static const char* const kNames[kParts]{"SIDES", "NEAR_FACES", "FAR_CAPS", "LIGHT_CAPS", "NEAR_CAPS"};
        std::vector<const char*> names;
        for (int part = 0; part < kParts; ++part)
            if (m_pass.parts.has(Part(part))) names.push_back(kNames[part]);
        return names.empty() ? "0" : fmt::format("{}", fmt::join(names, " | "));
    }

    void colour() {
        const glm::vec4& c = m_pass.colour;
        line("glColor4f({:.9g}, {:.9g}, {:.9g}, {:.9g});", c.r, c.g, c.b, c.a);
    }

    void volume() {
        colour();
        if (m_pass.drawn == Drawn::Blockers) {
            line("drawBlockers({});", m_pass.light);
            line("glReadPixels(0, 0, 1, 1, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, &blockers);");
        } else if (m_pass.drawn == Drawn::Silhouettes) {
            line("blockers = drawSilhouettes({});", m_pass.light);
        } else if (m_pass.volume != kAllVolumes) {
            line("drawVolumes({0}, {1}, {1}, {2});", m_pass.light, m_pass.volume, parts());
        } else if (!hasOwnScissors()) {
            line("drawAllVolumes({}, {});", m_pass.light, parts());
        } else {
            const std::vector<WindowRect>& rects = window().volumes;
            for (std::size_t i = 0; i < rects.size();) {
                const std::size_t first = i;
                while (i < rects.size() && rects[i] == rects[first]) ++i;
                if (rects[first].empty()) continue;
                scissor(rects[first]);
                line("drawVolumes({}, {}, {}, {});", m_pass.light, first, i - 1, parts());
            }
        }
    }

    void rectangle() {
        colour();
        if (isTextured(m_pass)) {
            const bool ofFrame = m_pass.frameTexture;
            line("glBindTexture(GL_TEXTURE_2D, {});", ofFrame ? "frameTexture" : "maskTexture");
            line("glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);");
            line("drawTexturedRectangle({}, {});",
                 ofFrame ? shareText(m_plan.width, m_plan.frameTextureWidth)
                         : shareText(m_plan.maskWidth, m_plan.textureWidth),
                 ofFrame ? shareText(m_plan.height, m_plan.frameTextureHeight)
                         : shareText(m_plan.maskHeight, m_plan.textureHeight));
            return;
        }
        line("drawRectangle();");
    }

    /// The part of a texture that was copied to, as its last coordinate.
    static std::string shareText(int pixels, int texels) {
        return pixels == texels ? "1" : fmt::format("{}.0 / {}", pixels, texels);
    }

    const Pass& m_pass;
    const Plan& m_plan;
    const Used& m_used;
    std::string m_text{};
};

}  // namespace

std::string glCalls(const Pass& pass, const Plan& plan) {
    return Calls(pass, plan, Used(plan)).text();
}

std::vector<std::string> glCalls(const Plan& plan) {
    const Used used(plan);
    std::vector<std::string> calls;
    for (const Pass& pass : plan.passes) calls.push_back(Calls(pass, plan, used).text());
    return calls;
}

std::string glSetup() {
    return "/* State is OpenGL's default but for dithering, which would change a mask's values. */\n"
           "/* Names without gl are yours; faces are counter-clockwise seen from outside. */\n"
           "glDisable(GL_DITHER);\n";
}

std::vector<std::string> beyondOpenGl11(const Plan& plan) {
    std::vector<std::string> needs;
    const auto need = [&](bool is, const std::string& what) {
        if (is && std::find(needs.begin(), needs.end(), what) == needs.end()) needs.push_back(what);
    };
    const auto powerOfTwo = [](int n) { return (n & (n - 1)) == 0; };
    for (const Pass& p : plan.passes) {
        const Blend& b = p.blend;
        need(b.enabled &&
                 (b.equation == BlendEquation::Subtract || b.equation == BlendEquation::ReverseSubtract),
             "glBlendEquation for differences: OpenGL 1.4 or GL_EXT_blend_subtract");
        need(b.enabled && isExtreme(b.equation),
             "glBlendEquation for the extreme: OpenGL 1.4 or GL_EXT_blend_minmax");
        if (b.enabled && glEquation(b.equation).empty())
            need(true, fmt::format("blend equation {}: OpenGL has none", name(b.equation)));
        need(hasConstant(b), "glBlendColor: OpenGL 1.4 or GL_EXT_blend_color");
        need(b.enabled &&
                 (b.source == BlendFactor::SrcColor || b.source == BlendFactor::OneMinusSrcColor ||
                  b.destination == BlendFactor::DstColor || b.destination == BlendFactor::OneMinusDstColor),
             "a colour times itself as a blend factor: OpenGL 1.4 or GL_NV_blend_square");
        const Stencil& s = p.stencil;
        if (s.enabled) {
            for (const StencilOp op :
                 {s.front.onDepthFail, s.front.onPass, s.back.onDepthFail, s.back.onPass})
                need(op == StencilOp::IncrWrap || op == StencilOp::DecrWrap,
                     "stencil counts that wrap: OpenGL 1.4 or GL_EXT_stencil_wrap");
            need(!(s.front == s.back),
                 "glStencilOpSeparate: OpenGL 2.0, or GL_EXT_stencil_two_side in its own words");
        }
        need(p.depthClamp, "GL_DEPTH_CLAMP: OpenGL 3.2 or GL_NV_depth_clamp");
        need(p.kind == PassKind::Copy, "GL_CLAMP_TO_EDGE: OpenGL 1.2 or GL_EXT_texture_edge_clamp");
        const int columns = p.frameTexture ? plan.frameTextureWidth : plan.textureWidth,
                  rows = p.frameTexture ? plan.frameTextureHeight : plan.textureHeight;
        need(p.kind == PassKind::Copy && !(powerOfTwo(columns) && powerOfTwo(rows)),
             "textures of any size: OpenGL 2.0 or GL_ARB_texture_non_power_of_two");
        need(p.program == Program::CountFaces,
             "a program that reads the frame buffer: GL_EXT_shader_framebuffer_fetch");
        need(p.program == Program::ShadeCount,
             "a program that reads the frame buffer: GL_EXT_shader_framebuffer_fetch");
        need(p.countsBlockers, "geometry shaders with an atomic counter: OpenGL 4.2");
        need(p.target == Target::DepthMap, "framebuffer objects: OpenGL 3.0");
        need(p.shading == Shading::Mask, "programs that sample a depth texture: OpenGL 2.0");
    }
    return needs;
}

std::string glListing(const Plan& plan, const std::string& profile,
                      const std::vector<std::string>& chipTerms) {
    std::string text;
    for (const std::string& need : beyondOpenGl11(plan))
        text += comment(fmt::format("beyond OpenGL 1.1: {}", need));
    text += glSetup();
    const std::vector<std::string> calls = glCalls(plan);
    std::size_t volumes = 0, folded = 0;
    const auto endFold = [&] {
        if (folded > 0)
            text += fmt::format("\n/* {} more volume passes, front and back faces in turn */\n", folded);
        folded = 0;
    };
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const Pass& pass = plan.passes[i];
        if (pass.kind == PassKind::Volume && ++volumes > kShownVolumes) {
            ++folded;
            continue;
        }
        endFold();
        text += fmt::format("\n{}", comment(fmt::format("pass {}: {}", i + 1, pass.label)));
        if (i < chipTerms.size() && !chipTerms[i].empty())
            text += comment(fmt::format("{}: {}", profile, chipTerms[i]));
        text += calls[i];
    }
    endFold();
    return text;
}

}  // namespace gnomon
