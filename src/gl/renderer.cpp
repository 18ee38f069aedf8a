#include "gl/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <optional>
#include <stdexcept>

#include "gl/capability.h"
#include "gl/programs.h"
#include "gl/stopwatch.h"
#include "gl/words.h"

namespace gnomon {
namespace {

constexpr std::array<float, 8> kWindow{-1, -1, 1, -1, 1, 1, -1, 1};

/// The background as it is drawn, whether by a clear or by a surface at infinity.
glm::u8vec3 bytesOf(const glm::vec3& colour) {
    return glm::u8vec3(glm::clamp(colour, 0.0f, 1.0f) * 255.0f + 0.5f);
}

void flipRows(Image& image) {
    const std::size_t row = std::size_t(image.width) * image.channels;
    for (int y = 0; y < image.height / 2; ++y) {
        auto* a = image.data.data() + row * y;
        std::swap_ranges(a, a + row, image.data.data() + row * (image.height - 1 - y));
    }
}

Image readPixels(Surface& surface, GLenum format, int channels) {
    Image image{surface.width(), surface.height(), channels, {}};
    image.data.resize(std::size_t(image.width) * image.height * channels);
    surface.driver().ReadPixels(0, 0, image.width, image.height, format, GL_UNSIGNED_BYTE, image.data.data());
    flipRows(image);
    return image;
}

/// A texture that the frame or a mask was copied to.
struct CopiedTexture {
    GLuint name = 0;
    float u = 1, v = 1;  ///< the part of it that was copied to
};

/// Draws the window-filling rectangle with @p texture under the current state.
void fillWith(const GlTable& gl, const CopiedTexture& texture) {
    const std::array<float, 8> coordinates{0, 0, texture.u, 0, texture.u, texture.v, 0, texture.v};
    gl.Enable(GL_TEXTURE_2D);
    gl.BindTexture(GL_TEXTURE_2D, texture.name);
    gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
    gl.TexCoordPointer(2, GL_FLOAT, 0, coordinates.data());
    gl.VertexPointer(2, GL_FLOAT, 0, kWindow.data());
    gl.DrawArrays(GL_QUADS, 0, 4);
    gl.DisableClientState(GL_TEXTURE_COORD_ARRAY);
    gl.Disable(GL_TEXTURE_2D);
}

bool isConstant(BlendFactor factor) {
    return factor >= BlendFactor::ConstantColor && factor <= BlendFactor::OneMinusConstantAlpha;
}

/// Executes passes; each sets all the state that it depends on.
class PassRunner {
  public:
    PassRunner(const GlTable& table, const Plan& plan, const FrameSurfaces& surfaces,
               const LightFrames& lights, Programs programs)
        : gl(table), m_plan(plan), m_surfaces(surfaces), m_lights(lights), m_programs(std::move(programs)) {}

    ~PassRunner() {
        for (const CopiedTexture* t : {&m_mask, &m_frame})
            if (t->name) gl.DeleteTextures(1, &t->name);
        for (const auto& [face, map] : m_maps) gl.DeleteTextures(1, &map);
        if (m_framebuffer) gl.DeleteFramebuffers(1, &m_framebuffer);
    }
    PassRunner(const PassRunner&) = delete;
    PassRunner& operator=(const PassRunner&) = delete;

    void run(const Pass& pass) {
        const bool toMap = pass.target == Target::DepthMap;
        if (toMap) bindMap(pass);
        switch (pass.target) {
            case Target::Window:
                gl.Viewport(0, 0, m_plan.width, m_plan.height);
                break;
            case Target::Mask:
                gl.Viewport(0, 0, m_plan.maskWidth, m_plan.maskHeight);
                break;
            case Target::DepthMap:
                gl.Viewport(0, 0, m_plan.mapSize, m_plan.mapSize);
                break;
            case Target::OnePixel:
                gl.Viewport(0, 0, 1, 1);
                break;
        }
        const auto bound = scissorOf(pass, m_plan.windows);
        turn(GL_SCISSOR_TEST, m_scissorTest, bound.has_value());
        if (bound) scissor(*bound);
        switch (pass.kind) {
            case PassKind::Clear:
                clear(pass);
                break;
            case PassKind::Copy:
                copy(pass);
                break;
            case PassKind::Scene:
                scene(pass);
                break;
            case PassKind::Volume:
                volume(pass);
                break;
            case PassKind::Rectangle:
                rectangle(pass);
                break;
        }
        if (toMap) gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    }

