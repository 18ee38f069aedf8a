// What a mask of half the size saves: frames of roettger-screen beside frames of roettger-half, whole and
// warm; and the same two frames as the fewest bare calls on the driver that draw these passes, which bounds
// what the first can come to on this driver.
#include <memory>

#include "bench/speed/easel.h"
#include "bench/speed/speed_row.h"
#include "gl/pass_state.h"
#include "gl/stopwatch.h"
#include "method/builder.h"

namespace gnomon {
namespace {

constexpr float kCorners[]{-1, -1, 1, -1, 1, 1, -1, 1};
constexpr float kFarCorners[]{-1, -1, 1, 1, 1, -1, 1, 1, 1, 1, 1, 1, -1, 1, 1, 1};
constexpr float kWhole[]{0, 0, 1, 0, 1, 1, 0, 1};
constexpr GLbitfield kAllBuffers = GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT;

Round halfMask(Load load) {
    const int side = load == Load::Full ? 1024 : 32;
    const auto easel = std::make_shared<Easel>(shippedScene("roettger"), side, side);
    const Plan full = easel->plan("roettger-screen"), half = easel->plan("roettger-half");
    return [=] {
        Measured times{.ours = easel->frameMs(half), .beside = easel->frameMs(full)};
        times.figure = times.beside / times.ours;
        return times;
    };
}

/// The passes of these two plans as calls: no layer, no objects that are looked up, all buffers cleared at
/// once.
class BareFrames {
  public:
    BareFrames(Easel& easel, int side) : m_easel(easel), m_side(side), gl(easel.surface().driver()) {
        begin();
        gl.GenTextures(1, &m_texture);
        gl.BindTexture(GL_TEXTURE_2D, m_texture);
        for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
        for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
            gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
        gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
        gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, side / 2, side / 2, 0);
    }

    double fullMs() {
        return msOf([&] {
            mask();
            gl.Enable(GL_DEPTH_TEST);
            backdrop();
            scene();
        });
    }

    double halfMs() {
        return msOf([&] {
            gl.Viewport(0, 0, m_side / 2, m_side / 2);
            mask();
            gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, m_side / 2, m_side / 2);
            gl.Viewport(0, 0, m_side, m_side);
            clear();
            gl.Disable(GL_BLEND);
            gl.Enable(GL_DEPTH_TEST);
            gl.DepthMask(GL_TRUE);
            scene();
            gl.Disable(GL_DEPTH_TEST);
            gl.Enable(GL_BLEND);
            gl.BlendFunc(GL_ZERO, GL_SRC_COLOR);
            gl.Enable(GL_TEXTURE_2D);
            gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
            gl.TexCoordPointer(2, GL_FLOAT, 0, kWhole);
            rectangle();
            gl.DisableClientState(GL_TEXTURE_COORD_ARRAY);
            gl.Disable(GL_TEXTURE_2D);
        });
    }

  private:
    void begin() {
        m_easel.surface().makeCurrent();
        resetState(gl);
        gl.Viewport(0, 0, m_side, m_side);
        gl.ClearColor(0.25f, 0.25f, 0.25f, 1);
    }

    template <class Draw>
    double msOf(const Draw& draw) {
        double ms = 0;
        for (int i = 0; i < 2; ++i) {  // the first is not timed
            begin();
            const double start = threadCpuMs();
            draw();
            gl.Finish();
            ms = threadCpuMs() - start;
        }
        return ms;
    }

