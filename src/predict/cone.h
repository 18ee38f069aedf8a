#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "predict/window_line.h"
#include "scene/view.h"
#include "truth/predicates.h"
#include "volume/clip_space.h"

namespace gnomon {

/// A direction as the exact difference of two points.
struct Difference {
    glm::dvec3 to{}, from{};
    glm::dvec3 value() const { return to - from; }
};

/// Window position of a point, given from the eye of a view of parallel rays.
inline glm::dvec2 parallelPosition(const View& view, const glm::dvec3& fromEye) {
    return {(glm::dot(fromEye, view.right) / view.tanHalfX + 1) / 2 * view.width,
            (glm::dot(fromEye, view.up) / view.tanHalfY + 1) / 2 * view.height};
}

/// A convex face as the eye sees it: the directions in which it lies, a cone. A corner at infinity is its
/// direction. Nothing is cut and nothing divided, so that faces which reach behind the eye or to infinity are
/// like all others: the ray along d crosses the face if d is a sum of its corners' directions with positive
/// weights.
class Cone {
  public:
    /// The triangle between three points, counter-clockwise seen from its front.
    static Cone triangle(const View& view, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

    /// The triangle as parallel rays see it, those of a directional light's map (LightMap): not by
    /// directions, but by its corners in the map. Whether it holds a border is not exact.
    static Cone parallel(const View& view, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

    /// The side that hangs from an edge away from the light, wound as sideFace() has it.
    static Cone side(const View& view, const glm::dvec3& from, const glm::dvec3& to, const glm::dvec4& light);

    /// The far cap of a lit triangle, in the plane at infinity; a back face.
    /// @pre a point light
    static Cone farCap(const View& view, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                       const glm::dvec4& light);

    /// The part of the near rectangle that a lit triangle hides from the light; a front face.
    static Cone nearCap(const View& view, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                        const glm::vec4& light);

    /// The eye lies in its plane, or it has no area: no ray crosses it.
    bool isEmpty() const { return m_borders.size() == 0; }
    bool isFront() const { return m_front; }

    /// 1 / distance along forward, over the window; 0 at infinity. Parallel rays: 1 - window depth.
    const WindowLine& inverseDistance() const { return m_inverse; }

    /// How far inside of its borders a window position lies, in pixels; negative outside.
    double inside(double x, double y) const {
        double least = std::numeric_limits<double>::infinity();
        for (const Border& border : m_borders) least = std::min(least, border.line.at(x, y));
        return least;
    }

    /// Bound on the rounding of inside().
    double insideError() const { return m_error; }

    /// Whether the ray through the window position crosses the face: exact. A ray through a border counts as
    /// turned a little, always in the same way (truth/predicates.h, edgeSide()).
    bool holds(const EyeRay& ray, double x, double y) const;

    /// Whether one of the borders leaves the whole window out, by more than @p slack pixels.
    bool missesWindow(int width, int height, double slack) const;

    /// The columns of the row of pixels whose centres have the height @p y that may lie within @p slack
    /// pixels of the inside: [first, second).
    std::pair<int, int> columns(double y, double slack, int width) const;

    /// 1 / distance of the face's plane along the ray, exact.
    /// @pre neither a far cap nor a near cap
    Rational exactInverse(const EyeRay& ray) const;

  private:
    /// Inside where (u x v) . direction has the sign.
    struct Border {
        Difference u{}, v{};
        int sign = 1;
        WindowLine line{};  ///< the same in pixels, positive inside
    };

    void addBorder(const View& view, const Difference& u, const Difference& v, int sign);
    void addLine(const View& view, Border border, WindowLine line, double error);
    void setPlane(const View& view, const Difference& u, const Difference& v, const Difference& base);

    Few<Border, 4> m_borders{};
    bool m_front = false, m_parallel = false;
    double m_error = 0;
    WindowLine m_inverse{};
    Difference m_planeU{}, m_planeV{}, m_planeBase{};  ///< normal u x v; a point of it, from the eye
    /// Near caps: the lit triangle.
    std::optional<LitTriangle> m_lit{};
    glm::dvec4 m_light{};
    double m_near = 0;
};

}  // namespace gnomon