    /// What a stencil value is compared with.
    int reference(const Stencil& stencil) const {
        return (stencil.reference - (stencil.minusBlockers ? m_blockers : 0)) & 0xff;
    }

    const CopiedTexture& mask() const { return m_mask; }

    /// Sets the state that is kept between passes to OpenGL's defaults, so that decorators know of it.
    void defaultState() {
        if (m_equation != BlendEquation::Add) gl.BlendEquation(glEnum(m_equation = BlendEquation::Add));
        stencilMask(~0u);
        turn(GL_COLOR_LOGIC_OP, m_logicOp, false);
        turn(GL_ALPHA_TEST, m_alphaTest, false);
        turn(GL_SCISSOR_TEST, m_scissorTest, false);
    }

  private:
    void clear(const Pass& pass) {
        colourMask(pass.write);
        GLbitfield bits = 0;
        if (pass.write.any()) {
            glm::vec4 colour = pass.colour;
            if (pass.clearsToBackground)
                colour = glm::vec4(glm::vec3(bytesOf(m_surfaces.background)) / 255.0f, colour.a);
            gl.ClearColor(colour.r, colour.g, colour.b, colour.a);
            bits |= GL_COLOR_BUFFER_BIT;
        }
        if (pass.clearsDepth) {
            gl.DepthMask(GL_TRUE);
            bits |= GL_DEPTH_BUFFER_BIT;
        }
        if (pass.clearsStencil) {
            stencilMask(pass.stencil.writeMask);
            gl.ClearStencil(pass.stencilIsBlockers ? m_blockers : pass.stencilValue);
            bits |= GL_STENCIL_BUFFER_BIT;
        }
        gl.Clear(bits);
    }

    void scene(const Pass& pass) {
        state(pass);
        gl.Disable(GL_CULL_FACE);
        if (pass.target == Target::DepthMap)
            return draw(m_lights(pass.light).depthMap.faces[std::size_t(pass.mapFace)]);
        if (!pass.write.any()) return draw(m_surfaces.positions);
        if (pass.shading == Shading::Mask) return depthMapMask(pass);

        if (pass.program == Program::ShadeCount) m_programs.useShadeCount(float(m_plan.shadowShare));
        gl.EnableClientState(GL_COLOR_ARRAY);
        // What lies at infinity takes part wherever the scene meets a mask that stands in the colour buffer.
        if (drawsBackdrop(pass)) backdrop(pass.blackBackdrop ? glm::vec3(0) : m_surfaces.background);
        const std::vector<VertexColour> mixed = mixedColours(pass);
        const std::vector<VertexColour>& colours =
            pass.shading == Shading::Lit       ? m_lights(pass.light).colours->lit
            : pass.shading == Shading::Diffuse ? m_lights(pass.light).colours->diffuse
            : pass.shading == Shading::Ambient ? m_surfaces.ambient
                                               : mixed;
        gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, colours.data());
        draw(m_surfaces.positions);
        gl.DisableClientState(GL_COLOR_ARRAY);
        // Where a colour array is enabled and nothing drawn, Mesa forgets that the colour has changed.
        if (m_surfaces.positions.empty()) gl.Color4f(0, 0, 0, 0);
        if (pass.program != Program::None) m_programs.useNone();
    }

