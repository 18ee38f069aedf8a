#include "gl/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <stdexcept>

#include "gl/capability.h"
#include "gl/words.h"

namespace gnomon {
namespace {

constexpr std::array<float, 8> kWindow{-1, -1, 1, -1, 1, 1, -1, 1};

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

std::vector<bool> belowThreshold(const Image& image, int channel, double threshold) {
    std::vector<bool> shadow(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < shadow.size(); ++i)
        shadow[i] = image.data[i * image.channels + channel] < threshold * 255;
    return shadow;
}

/// Executes passes; each sets all the state that it depends on.
class PassRunner {
  public:
    PassRunner(const GlTable& table, const Plan& plan, const FrameSurfaces& surfaces,
               const FrameVolumes& volumes)
        : gl(table), m_plan(plan), m_surfaces(surfaces), m_volumes(volumes) {}

    ~PassRunner() {
        if (m_texture) gl.DeleteTextures(1, &m_texture);
    }
    PassRunner(const PassRunner&) = delete;
    PassRunner& operator=(const PassRunner&) = delete;

    void run(const Pass& pass) {
        if (pass.lowResolution)
            gl.Viewport(0, 0, m_plan.maskWidth, m_plan.maskHeight);
        else
            gl.Viewport(0, 0, m_plan.width, m_plan.height);
        switch (pass.kind) {
            case PassKind::Clear:
                return clear(pass);
            case PassKind::Copy:
                return copy(pass);
            case PassKind::Scene:
                return scene(pass);
            case PassKind::Volume:
                return volume(pass);
            case PassKind::Rectangle:
                return rectangle(pass);
        }
    }

    GLuint texture() const { return m_texture; }

    /// Draws the window-filling rectangle with the mask's texture under the current state.
    void drawTextured(const GlTable& table) const {
        const float u = float(m_plan.maskWidth) / float(m_plan.textureWidth),
                    v = float(m_plan.maskHeight) / float(m_plan.textureHeight);
        const std::array<float, 8> coordinates{0, 0, u, 0, u, v, 0, v};
        table.Enable(GL_TEXTURE_2D);
        table.BindTexture(GL_TEXTURE_2D, m_texture);
        table.EnableClientState(GL_TEXTURE_COORD_ARRAY);
        table.TexCoordPointer(2, GL_FLOAT, 0, coordinates.data());
        table.VertexPointer(2, GL_FLOAT, 0, kWindow.data());
        table.DrawArrays(GL_QUADS, 0, 4);
        table.DisableClientState(GL_TEXTURE_COORD_ARRAY);
        table.Disable(GL_TEXTURE_2D);
    }

  private:
    void clear(const Pass& pass) {
        colourMask(pass.write);
        glm::vec4 colour = pass.colour;
        if (pass.clearsToBackground) colour = glm::vec4(m_surfaces.background, colour.a);
        gl.ClearColor(colour.r, colour.g, colour.b, colour.a);
        GLbitfield bits = GL_COLOR_BUFFER_BIT;
        if (pass.clearsDepth) {
            gl.DepthMask(GL_TRUE);
            bits |= GL_DEPTH_BUFFER_BIT;
        }
        if (pass.clearsStencil) {
            gl.ClearStencil(0);
            bits |= GL_STENCIL_BUFFER_BIT;
        }
        gl.Clear(bits);
    }

    void scene(const Pass& pass) {
        state(pass);
        gl.Disable(GL_CULL_FACE);
        const bool coloured = pass.write.any();
        if (coloured) {
            // What lies at infinity takes part wherever the scene meets a mask that stands in the colour
            // buffer.
            if (pass.depthTest && !pass.depthWrite && pass.shading != Shading::Ambient) backdrop();
            const auto& colours = pass.shading == Shading::Lit       ? m_surfaces.lit
                                  : pass.shading == Shading::Diffuse ? m_surfaces.diffuse
                                                                     : m_surfaces.ambient;
            gl.EnableClientState(GL_COLOR_ARRAY);
            gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, colours.data());
        }
        draw(m_surfaces.positions);
        if (coloured) gl.DisableClientState(GL_COLOR_ARRAY);
    }

