#include "gl/pass_runner.h"

#include <fmt/format.h>

#include <array>
#include <cassert>

#include "gl/darkened.h"

namespace gnomon {
namespace {

constexpr std::array<float, 8> kWindow{-1, -1, 1, -1, 1, 1, -1, 1};

/// The background as it is drawn, whether by a clear or by a surface at infinity.
glm::u8vec3 bytesOf(const glm::vec3& colour) {
    return glm::u8vec3(glm::clamp(colour, 0.0f, 1.0f) * 255.0f + 0.5f);
}

/// The colours of the shadings that are made of others.
std::vector<VertexColour> mixedColours(Shading shading, std::size_t vertices,
                                       const std::vector<VertexColour>& diffuse) {
    if (shading == Shading::Black) return std::vector<VertexColour>(vertices, VertexColour(0, 0, 0, 255));
    std::vector<VertexColour> colours = diffuse;
    for (VertexColour& colour : colours) {
        for (int k = 0; k < 3; ++k) {
            const int half = colour[k] / 2;
            colour[k] = std::uint8_t(shading == Shading::HalfDiffuse ? half : colour[k] - half);
        }
    }
    return colours;
}

}  // namespace

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

PassRunner::PassRunner(const GlTable& table, Surface& surface, const Profile& profile, const Plan& plan,
                       const FrameSurfaces& surfaces, const LightFrames& lights, VertexSource source)
    : gl(table),
      m_kept(surface.objects()),
      m_chip(profile.id),
      m_free(freeChannels(plan, profile, surface.format())),
      m_plan(plan),
      m_surfaces(surfaces),
      m_lights(lights),
      m_programs(gl, surface.programs(), m_chip + "/"),
      m_state(gl),
      m_arrays(gl, m_kept, source) {}

void PassRunner::run(const Pass& pass) {
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
    m_state.bound(scissorOf(pass, m_plan.windows));
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

/// Free channels are cleared with what lies in the same words.
void PassRunner::clear(const Pass& pass) {
    ColourWrite write = pass.write;
    if (m_free.alpha && write == kWriteColour) write.alpha = true;
    const bool withStencil = m_free.stencil && pass.clearsDepth && pass.target != Target::DepthMap;
    m_state.colourMask(write);
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
        m_state.stencilMask(pass.stencil.writeMask);
        gl.ClearStencil(pass.stencilIsBlockers ? m_blockers : pass.stencilValue);
        bits |= GL_STENCIL_BUFFER_BIT;
    }
    if (withStencil) bits |= GL_STENCIL_BUFFER_BIT;
    gl.Clear(bits);
}

void PassRunner::scene(const Pass& pass) {
    m_state.set(pass, reference(pass.stencil));
    gl.Disable(GL_CULL_FACE);
    if (pass.target == Target::DepthMap)
        return draw(fmt::format("map {}", pass.mapFace), pass.light,
                    m_lights(pass.light).depthMap.faces[std::size_t(pass.mapFace)]);
    if (!pass.write.any()) return drawSurfaces();
    if (pass.shading == Shading::Mask) return depthMapMask(pass);

    if (pass.program == Program::ShadeCount) m_programs.useShadeCount(float(m_plan.shadowShare));
    gl.EnableClientState(GL_COLOR_ARRAY);
    // What lies at infinity takes part wherever the scene meets a mask that stands in the colour buffer.
    if (drawsBackdrop(pass)) backdrop(pass.blackBackdrop ? glm::vec3(0) : m_surfaces.background);
    colours(pass);
    gl.DisableClientState(GL_COLOR_ARRAY);
    // Where a colour array is enabled and nothing drawn, Mesa forgets that the colour has changed.
    if (m_surfaces.positions.empty()) gl.Color4f(0, 0, 0, 0);
    if (pass.program != Program::None) m_programs.useNone();
}

void PassRunner::colours(const Pass& pass) {
    constexpr int kNoLight = VertexArrays::kNoLight;
    const auto& frame = m_surfaces;
    switch (pass.shading) {
        case Shading::Lit:
            m_arrays.colours("lit", pass.light, m_lights(pass.light).colours->lit);
            return drawSurfaces();
        case Shading::Diffuse:
            m_arrays.colours("diffuse", pass.light, m_lights(pass.light).colours->diffuse);
            return drawSurfaces();
        case Shading::Ambient:
            m_arrays.colours("ambient", kNoLight, frame.ambient);
            return drawSurfaces();
        default:
            break;
    }
    std::vector<VertexColour> mixed;
    if (pass.shading == Shading::Black)
        mixed = mixedColours(pass.shading, frame.positions.size(), {});
    else if (pass.shading == Shading::HalfDiffuse || pass.shading == Shading::RestDiffuse)
        mixed = mixedColours(pass.shading, frame.positions.size(), m_lights(pass.light).colours->diffuse);
    m_arrays.changed("mixed");
    m_arrays.colours("mixed", kNoLight, mixed);
    drawSurfaces();
}

/// The background as a surface at infinity: depth 1, z = w.
void PassRunner::backdrop(const glm::vec3& background) {
    static constexpr std::array<glm::vec4, 6> kCorners{glm::vec4{-1, -1, 1, 1}, {1, -1, 1, 1}, {1, 1, 1, 1},
                                                       glm::vec4{-1, -1, 1, 1}, {1, 1, 1, 1},  {-1, 1, 1, 1}};
    std::array<VertexColour, 6> colours;
    colours.fill(VertexColour(bytesOf(background), 255));
    gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, colours.data());
    gl.VertexPointer(4, GL_FLOAT, 0, kCorners.data());
    drawRange(0, kCorners.size());
}