    /// The colours of the shadings that are made of others.
    std::vector<VertexColour> mixedColours(const Pass& pass) const {
        if (pass.shading == Shading::Black)
            return std::vector<VertexColour>(m_surfaces.positions.size(), VertexColour(0, 0, 0, 255));
        if (pass.shading != Shading::HalfDiffuse && pass.shading != Shading::RestDiffuse) return {};
        std::vector<VertexColour> colours = m_lights(pass.light).colours->diffuse;
        for (VertexColour& colour : colours) {
            for (int k = 0; k < 3; ++k) {
                const int half = colour[k] / 2;
                colour[k] = std::uint8_t(pass.shading == Shading::HalfDiffuse ? half : colour[k] - half);
            }
        }
        return colours;
    }

    /// The background as a surface at infinity: depth 1, z = w.
    void backdrop(const glm::vec3& background) {
        static constexpr std::array<glm::vec4, 6> kCorners{
            glm::vec4{-1, -1, 1, 1}, {1, -1, 1, 1}, {1, 1, 1, 1},
            glm::vec4{-1, -1, 1, 1}, {1, 1, 1, 1},  {-1, 1, 1, 1}};
        std::array<VertexColour, 6> colours;
        colours.fill(VertexColour(bytesOf(background), 255));
        gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, colours.data());
        draw(kCorners);
    }

    void volume(const Pass& pass) {
        state(pass);
        gl.Color4f(pass.colour.r, pass.colour.g, pass.colour.b, pass.colour.a);
        if (pass.faces == Faces::Both) {
            gl.Disable(GL_CULL_FACE);
        } else {
            gl.Enable(GL_CULL_FACE);
            gl.CullFace(pass.faces == Faces::Front ? GL_BACK : GL_FRONT);
        }
        if (pass.depthClamp) gl.Enable(GL_DEPTH_CLAMP);
        if (pass.program == Program::CountFaces) m_programs.useCountFaces(pass.frontCount);
        const LightFrame& light = m_lights(pass.light);
        if (pass.drawn == Drawn::Blockers) {
            draw(light.blockers);
            std::uint8_t count = 0;
            gl.ReadPixels(0, 0, 1, 1, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, &count);
            m_blockers = count;
        } else if (pass.drawn == Drawn::Silhouettes) {
            const auto blockers =
                m_programs.drawSilhouettes(light.silhouettes, m_plan.clip, pass.countsBlockers);
            if (blockers) m_blockers = *blockers;
            m_programs.useNone();
        } else if (pass.extent == Extent::Volumes && pass.volume == kAllVolumes) {
            eachInItsWindow(pass, *light.volumes);
        } else {
            for (int part = 0; part < kParts; ++part)
                if (pass.parts.has(Part(part)))
                    draw(pass.volume == kAllVolumes
                             ? light.volumes->all(Part(part))
                             : light.volumes->of(Part(part), std::size_t(pass.volume)));
        }
        if (pass.program == Program::CountFaces) m_programs.useNone();
        if (pass.depthClamp) gl.Disable(GL_DEPTH_CLAMP);
    }

    /// All volumes, each under its own scissor; neighbours that share one are drawn at once.
    void eachInItsWindow(const Pass& pass, const FrameVolumes& volumes) {
        const std::vector<WindowRect>& windows = m_plan.windows[std::size_t(pass.light)].volumes;
        assert(windows.size() == volumes.size());
        bool drawsAny = false;
        std::size_t first = 0, end = 0;
        for (; first < windows.size(); first = end) {
            for (end = first + 1; end < windows.size() && windows[end] == windows[first];) ++end;
            if (windows[first].empty()) continue;
            scissor(windows[first]);
            for (int part = 0; part < kParts; ++part) {
                if (!pass.parts.has(Part(part))) continue;
                const FrameVolumes::Runs& runs = volumes.parts[std::size_t(part)];
                draw(std::span(runs.vertices)
                         .subspan(runs.begins[first], runs.begins[end] - runs.begins[first]));
            }
            drawsAny = true;
        }
        if (!drawsAny) draw({});
    }