    /// The background as a surface at infinity: depth 1, z = w.
    void backdrop() {
        static constexpr std::array<glm::vec4, 6> kCorners{
            glm::vec4{-1, -1, 1, 1}, {1, -1, 1, 1}, {1, 1, 1, 1},
            glm::vec4{-1, -1, 1, 1}, {1, 1, 1, 1},  {-1, 1, 1, 1}};
        std::array<Rgba, 6> colours;
        colours.fill(Rgba(glm::u8vec3(glm::clamp(m_surfaces.background, 0.0f, 1.0f) * 255.0f + 0.5f), 255));
        gl.EnableClientState(GL_COLOR_ARRAY);
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
        draw(pass.volume == kAllVolumes ? std::span(m_volumes.vertices)
                                        : m_volumes[std::size_t(pass.volume)]);
    }

    void rectangle(const Pass& pass) {
        state(pass);
        gl.Disable(GL_CULL_FACE);
        gl.Color4f(pass.colour.r, pass.colour.g, pass.colour.b, pass.colour.a);
        if (pass.texture != MaskTexture::None) return drawTextured(gl);
        gl.VertexPointer(2, GL_FLOAT, 0, kWindow.data());
        gl.DrawArrays(GL_QUADS, 0, 4);
    }

    /// Copies the mask. Where the texture is larger than the mask, its last row, column and corner are copied
    /// once more beside it, so that bilinear filtering clamps at the mask's edge.
    void copy(const Pass& pass) {
        const GLenum format = pass.texture == MaskTexture::Alpha       ? GL_ALPHA
                              : pass.texture == MaskTexture::Intensity ? GL_INTENSITY
                                                                       : GL_RGB;
        const int width = m_plan.maskWidth, height = m_plan.maskHeight;
        gl.GenTextures(1, &m_texture);
        gl.BindTexture(GL_TEXTURE_2D, m_texture);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
        if (width == m_plan.textureWidth && height == m_plan.textureHeight) {
            gl.CopyTexImage2D(GL_TEXTURE_2D, 0, format, 0, 0, width, height, 0);
            return;
        }
        const GLenum base = pass.texture == MaskTexture::Intensity ? GL_LUMINANCE : format;
        gl.TexImage2D(GL_TEXTURE_2D, 0, GLint(format), m_plan.textureWidth, m_plan.textureHeight, 0, base,
                      GL_UNSIGNED_BYTE, nullptr);
        gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, width, height);
        if (width < m_plan.textureWidth)
            gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, width, 0, width - 1, 0, 1, height);
        if (height < m_plan.textureHeight)
            gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, height, 0, height - 1, width, 1);
        if (width < m_plan.textureWidth && height < m_plan.textureHeight)
            gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, width, height, width - 1, height - 1, 1, 1);
    }

    void draw(std::span<const glm::vec4> triangles) {
        if (triangles.empty()) return;
        gl.VertexPointer(4, GL_FLOAT, 0, triangles.data());
        gl.DrawArrays(GL_TRIANGLES, 0, GLsizei(triangles.size()));
    }

    void colourMask(const ColourWrite& w) { gl.ColorMask(w.red, w.green, w.blue, w.alpha); }

    void state(const Pass& pass) {
        colourMask(pass.write);
        if (pass.depthTest || pass.depthWrite) {
            gl.Enable(GL_DEPTH_TEST);
            gl.DepthFunc(glEnum(pass.depthTest ? pass.depthFunction : Compare::Always));
        } else {
            gl.Disable(GL_DEPTH_TEST);
        }
        gl.DepthMask(pass.depthWrite);

        if (pass.blend.enabled) {
            gl.Enable(GL_BLEND);
            // The equation is an extension: a chip that only adds has no such call to make.
            if (pass.blend.equation != m_equation) gl.BlendEquation(glEnum(m_equation = pass.blend.equation));
            if (pass.blend.equation != BlendEquation::Min && pass.blend.equation != BlendEquation::Max)
                gl.BlendFunc(glEnum(pass.blend.source), glEnum(pass.blend.destination));
        } else {
            gl.Disable(GL_BLEND);
        }

        const Stencil& s = pass.stencil;
        if (!s.enabled) return gl.Disable(GL_STENCIL_TEST);
        gl.Enable(GL_STENCIL_TEST);
        gl.StencilFunc(glEnum(s.function), s.reference, ~0u);
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
    const FrameVolumes& m_volumes;
    BlendEquation m_equation = BlendEquation::Add;
    GLuint m_texture = 0;
};