    /// Depth, volumes and the three rectangles; leaves blending by the mask.
    void mask() {
        clear();
        gl.Enable(GL_DEPTH_TEST);
        gl.DepthFunc(GL_LEQUAL);
        gl.DepthMask(GL_TRUE);
        gl.ColorMask(0, 0, 0, 0);
        const auto& positions = m_easel.frame().surfaces.positions;
        gl.VertexPointer(4, GL_FLOAT, 0, positions.data());
        gl.DrawArrays(GL_TRIANGLES, 0, GLsizei(positions.size()));
        gl.ColorMask(1, 1, 1, 0);
        gl.DepthMask(GL_FALSE);
        gl.Enable(GL_BLEND);
        gl.Enable(GL_CULL_FACE);
        const FrameVolumes& volumes = m_easel.frame().volumes();
        for (std::size_t i = 0; i < volumes.size(); ++i) {
            for (const bool front : {true, false}) {
                gl.CullFace(front ? GL_BACK : GL_FRONT);
                gl.BlendFunc(GL_DST_COLOR, front ? GL_ONE : GL_ZERO);
                grey(front ? 1 : kHalf);
                for (const Part part : {Part::Sides, Part::FarCap, Part::NearCap}) {
                    const FrameVolumes::Runs& runs = volumes.parts[std::size_t(part)];
                    gl.VertexPointer(4, GL_FLOAT, 0, runs.vertices.data());
                    gl.DrawArrays(GL_TRIANGLES, GLint(runs.begins[i]),
                                  GLsizei(runs.begins[i + 1] - runs.begins[i]));
                }
            }
        }
        gl.Disable(GL_CULL_FACE);
        gl.Disable(GL_DEPTH_TEST);
        gl.BlendFunc(GL_DST_COLOR, GL_ONE);
        grey(1);
        rectangle();
        gl.BlendFunc(GL_ONE_MINUS_DST_COLOR, GL_ZERO);
        rectangle();
        gl.BlendFunc(GL_ONE, GL_ONE);
        grey(kHalf);
        rectangle();
        gl.BlendFunc(GL_DST_COLOR, GL_ZERO);
    }

    void scene() {
        const LightFrames lights = m_easel.frame().lights();
        gl.EnableClientState(GL_COLOR_ARRAY);
        gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, lights(0).colours->lit.data());
        const auto& positions = m_easel.frame().surfaces.positions;
        gl.VertexPointer(4, GL_FLOAT, 0, positions.data());
        gl.DrawArrays(GL_TRIANGLES, 0, GLsizei(positions.size()));
        gl.DisableClientState(GL_COLOR_ARRAY);
    }

    /// What lies at infinity, under the mask too.
    void backdrop() {
        grey(kHalf);
        gl.VertexPointer(4, GL_FLOAT, 0, kFarCorners);
        gl.DrawArrays(GL_QUADS, 0, 4);
    }

    void rectangle() {
        gl.VertexPointer(2, GL_FLOAT, 0, kCorners);
        gl.DrawArrays(GL_QUADS, 0, 4);
    }

    void clear() {
        gl.DepthMask(GL_TRUE);
        gl.ColorMask(1, 1, 1, 1);
        gl.Clear(kAllBuffers);
        gl.ColorMask(1, 1, 1, 0);
    }

    void grey(float value) { gl.Color4f(value, value, value, value); }

    Easel& m_easel;
    const int m_side;
    const GlTable& gl;
    GLuint m_texture = 0;
};

Round bareHalfMask(Load load) {
    const int side = load == Load::Full ? 1024 : 32;
    const auto easel = std::make_shared<Easel>(shippedScene("roettger"), side, side);
    const auto bare = std::make_shared<BareFrames>(*easel, side);
    return [easel, bare] {
        Measured times{.ours = bare->halfMs(), .beside = bare->fullMs()};
        times.figure = times.beside / times.ours;
        return times;
    };
}

}  // namespace

std::vector<SpeedRow> halfRows() {
    return {{.name = "HalfMask/roettger",
             .what = "full mask over half mask, 1024x1024 (paper: 1.54)",
             .bar = Bar::AtLeast,
             .target = 1.5,
             .unit = "x",
             .sides = "ms",
             .prepare = halfMask},
            {.name = "HalfMask/bare",
             .what = "the same passes as bare calls on the driver",
             .bar = Bar::None,
             .unit = "x",
             .sides = "ms",
             .prepare = bareHalfMask}};
}

}  // namespace gnomon
