#include "volume/frame_volumes.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "volume/near_cap.h"

namespace gnomon {
namespace {

/// Cuts triangles at the sides of the window, a quarter pixel outside of the outermost pixel centres, so that
/// OpenGL has nothing to clip. llvmpipe culls what it clips by another sign of the area than what it
/// rasterises, and a sliver may fall out of the pass for front faces and of that for back faces too.
///
/// Faces that share an edge to the bit share its cut point to the bit: it is computed from the edge's ends in
/// one order, in double precision, and rounded once.
class WindowClip {
  public:
    explicit WindowClip(const View& view) : m_limits{1 - 0.5 / view.width, 1 - 0.5 / view.height} {}

    void append(std::span<const glm::vec4> triangles, std::vector<glm::vec4>& out) {
        for (std::size_t i = 0; i + 3 <= triangles.size(); i += 3) {
            const auto triangle = triangles.subspan(i, 3);
            if (isInside(triangle)) {
                out.insert(out.end(), triangle.begin(), triangle.end());
                continue;
            }
            m_polygon.assign(triangle.begin(), triangle.end());
            for (const int axis : {0, 1})
                for (const double sign : {1.0, -1.0}) cut(axis, sign);
            for (std::size_t k = 2; k < m_polygon.size(); ++k)
                out.insert(out.end(), {m_polygon[0], m_polygon[k - 1], m_polygon[k]});
        }
    }

  private:
    double height(const glm::vec4& p, int axis, double sign) const {
        return m_limits[axis] * p.w - sign * p[axis];
    }

    bool isInside(std::span<const glm::vec4> triangle) const {
        return std::all_of(triangle.begin(), triangle.end(), [&](const glm::vec4& p) {
            return std::abs(p.x) <= m_limits[0] * p.w && std::abs(p.y) <= m_limits[1] * p.w;
        });
    }

    glm::vec4 cutPoint(glm::vec4 a, glm::vec4 b, int axis, double sign) const {
        if (std::tie(b.x, b.y, b.z, b.w) < std::tie(a.x, a.y, a.z, a.w)) std::swap(a, b);
        const double ha = std::abs(height(a, axis, sign)), hb = std::abs(height(b, axis, sign));
        const double u = ha / (ha + hb), v = hb / (ha + hb);
        return glm::vec4(v * glm::dvec4(a) + u * glm::dvec4(b));
    }

    /// Keeps what lies within the limit on one side of the window.
    void cut(int axis, double sign) {
        m_kept.clear();
        for (std::size_t i = 0; i < m_polygon.size(); ++i) {
            const glm::vec4 &a = m_polygon[i], &b = m_polygon[(i + 1) % m_polygon.size()];
            const bool aInside = height(a, axis, sign) >= 0, bInside = height(b, axis, sign) >= 0;
            if (aInside) m_kept.push_back(a);
            if (aInside != bInside) m_kept.push_back(cutPoint(a, b, axis, sign));
        }
        m_polygon.swap(m_kept);
    }

    double m_limits[2];
    std::vector<glm::vec4> m_polygon{}, m_kept{};
};

}  // namespace

FrameVolumes frameVolumes(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                          const View& view, bool nearCap) {
    FrameVolumes volumes;
    WindowClip clip(view);
    const auto append = [&](const LitCaster& one) {
        const NearCut cut = cutAtNearPlane(scene, one, light, view);
        auto& v = volumes.vertices;
        clip.append(cut.fronts, v);
        clip.append(cut.backs, v);
        if (nearCap && !cut.cap.empty() && touchesNearRectangle(scene, one, light, view))
            clip.append(cut.cap, v);
        if (v.size() > volumes.begins.back()) volumes.begins.push_back(v.size());
    };
    for (const LitCaster& caster : lit) {
        if (caster.lit.empty()) continue;
        if (!caster.perTriangle) {
            append(caster);
            continue;
        }
        for (std::size_t i = 0; i < caster.lit.size(); ++i) {
            const auto sides = caster.sides.begin() + std::ptrdiff_t(3 * i);
            append({.object = caster.object,
                    .lit = {caster.lit[i]},
                    .sides = {sides, sides + 3},
                    .perTriangle = true});
        }
    }
    return volumes;
}

bool eyeInVolume(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                 const View& view) {
    return std::any_of(lit.begin(), lit.end(),
                       [&](const LitCaster& c) { return touchesNearRectangle(scene, c, light, view); });
}

}  // namespace gnomon
