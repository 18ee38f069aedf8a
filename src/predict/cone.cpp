#include "predict/cone.h"

#include <cmath>
#include <tuple>

#include "volume/orient.h"

namespace gnomon {
namespace {

constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

/// Length of the longest ray direction of the window.
double longestRay(const View& view) {
    return 1 + view.tanHalfX + view.tanHalfY;
}

struct Exact3 {
    Rational x, y, z;
};

Exact3 exactly(const glm::dvec3& v) {
    return {Rational(v.x), Rational(v.y), Rational(v.z)};
}
Exact3 exactly(const Difference& d) {
    return {Rational(d.to.x) - Rational(d.from.x), Rational(d.to.y) - Rational(d.from.y),
            Rational(d.to.z) - Rational(d.from.z)};
}
Exact3 cross(const Exact3& a, const Exact3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Rational dot(const Exact3& a, const Exact3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Sign of (u x v) . direction, never 0 unless u and v are parallel; as edgeSide() turns the ray.
int exactSide(const Difference& u, const Difference& v, const glm::dvec3& direction) {
    const Exact3 normal = cross(exactly(u), exactly(v));
    if (const int sign = dot(normal, exactly(direction)).sign()) return sign;
    const glm::dvec3 size = glm::abs(direction);
    const int main = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int signs[3] = {normal.x.sign(), normal.y.sign(), normal.z.sign()};
    if (signs[(main + 1) % 3] != 0) return signs[(main + 1) % 3];
    return signs[(main + 2) % 3];
}

}  // namespace

void Cone::addLine(const View& view, Border border, WindowLine line, double error) {
    const double slope = line.slope();
    if (slope > 0) {
        line = {line.x / slope, line.y / slope, line.c / slope};
        m_error = std::max(m_error, error / slope);
    } else {
        // The same side of the border over the whole window.
        line = {0, 0, line.at(view.width / 2.0, view.height / 2.0) >= 0 ? 1e300 : -1e300};
    }
    border.line = line;
    m_borders.push_back(border);
}

void Cone::addBorder(const View& view, const Difference& u, const Difference& v, int sign) {
    const glm::dvec3 a = u.value(), b = v.value();
    const WindowLine line = alongRays(view, double(sign) * glm::cross(a, b));
    addLine(view, {u, v, sign, {}}, line, kRounding * glm::length(a) * glm::length(b) * longestRay(view));
}

void Cone::setPlane(const View& view, const Difference& u, const Difference& v, const Difference& base) {
    m_planeU = u, m_planeV = v, m_planeBase = base;
    const glm::dvec3 normal = glm::cross(u.value(), v.value());
    const double height = glm::dot(normal, base.value());
    const WindowLine line = alongRays(view, normal);
    m_inverse = {line.x / height, line.y / height, line.c / height};
}

Cone Cone::triangle(const View& view, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    Cone cone;
    const int facing = orientation(a, b, c, view.eye);
    if (facing == 0) return cone;
    cone.m_front = facing > 0;
    const Difference corners[3] = {{a, view.eye}, {b, view.eye}, {c, view.eye}};
    for (int k = 0; k < 3; ++k) cone.addBorder(view, corners[k], corners[(k + 1) % 3], -facing);
    cone.setPlane(view, {b, a}, {c, a}, corners[0]);
    return cone;
}

Cone Cone::parallel(const View& view, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    Cone cone;
    cone.m_parallel = true;
    const glm::dvec3 corners[3] = {a - view.eye, b - view.eye, c - view.eye};
    glm::dvec2 p[3];
    double inverse[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = parallelPosition(view, corners[k]);
        inverse[k] = 1 - glm::dot(corners[k], view.forward) / (2 * view.tanHalfX);
    }
    const auto cross = [](const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; };
    const glm::dvec2 toB = p[1] - p[0], toC = p[2] - p[0];
    const double area = cross(toB, toC);
    if (area == 0) return cone;
    cone.m_front = area > 0;
    const double sign = area > 0 ? 1 : -1;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 &from = p[k], edge = p[(k + 1) % 3] - from;
        const WindowLine line{-sign * edge.y, sign * edge.x, -sign * cross(edge, from)};
        cone.addLine(view, {}, line, kRounding * glm::length(edge) * (glm::length(from) + view.width));
    }
    const double atB = inverse[1] - inverse[0], atC = inverse[2] - inverse[0];
    cone.m_inverse.x = (atB * toC.y - atC * toB.y) / area;
    cone.m_inverse.y = (atC * toB.x - atB * toC.x) / area;
    cone.m_inverse.c = inverse[0] - cone.m_inverse.x * p[0].x - cone.m_inverse.y * p[0].y;
    return cone;
}

Cone Cone::side(const View& view, const glm::dvec3& from, const glm::dvec3& to, const glm::dvec4& light) {
    Cone cone;
    const int facing = -orientation(view.eye, from, to, light);
    if (facing == 0) return cone;
    cone.m_front = facing > 0;
    const glm::dvec3 l(light);
    const bool directional = light.w == 0;
    const Difference away{directional ? glm::dvec3(0) : from, l};
    Few<Difference, 4> corners;
    corners.push_back({to, view.eye});
    corners.push_back({from, view.eye});
    corners.push_back(away);
    if (!directional) corners.push_back({to, l});
    for (int k = 0; k < corners.size(); ++k)
        cone.addBorder(view, corners[k], corners[(k + 1) % corners.size()], -facing);
    cone.setPlane(view, {to, from}, away, {from, view.eye});
    return cone;
}

Cone Cone::farCap(const View& view, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                  const glm::dvec4& light) {
    Cone cone;
    const glm::dvec3 l(light);
    const Difference corners[3] = {{a, l}, {b, l}, {c, l}};
    for (int k = 0; k < 3; ++k) cone.addBorder(view, corners[k], corners[(k + 1) % 3], -1);
    return cone;
}

Cone Cone::nearCap(const View& view, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                   const glm::vec4& light) {
    Cone cone;
    cone.m_front = true;
    cone.m_lit = LitTriangle{.corners = {a, b, c}, .edgeOn = false, .casts = true};
    cone.m_light = light;
    cone.m_near = view.nearPlane;
    cone.m_inverse = {0, 0, 1 / view.nearPlane};
    const glm::dvec3 p[3] = {a, b, c}, l(light);
    const auto add = [&](const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& base) {
        // Positive inside: normal . (eye + near direction - base)
        const glm::dvec3 normal = glm::cross(u, v), toEye = view.eye - base;
        WindowLine line = alongRays(view, view.nearPlane * normal);
        line.c += glm::dot(normal, toEye);
        cone.addLine(view, {}, line,
                     kRounding * glm::length(u) * glm::length(v) *
                         (glm::length(toEye) + view.nearPlane * longestRay(view)));
    };
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 &from = p[k], &to = p[(k + 1) % 3];
        light.w == 0 ? add(from - to, l, from) : add(to - l, from - l, l);
    }
    add(p[2] - p[0], p[1] - p[0], p[0]);
    return cone;
}

bool Cone::holds(const EyeRay& ray, double x, double y) const {
    const double value = inside(x, y);
    if (std::abs(value) > m_error || m_parallel) return value >= 0;
    if (m_lit) return crossesExactly(*m_lit, m_light, RayPoint(ray, m_near));
    return std::all_of(m_borders.begin(), m_borders.end(), [&](const Border& border) {
        const double at = border.line.at(x, y);
        if (std::abs(at) > m_error) return at > 0;
        return exactSide(border.u, border.v, ray.direction) * border.sign > 0;
    });
}

bool Cone::missesWindow(int width, int height, double slack) const {
    const double most = -slack - m_error;
    return std::any_of(m_borders.begin(), m_borders.end(), [&](const Border& b) {
        return b.line.at(0, 0) < most && b.line.at(width, 0) < most && b.line.at(0, height) < most &&
               b.line.at(width, height) < most;
    });
}

std::pair<int, int> Cone::columns(double y, double slack, int width) const {
    double first = 0, last = width;
    for (const Border& border : m_borders) {
        const double rest = border.line.y * y + border.line.c + slack + m_error;
        if (border.line.x == 0) {
            if (!(rest >= 0)) return {0, 0};
        } else if (border.line.x > 0) {
            first = std::max(first, -rest / border.line.x);
        } else {
            last = std::min(last, rest / -border.line.x);
        }
        if (!(first <= last)) return {0, 0};
    }
    // Centres lie half a pixel in.
    return {std::max(0, int(std::ceil(first - 0.5))), std::min(width, int(std::floor(last - 0.5)) + 1)};
}

Rational Cone::exactInverse(const EyeRay& ray) const {
    const Exact3 normal = cross(exactly(m_planeU), exactly(m_planeV));
    return Rational(dot(normal, exactly(ray.direction)) / dot(normal, exactly(m_planeBase)));
}

}  // namespace gnomon