/// Back to OpenGL's defaults, past all decorators.
void resetState(const GlTable& gl) {
    for (const GLenum what : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_BLEND, GL_CULL_FACE, GL_TEXTURE_2D})
        gl.Disable(what);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.Color4f(1, 1, 1, 1);
    gl.DisableClientState(GL_COLOR_ARRAY);
    gl.DisableClientState(GL_TEXTURE_COORD_ARRAY);
    gl.EnableClientState(GL_VERTEX_ARRAY);
}

std::vector<bool> readMask(Surface& surface, const Plan& plan) {
    switch (plan.maskPlace) {
        case MaskPlace::Stencil: {
            const Image stencil = readStencil(surface);
            return {stencil.data.begin(), stencil.data.end()};
        }
        case MaskPlace::Colour:
            return belowThreshold(readColour(surface), 0, plan.threshold);
        case MaskPlace::Alpha:
            return belowThreshold(readColour(surface, true), 3, plan.threshold);
        case MaskPlace::Texture:
        case MaskPlace::None:
            break;
    }
    return std::vector<bool>(std::size_t(plan.width) * plan.height);
}

/// The mask as it went over the scene: its texture over the whole window, by itself.
std::vector<bool> readMaskTexture(Surface& surface, const Plan& plan, const PassRunner& runner,
                                  MaskTexture format) {
    const GlTable& gl = surface.driver();
    resetState(gl);
    gl.Viewport(0, 0, plan.width, plan.height);
    runner.drawTextured(gl);
    return format == MaskTexture::Alpha ? belowThreshold(readColour(surface, true), 3, plan.threshold)
                                        : belowThreshold(readColour(surface), 0, plan.threshold);
}

}  // namespace

double threadCpuMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

Image readColour(Surface& surface, bool alpha) {
    return readPixels(surface, alpha ? GL_RGBA : GL_RGB, alpha ? 4 : 3);
}

Image readStencil(Surface& surface) {
    return readPixels(surface, GL_STENCIL_INDEX, 1);
}

Rendered render(Surface& surface, const Profile& profile, const Plan& plan, const FrameSurfaces& surfaces,
                const FrameVolumes& volumes, const AfterPass& afterPass) {
    surface.makeCurrent();
    const GlTable& driver = surface.driver();
    resetState(driver);
    while (driver.GetError() != GL_NO_ERROR) {
    }

    Counter counter;
    const GlTable gl = counter.count(restrictTo(profile, surface.format(), driver));
    PassRunner runner(gl, plan, surfaces, volumes);
    Rendered out;
    MaskTexture maskTexture = MaskTexture::None;
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const double start = threadCpuMs();
        runner.run(plan.passes[i]);
        if (i + 1 == plan.passes.size() || i + 1 == plan.maskReady || afterPass) gl.Finish();
        out.cpuMs += threadCpuMs() - start;
        if (const GLenum error = driver.GetError(); error != GL_NO_ERROR)
            throw std::runtime_error(
                fmt::format("OpenGL error 0x{:04x} in pass {}: {}", error, i + 1, plan.passes[i].label));
        if (plan.passes[i].kind == PassKind::Copy) maskTexture = plan.passes[i].texture;
        if (i + 1 == plan.maskReady) out.maskShadow = readMask(surface, plan);
        if (afterPass) afterPass(i);
    }
    out.image = readColour(surface);
    out.counts = counter.counts();
    if (out.maskShadow.empty()) out.maskShadow = readMask(surface, plan);
    if (plan.maskPlace == MaskPlace::Texture)
        out.maskShadow = readMaskTexture(surface, plan, runner, maskTexture);
    return out;
}

}  // namespace gnomon