    void rectangle(const Pass& pass) {
        state(pass);
        gl.Disable(GL_CULL_FACE);
        gl.Color4f(pass.colour.r, pass.colour.g, pass.colour.b, pass.colour.a);
        if (pass.texture != MaskTexture::None) return fillWith(gl, pass.frameTexture ? m_frame : m_mask);
        gl.VertexPointer(2, GL_FLOAT, 0, kWindow.data());
        gl.DrawArrays(GL_QUADS, 0, 4);
    }

    /// Copies the mask, or the frame. Where the texture is larger, the last row, column and corner are copied
    /// once more beside it, so that bilinear filtering clamps at the edge.
    void copy(const Pass& pass) {
        const GLenum format = pass.texture == MaskTexture::Alpha       ? GL_ALPHA
                              : pass.texture == MaskTexture::Intensity ? GL_INTENSITY
                                                                       : GL_RGB;
        const bool ofFrame = pass.frameTexture;
        const int width = ofFrame ? m_plan.width : m_plan.maskWidth,
                  height = ofFrame ? m_plan.height : m_plan.maskHeight;
        const int textureWidth = ofFrame ? m_plan.frameTextureWidth : m_plan.textureWidth,
                  textureHeight = ofFrame ? m_plan.frameTextureHeight : m_plan.textureHeight;
        CopiedTexture& texture = ofFrame ? m_frame : m_mask;
        texture.u = float(width) / float(textureWidth), texture.v = float(height) / float(textureHeight);
        if (!texture.name) gl.GenTextures(1, &texture.name);
        gl.BindTexture(GL_TEXTURE_2D, texture.name);
        const GLint filter = pass.nearest ? GL_NEAREST : GL_LINEAR;
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
        if (width == textureWidth && height == textureHeight) {
            gl.CopyTexImage2D(GL_TEXTURE_2D, 0, format, 0, 0, width, height, 0);
            return;
        }
        const GLenum base = pass.texture == MaskTexture::Intensity ? GL_LUMINANCE : format;
        gl.TexImage2D(GL_TEXTURE_2D, 0, GLint(format), textureWidth, textureHeight, 0, base, GL_UNSIGNED_BYTE,
                      nullptr);
        gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, width, height);
        if (width < textureWidth) gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, width, 0, width - 1, 0, 1, height);
        if (height < textureHeight)
            gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, height, 0, height - 1, width, 1);
        if (width < textureWidth && height < textureHeight)
            gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, width, height, width - 1, height - 1, 1, 1);
    }

    /// Makes one face of a light's depth map the buffer that is drawn to.
    void bindMap(const Pass& pass) {
        GLuint& map = m_maps[{pass.light, pass.mapFace}];
        if (!m_framebuffer) gl.GenFramebuffers(1, &m_framebuffer);
        if (!map) {
            gl.GenTextures(1, &map);
            gl.BindTexture(GL_TEXTURE_2D, map);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
            gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, m_plan.mapSize, m_plan.mapSize, 0,
                          GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
        }
        gl.BindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map, 0);
        gl.DrawBuffer(GL_NONE);
    }

    void depthMapMask(const Pass& pass) {
        const DepthMapFrame& map = m_lights(pass.light).depthMap;
        for (std::size_t f = 0; f < map.faces.size(); ++f) {
            gl.ActiveTexture(GLenum(GL_TEXTURE0 + f));
            gl.BindTexture(GL_TEXTURE_2D, m_maps.at({pass.light, int(f)}));
        }
        gl.ActiveTexture(GL_TEXTURE0);
        m_programs.useDepthMap(map, m_plan.mapSize, m_plan.mapBias, float(m_plan.shadowShare));
        gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
        gl.TexCoordPointer(3, GL_FLOAT, 0, map.coordinates.data());
        draw(m_surfaces.positions);
        gl.DisableClientState(GL_TEXTURE_COORD_ARRAY);
        m_programs.useNone();
    }

    /// An empty list is drawn too: the pass is made all the same.
    void draw(std::span<const glm::vec4> triangles) {
        gl.VertexPointer(4, GL_FLOAT, 0, triangles.data());
        gl.DrawArrays(GL_TRIANGLES, 0, GLsizei(triangles.size()));
    }

    void colourMask(const ColourWrite& w) { gl.ColorMask(w.red, w.green, w.blue, w.alpha); }

    void stencilMask(unsigned mask) {
        if (mask != m_stencilMask) gl.StencilMask(m_stencilMask = mask);
    }

    /// @param part  of the target; an empty one lets nothing through
    void scissor(const WindowRect& part) {
        if (m_scissor == part) return;
        gl.Scissor(part.x, part.y, std::max(part.width, 0), std::max(part.height, 0));
        m_scissor = part;
    }

    void turn(GLenum what, bool& is, bool on) {
        if (is == on) return;
        on ? gl.Enable(what) : gl.Disable(what);
        is = on;
    }

    void state(const Pass& pass) {
        colourMask(pass.write);
        if (pass.depthTest || pass.depthWrite) {
            gl.Enable(GL_DEPTH_TEST);
            gl.DepthFunc(glEnum(pass.depthTest ? pass.depthFunction : Compare::Always));
        } else {
            gl.Disable(GL_DEPTH_TEST);
        }
        gl.DepthMask(pass.depthWrite);

        // A chip without these has no such calls to make.
        turn(GL_COLOR_LOGIC_OP, m_logicOp, pass.logicInvert);
        if (pass.logicInvert) gl.LogicOp(GL_INVERT);
        turn(GL_ALPHA_TEST, m_alphaTest, pass.alphaTest.enabled);
        if (pass.alphaTest.enabled) gl.AlphaFunc(glEnum(pass.alphaTest.function), pass.alphaTest.reference);
        if (pass.blend.enabled) {
            gl.Enable(GL_BLEND);
            // The equation is an extension: a chip that only adds has no such call to make.
            if (pass.blend.equation != m_equation) gl.BlendEquation(glEnum(m_equation = pass.blend.equation));
            if (pass.blend.equation != BlendEquation::Min && pass.blend.equation != BlendEquation::Max)
                gl.BlendFunc(glEnum(pass.blend.source), glEnum(pass.blend.destination));
            const float c = pass.blend.constant;
            if (isConstant(pass.blend.source) || isConstant(pass.blend.destination))
                gl.BlendColor(c, c, c, c);
        } else {
            gl.Disable(GL_BLEND);
        }

        const Stencil& s = pass.stencil;
        if (!s.enabled) return gl.Disable(GL_STENCIL_TEST);
        gl.Enable(GL_STENCIL_TEST);
        stencilMask(s.writeMask);
        gl.StencilFunc(glEnum(s.function), reference(s), s.readMask);
        if (s.front == s.back) {
            gl.StencilOp(GL_KEEP, glEnum(s.front.onDepthFail), glEnum(s.front.onPass));
        } else {
            gl.StencilOpSeparate(GL_FRONT, GL_KEEP, glEnum(s.front.onDepthFail), glEnum(s.front.onPass));
            gl.StencilOpSeparate(GL_BACK, GL_KEEP, glEnum(s.back.onDepthFail), glEnum(s.back.onPass));
        }
    }

    const GlTable& gl;
    const Plan& m_plan;
    const FrameSurfaces& m_surfaces;
    const LightFrames& m_lights;
    Programs m_programs;
    BlendEquation m_equation = BlendEquation::Add;
    unsigned m_stencilMask = ~0u;
    bool m_logicOp = false, m_alphaTest = false, m_scissorTest = false;
    std::optional<WindowRect> m_scissor{};  ///< none before the first
    int m_blockers = 0;                     ///< what hides the eye, as the light counted last
    CopiedTexture m_mask{}, m_frame{};
    GLuint m_framebuffer = 0;
    std::map<std::pair<int, int>, GLuint> m_maps{};  ///< by light and face
};