void PassRunner::volume(const Pass& pass) {
    m_state.set(pass, reference(pass.stencil));
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
        draw("blockers", pass.light, light.blockers);
        std::uint8_t count = 0;
        gl.ReadPixels(0, 0, 1, 1, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, &count);
        m_blockers = count;
    } else if (pass.drawn == Drawn::Silhouettes) {
        const auto blockers = m_programs.drawSilhouettes(light.silhouettes, m_plan.clip, pass.countsBlockers);
        if (blockers) m_blockers = *blockers;
        m_programs.useNone();
    } else if (pass.extent == Extent::Volumes && pass.volume == kAllVolumes) {
        eachInItsWindow(pass, *light.volumes);
    } else {
        for (int part = 0; part < kParts; ++part) {
            if (!pass.parts.has(Part(part))) continue;
            const FrameVolumes::Runs& runs = light.volumes->parts[std::size_t(part)];
            volumeRuns(*light.volumes, pass.light, part);
            if (pass.volume == kAllVolumes)
                drawRange(0, runs.vertices.size());
            else
                drawRange(runs.begins[std::size_t(pass.volume)], runs.begins[std::size_t(pass.volume) + 1]);
        }
    }
    if (pass.program == Program::CountFaces) m_programs.useNone();
    if (pass.depthClamp) gl.Disable(GL_DEPTH_CLAMP);
}

/// All volumes, each under its own scissor; neighbours that share one are drawn at once.
void PassRunner::eachInItsWindow(const Pass& pass, const FrameVolumes& volumes) {
    const std::vector<WindowRect>& windows = m_plan.windows[std::size_t(pass.light)].volumes;
    assert(windows.size() == volumes.size());
    bool drawsAny = false;
    std::size_t first = 0, end = 0;
    for (; first < windows.size(); first = end) {
        for (end = first + 1; end < windows.size() && windows[end] == windows[first];) ++end;
        if (windows[first].empty()) continue;
        m_state.scissor(windows[first]);
        for (int part = 0; part < kParts; ++part) {
            if (!pass.parts.has(Part(part))) continue;
            const FrameVolumes::Runs& runs = volumes.parts[std::size_t(part)];
            volumeRuns(volumes, pass.light, part);
            drawRange(runs.begins[first], runs.begins[end]);
        }
        drawsAny = true;
    }
    if (!drawsAny) draw("nothing", VertexArrays::kNoLight, {});
}

void PassRunner::rectangle(const Pass& pass) {
    m_state.set(pass, reference(pass.stencil));
    if (m_darkened && multipliesByMask(pass)) m_state.bound(m_darkened);
    gl.Disable(GL_CULL_FACE);
    gl.Color4f(pass.colour.r, pass.colour.g, pass.colour.b, pass.colour.a);
    if (pass.texture != MaskTexture::None) return fillWith(gl, pass.frameTexture ? m_frame : m_mask);
    gl.VertexPointer(2, GL_FLOAT, 0, kWindow.data());
    gl.DrawArrays(GL_QUADS, 0, 4);
}

