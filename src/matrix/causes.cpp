#include "matrix/causes.h"

#include <algorithm>

namespace gnomon {
namespace {

/// Faces of one volume in front of the visible surface, per pixel, rows from the top.
struct FaceCounts {
    std::vector<int> fronts{}, backs{};
};

/// Counts faces by adding 1 of 255 to a colour: fronts in red, backs in green. Any depth format goes with
/// that.
class FaceCounter {
  public:
    FaceCounter(const View& view, const FrameSurfaces& surfaces, int depthBits)
        : m_surface({.depth = depthBits, .stencil = 0}, view.width, view.height) {
        const GlTable& gl = m_surface.driver();
        gl.Viewport(0, 0, view.width, view.height);
        gl.ClearColor(0, 0, 0, 0);
        gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl.Enable(GL_DEPTH_TEST);
        gl.EnableClientState(GL_VERTEX_ARRAY);
        gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        draw(surfaces.positions);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_FALSE, GL_FALSE);
        gl.DepthMask(GL_FALSE);
        gl.DepthFunc(GL_LEQUAL);
        gl.Enable(GL_BLEND);
        gl.BlendFunc(GL_ONE, GL_ONE);
        gl.Enable(GL_CULL_FACE);
    }

    FaceCounts count(std::span<const glm::vec4> volume) {
        const GlTable& gl = m_surface.driver();
        gl.Clear(GL_COLOR_BUFFER_BIT);
        gl.Color4f(1 / 255.0f, 0, 0, 0);
        gl.CullFace(GL_BACK);
        draw(volume);
        gl.Color4f(0, 1 / 255.0f, 0, 0);
        gl.CullFace(GL_FRONT);
        draw(volume);
        const Image colour = readColour(m_surface);
        FaceCounts counts;
        for (std::size_t i = 0; i < colour.data.size(); i += 3) {
            counts.fronts.push_back(colour.data[i]);
            counts.backs.push_back(colour.data[i + 1]);
        }
        return counts;
    }

  private:
    void draw(std::span<const glm::vec4> triangles) {
        m_surface.driver().VertexPointer(4, GL_FLOAT, 0, triangles.data());
        m_surface.driver().DrawArrays(GL_TRIANGLES, 0, GLsizei(triangles.size()));
    }

    Surface m_surface;
};

/// Which pixels a mask of limited range calls a shadow, after the fronts and then the backs of each volume.
/// In steps of a factor of 2 away from the value of a lit pixel: doubling clamps at 1, which is @p range
/// steps up; halving ends at the lowest code, @p range steps down.
std::vector<bool> limitedMask(const View& view, const FrameSurfaces& surfaces, const FrameVolumes& volumes,
                              int depthBits, int range) {
    FaceCounter counter(view, surfaces, depthBits);
    std::vector<int> steps(std::size_t(view.width) * view.height);
    for (std::size_t v = 0; v < volumes.size(); ++v) {
        const FaceCounts faces = counter.count(volumes[v]);
        for (std::size_t i = 0; i < steps.size(); ++i)
            steps[i] = std::min(steps[i] + faces.fronts[i], range) - faces.backs[i];
    }
    std::vector<bool> shadow(steps.size());
    std::transform(steps.begin(), steps.end(), shadow.begin(), [](int s) { return s > 0; });
    return shadow;
}

}  // namespace

std::map<std::string, int> causesOf(const Judgement& judgement, const Truth& truth, const Axes& axes,
                                    const View& view, const FrameSurfaces& surfaces,
                                    const FrameVolumes& volumes, bool eyeInVolume, int depthBits,
                                    int maskBits) {
    if (judgement.wrong() == 0) return {};
    if (axes.store == Store::None) return {{"no shadow is drawn", judgement.wrong()}};
    if (axes.count == Count::Zpass && eyeInVolume) return {{"eye inside a volume", judgement.wrong()}};

    std::map<std::string, int> causes;
    const auto each = [&](const auto& causeOf) {
        for (std::size_t i = 0; i < judgement.pixels.size(); ++i) {
            const PixelVerdict verdict = judgement.pixels[i];
            if (verdict == PixelVerdict::WrongEdge || verdict == PixelVerdict::WrongInterior)
                ++causes[causeOf(i)];
        }
    };
    const std::string rest = axes.maskDivisor > 1 ? "low mask resolution" : "unexplained";
    if (axes.arithmetic != Arithmetic::Count) {
        const bool doubles = axes.arithmetic == Arithmetic::Double;
        const std::vector<bool> mask =
            limitedMask(view, surfaces, volumes, depthBits, doubles ? axes.levels : maskBits);
        const std::string limit = doubles ? "mask clamps" : "mask underflows";
        each([&](std::size_t i) { return mask[i] != truth.blocked[i] ? limit : rest; });
        return causes;
    }
    each([&](std::size_t) { return rest; });
    return causes;
}

}  // namespace gnomon