/// Back to OpenGL's defaults, past all decorators.
void resetState(const GlTable& gl) {
    for (const GLenum what : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_BLEND, GL_CULL_FACE, GL_TEXTURE_2D,
                              GL_DEPTH_CLAMP, GL_ALPHA_TEST, GL_COLOR_LOGIC_OP, GL_SCISSOR_TEST})
        gl.Disable(what);
    gl.UseProgram(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.StencilMask(~0u);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.Color4f(1, 1, 1, 1);
    gl.DisableClientState(GL_COLOR_ARRAY);
    gl.DisableClientState(GL_TEXTURE_COORD_ARRAY);
    gl.EnableClientState(GL_VERTEX_ARRAY);
}

/// Counts the fragments that pass all tests.
class SampleCounter {
  public:
    explicit SampleCounter(const GlTable& table) : gl(table) { gl.GenQueries(1, &m_query); }
    ~SampleCounter() { gl.DeleteQueries(1, &m_query); }
    SampleCounter(const SampleCounter&) = delete;
    SampleCounter& operator=(const SampleCounter&) = delete;

    void begin() { gl.BeginQuery(GL_SAMPLES_PASSED, m_query); }
    std::int64_t end() {
        gl.EndQuery(GL_SAMPLES_PASSED);
        GLuint64 samples = 0;
        gl.GetQueryObjectui64v(m_query, GL_QUERY_RESULT, &samples);
        return std::int64_t(samples);
    }