/// Copies the mask, or the frame. Where the texture is larger, the last row, column and corner are copied
/// once more beside it, so that bilinear filtering clamps at the edge.
void PassRunner::copy(const Pass& pass) {
    const GLenum format = pass.texture == MaskTexture::Alpha       ? GL_ALPHA
                          : pass.texture == MaskTexture::Intensity ? GL_INTENSITY
                                                                   : GL_RGB;
    const bool ofFrame = pass.frameTexture;
    const int width = ofFrame ? m_plan.width : m_plan.maskWidth,
              height = ofFrame ? m_plan.height : m_plan.maskHeight;
    const int textureWidth = ofFrame ? m_plan.frameTextureWidth : m_plan.textureWidth,
              textureHeight = ofFrame ? m_plan.frameTextureHeight : m_plan.textureHeight;
    const bool fits = width == textureWidth && height == textureHeight;
    if (!ofFrame) {
        m_darkened.reset();
        if (m_leavesOutLit && !pass.nearest) m_darkened = darkenedPart(gl, m_plan, pass.texture);
    }
    const auto [name, isNew] =
        m_kept.texture(gl, fmt::format("{}/{} {:#x} {}x{}{}", m_chip, ofFrame ? "frame" : "mask", format,
                                       textureWidth, textureHeight, fits ? "" : ", in part"));
    (ofFrame ? m_frame : m_mask) = {name, float(width) / float(textureWidth),
                                    float(height) / float(textureHeight)};
    gl.BindTexture(GL_TEXTURE_2D, name);
    const GLint filter = pass.nearest ? GL_NEAREST : GL_LINEAR;
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    // Storage that is there already is copied into.
    if (isNew && fits) return gl.CopyTexImage2D(GL_TEXTURE_2D, 0, format, 0, 0, width, height, 0);
    if (isNew) {
        const GLenum base = pass.texture == MaskTexture::Intensity ? GL_LUMINANCE : format;
        gl.TexImage2D(GL_TEXTURE_2D, 0, GLint(format), textureWidth, textureHeight, 0, base, GL_UNSIGNED_BYTE,
                      nullptr);
    }
    gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, width, height);
    if (width < textureWidth) gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, width, 0, width - 1, 0, 1, height);
    if (height < textureHeight) gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, height, 0, height - 1, width, 1);
    if (width < textureWidth && height < textureHeight)
        gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, width, height, width - 1, height - 1, 1, 1);
}

/// One face of a light's depth map.
GLuint PassRunner::mapOf(int light, int face) {
    const auto [map, isNew] = m_kept.texture(
        gl, fmt::format("{}/depth map {}.{} {}x{}", m_chip, light, face, m_plan.mapSize, m_plan.mapSize));
    if (isNew) {
        gl.BindTexture(GL_TEXTURE_2D, map);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, m_plan.mapSize, m_plan.mapSize, 0,
                      GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    }
    return map;
}

/// Makes it the buffer that is drawn to.
void PassRunner::bindMap(const Pass& pass) {
    const GLuint map = mapOf(pass.light, pass.mapFace);
    gl.BindFramebuffer(GL_FRAMEBUFFER, m_kept.framebuffer(gl, m_chip + "/depth maps").name);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map, 0);
    gl.DrawBuffer(GL_NONE);
}

void PassRunner::depthMapMask(const Pass& pass) {
    const DepthMapFrame& map = m_lights(pass.light).depthMap;
    for (std::size_t f = 0; f < map.faces.size(); ++f) {
        gl.ActiveTexture(GLenum(GL_TEXTURE0 + f));
        gl.BindTexture(GL_TEXTURE_2D, mapOf(pass.light, int(f)));
    }
    gl.ActiveTexture(GL_TEXTURE0);
    m_programs.useDepthMap(map, m_plan.mapSize, m_plan.mapBias, float(m_plan.shadowShare));
    gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
    m_arrays.coordinates("seen from the light", pass.light, map.coordinates);
    drawSurfaces();
    gl.DisableClientState(GL_TEXTURE_COORD_ARRAY);
    m_programs.useNone();
}

void PassRunner::drawSurfaces() {
    draw("surfaces", VertexArrays::kNoLight, m_surfaces.positions);
}

void PassRunner::draw(const std::string& name, int light, std::span<const glm::vec4> triangles) {
    m_arrays.positions(name, light, triangles);
    drawRange(0, triangles.size());
}

void PassRunner::volumeRuns(const FrameVolumes& volumes, int light, int part) {
    m_arrays.positions(fmt::format("volumes' part {}", part), light, volumes.all(Part(part)));
}

void PassRunner::drawRange(std::size_t begin, std::size_t end) {
    gl.DrawArrays(GL_TRIANGLES, GLint(begin), GLsizei(end - begin));
}

}  // namespace gnomon