  private:
    const GlTable& gl;
    GLuint m_query = 0;
};

using MaskValues = std::vector<std::uint16_t>;

MaskValues channelOf(const Image& image, int channel) {
    MaskValues values(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = image.data[i * image.channels + channel];
    return values;
}

/// Red and green hold a count of 16 bits.
MaskValues countsOf(const Image& image) {
    MaskValues values(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = std::uint16_t(image.data[i * image.channels] + 256 * image.data[i * image.channels + 1]);
    return values;
}

/// The mask as it went over the scene: its texture over the whole window, by itself. The window's colours
/// wait in another texture meanwhile.
MaskValues readMaskTexture(Surface& surface, const Plan& plan, PassRunner& runner) {
    const GlTable& gl = surface.driver();
    runner.defaultState();
    resetState(gl);
    gl.Viewport(0, 0, plan.width, plan.height);
    CopiedTexture kept;
    gl.GenTextures(1, &kept.name);
    gl.BindTexture(GL_TEXTURE_2D, kept.name);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.CopyTexImage2D(GL_TEXTURE_2D, 0, surface.format().alpha ? GL_RGBA : GL_RGB, 0, 0, plan.width,
                      plan.height, 0);
    fillWith(gl, runner.mask());
    const bool inAlpha = std::any_of(plan.passes.begin(), plan.passes.end(), [](const Pass& pass) {
        return pass.kind == PassKind::Copy && pass.texture == MaskTexture::Alpha;
    });
    MaskValues values = channelOf(readColour(surface, inAlpha), inAlpha ? 3 : 0);
    fillWith(gl, kept);
    gl.DeleteTextures(1, &kept.name);
    return values;
}

/// The mask as it stands in its buffer, or as its texture goes over the scene.
MaskValues readDrawnMask(Surface& surface, const Plan& plan, const MaskTap& tap, PassRunner& runner) {
    switch (tap.place) {
        case MaskPlace::Stencil:
            return channelOf(readStencil(surface), 0);
        case MaskPlace::Colour:
            return channelOf(readColour(surface), 0);
        case MaskPlace::Alpha:
            return channelOf(readColour(surface, true), 3);
        case MaskPlace::Counter:
            return countsOf(readColour(surface));
        case MaskPlace::Texture:
            return readMaskTexture(surface, plan, runner);
        case MaskPlace::None:
            break;
    }
    return MaskValues(std::size_t(plan.width) * plan.height);
}

/// The mask, with what stands for pixels that the plan draws none for.
/// @pre a plan that leaves pixels out has a mask as large as the window
MaskValues readMask(Surface& surface, const Plan& plan, const MaskTap& tap, PassRunner& runner) {
    MaskValues values = readDrawnMask(surface, plan, tap, runner);
    if (tap.outside < 0) return values;
    assert(plan.maskWidth == plan.width && plan.maskHeight == plan.height);
    const WindowRect& drawn = plan.windows[std::size_t(tap.light)].all;
    for (int y = 0; y < plan.height; ++y)
        for (int x = 0; x < plan.width; ++x)
            if (!drawn.holds(x, plan.height - 1 - y))
                values[std::size_t(y) * std::size_t(plan.width) + std::size_t(x)] =
                    std::uint16_t(tap.outside);
    return values;
}

}  // namespace

Image readColour(Surface& surface, bool alpha) {
    return readPixels(surface, alpha ? GL_RGBA : GL_RGB, alpha ? 4 : 3);
}

Image readStencil(Surface& surface) {
    return readPixels(surface, GL_STENCIL_INDEX, 1);
}

Rendered render(Surface& surface, const Profile& profile, const Plan& plan, const FrameSurfaces& surfaces,
                const LightFrames& lights, const RenderOptions& options) {
    surface.makeCurrent();
    const GlTable& driver = surface.driver();
    resetState(driver);
    while (driver.GetError() != GL_NO_ERROR) {
    }

    Counter counter;
    const GlTable gl = counter.count(restrictTo(profile, surface.format(), driver));
    PassRunner runner(gl, plan, surfaces, lights, Programs(gl, surface.programs(), profile.id + "/"));
    Rendered out;
    std::size_t lightCount = 1;
    for (const MaskTap& mask : plan.masks) lightCount = std::max(lightCount, std::size_t(mask.light) + 1);
    out.masks.resize(lightCount);
    out.values.resize(out.masks.size());
    auto tap = plan.masks.begin();
    Stopwatch watch(surface);
    std::optional<SampleCounter> samples;
    if (options.countsSamples) samples.emplace(driver);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        // What the light adds is made before the clock starts.
        const Pass& pass = plan.passes[i];
        if (pass.kind == PassKind::Scene || pass.kind == PassKind::Volume) lights(pass.light);
        const bool taps = tap != plan.masks.end() && tap->after == i + 1;
        const bool waits = i + 1 == plan.passes.size() || taps || options.afterPass || options.timesPasses;
        if (samples) samples->begin();
        watch.start();
        runner.run(pass);
        if (waits) gl.Finish();
        const double ms = watch.stop();
        out.cpuMs += ms;
        if (options.timesPasses) out.passMs.push_back(ms);
        if (samples) out.passSamples.push_back(samples->end());
        if (const GLenum error = driver.GetError(); error != GL_NO_ERROR)
            throw std::runtime_error(
                fmt::format("OpenGL error 0x{:04x} in pass {}: {}", error, i + 1, plan.passes[i].label));
        if (options.afterPass) options.afterPass(i);
        if (taps) {
            MaskValues values = readMask(surface, plan, *tap, runner);
            std::vector<bool>& shadow = out.masks[std::size_t(tap->light)];
            const int reference = runner.reference(tap->test);
            shadow.resize(values.size());
            for (std::size_t p = 0; p < values.size(); ++p)
                shadow[p] = isShadow(plan, *tap, values[p], reference);
            out.values[std::size_t(tap->light)] = std::move(values);
            ++tap;
        }
    }
    out.image = readColour(surface);
    out.counts = counter.counts();
    if (plan.masks.empty()) {
        out.masks[0].resize(std::size_t(plan.width) * plan.height);
        out.values[0].resize(out.masks[0].size());
    }
    return out;
}

}  // namespace gnomon
