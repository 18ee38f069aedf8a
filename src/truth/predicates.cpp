#include "truth/predicates.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

#include "volume/orient.h"

namespace gnomon {
namespace {

// Error bounds below: u x v has, per component, an error of at most 4 roundings of |u| x |v| (with
// differences of inputs for u and v, one rounding each), and a dot product with it some 5 more. 16 is ample.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon() / 2;

/// |u| x |v| with plus for minus: what the rounding of u x v is relative to.
glm::dvec3 crossSize(const glm::dvec3& u, const glm::dvec3& v) {
    const glm::dvec3 a = glm::abs(u), b = glm::abs(v);
    return {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
}

/// A plane in floating point: normal . (x - base).
struct Plane {
    glm::dvec3 normal, size, base;

    Plane(const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& at)
        : normal(glm::cross(u, v)), size(crossSize(u, v)), base(at) {}

    /// Bounds on the value within @p radius of x, each of whose coordinates may be wrong by @p error.
    Interval at(const glm::dvec3& x, double error, double radius) const {
        const glm::dvec3 d = x - base;
        const double value = glm::dot(normal, d);
        // The true normal, by which the value rises where the point moves, is this one but for its rounding.
        const double around = radius > 0 ? radius * glm::length(normal) : 0;
        const double slack =
            kRounding * (glm::dot(size, glm::abs(d)) + (error + radius) * (size.x + size.y + size.z)) +
            1.001 * (around + error * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)));
        return {value - slack, value + slack};
    }
};

using Exact3 = std::array<Rational, 3>;

Exact3 exactly(const glm::dvec3& v) {
    return {Rational(v.x), Rational(v.y), Rational(v.z)};
}
Exact3 difference(const Exact3& a, const Exact3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Rational dot(const Exact3& a, const Exact3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Exact3 cross(const Exact3& a, const Exact3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool precedes(const glm::vec3& p, const glm::vec3& q) {
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

/// Sign of the plane (normal, base) at the point, just before it on its ray; 0 only for a plane without
/// normal.
int exactSide(const Exact3& normal, const Exact3& base, const RayPoint& point) {
    const Exact3 x = {point.exact(0), point.exact(1), point.exact(2)};
    if (const int sign = dot(normal, difference(x, base)).sign()) return sign;
    if (const int sign = dot(normal, exactly(point.ray().direction)).sign()) return -sign;
    for (const Rational& component : normal) {
        if (const int sign = component.sign()) return sign;
    }
    return 0;
}

}  // namespace

RayPoint::RayPoint(const EyeRay& ray, const LitTriangle& triangle) : m_ray(ray), m_triangle(&triangle) {
    if (const auto t = planeHit(ray, triangle)) {
        place(*t);
    } else {
        const auto exact = static_cast<double>(exactT());
        place({exact, exact});
    }
}

RayPoint::RayPoint(const EyeRay& ray, double t) : m_ray(ray), m_shift(t) {
    place({t, t});
}

RayPoint RayPoint::moved(double shift) const {
    assert(m_triangle && m_shift == 0);
    RayPoint point;
    point.m_ray = m_ray;
    point.m_triangle = m_triangle;
    point.m_shift = shift;
    point.place({m_bounds.low + shift, m_bounds.high + shift});
    return point;
}

void RayPoint::place(const Interval& t) {
    m_bounds = t;
    m_t = t.low + (t.high - t.low) / 2;
    m_position = m_ray.eye + m_t * m_ray.direction;
    const glm::dvec3 size = glm::abs(m_ray.eye) + std::abs(m_t) * glm::abs(m_ray.direction);
    const double d =
        std::max({std::abs(m_ray.direction.x), std::abs(m_ray.direction.y), std::abs(m_ray.direction.z)});
    m_error = (t.high - t.low) * d + kRounding * std::max({size.x, size.y, size.z});
}

const Rational& RayPoint::exactT() const {
    if (!m_exact)
        m_exact = std::make_unique<Rational>((m_triangle ? *exactPlaneHit(m_ray, *m_triangle) : Rational(0)) +
                                             Rational(m_shift));
    return *m_exact;
}

int edgeSide(const EyeRay& ray, const glm::vec3& p, const glm::vec3& q) {
    // As if the ray were turned towards the two axes that it follows least, one turn infinitely smaller than
    // the other.
    const glm::dvec3 size = glm::abs(ray.direction);
    const int main = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    glm::dvec4 turns[3] = {glm::dvec4(ray.direction, 0), {}, {}};
    turns[1][(main + 1) % 3] = 1;
    turns[2][(main + 2) % 3] = 1;
    for (const glm::dvec4& turn : turns) {
        if (const int sign = orientation(ray.eye, glm::dvec3(p), glm::dvec3(q), turn)) return sign;
    }
    return precedes(p, q) ? 1 : -1;  // the eye is on the edge's line
}

std::optional<Interval> planeHit(const EyeRay& ray, const LitTriangle& triangle, const glm::dvec3& spreadX,
                                 const glm::dvec3& spreadY) {
    const glm::dvec3 a = triangle.corners[0], b = triangle.corners[1], c = triangle.corners[2];
    const Plane plane(b - a, c - a, ray.eye);
    const Interval height = plane.at(a, 0, 0);
    const double slope = glm::dot(plane.normal, ray.direction);
    const double slack =
        kRounding * glm::dot(plane.size, glm::abs(ray.direction)) +
        1.001 * (std::abs(glm::dot(plane.normal, spreadX)) + std::abs(glm::dot(plane.normal, spreadY)));
    if (std::abs(slope) <= 2 * slack) return {};
    Interval t{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const double h : {height.low, height.high}) {
        for (const double s : {slope - slack, slope + slack}) {
            t.low = std::min(t.low, h / s);
            t.high = std::max(t.high, h / s);
        }
    }
    const double rounding = kRounding * std::max(std::abs(t.low), std::abs(t.high));
    return Interval{t.low - rounding, t.high + rounding};
}

std::optional<Rational> exactPlaneHit(const EyeRay& ray, const LitTriangle& triangle) {
    const Exact3 a = exactly(triangle.corners[0]);
    const Exact3 normal =
        cross(difference(exactly(triangle.corners[1]), a), difference(exactly(triangle.corners[2]), a));
    const Rational slope = dot(normal, exactly(ray.direction));
    if (slope.is_zero()) return {};
    return Rational(dot(normal, difference(a, exactly(ray.eye))) / slope);
}

Answer crosses(const LitTriangle& triangle, const glm::dvec4& light, const RayPoint& point, double radius) {
    const glm::dvec3 p[3] = {triangle.corners[0], triangle.corners[1], triangle.corners[2]};
    const glm::dvec3 l(light);
    bool unsure = false;

    // Inside the prism that the triangle cuts out of the light; each edge's plane is positive inside.
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 &from = p[k], &to = p[(k + 1) % 3];
        const Plane plane = light.w == 0 ? Plane(from - to, l, from) : Plane(to - l, from - l, l);
        const Interval value = plane.at(point.position(), point.error(), radius);
        if (value.high < 0) return Answer::No;
        unsure = unsure || value.low <= 0;
    }

    // Behind the triangle; the light is before it.
    const Interval height = Plane(p[1] - p[0], p[2] - p[0], p[0]).at(point.position(), point.error(), radius);
    if (height.low > 0) return Answer::No;
    return unsure || height.high >= 0 ? Answer::Unsure : Answer::Yes;
}

bool crossesExactly(const LitTriangle& triangle, const glm::dvec4& light, const RayPoint& point) {
    const Answer quick = crosses(triangle, light, point, 0);
    if (quick != Answer::Unsure) return quick == Answer::Yes;

    const Exact3 l = exactly(glm::dvec3(light));
    Exact3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = exactly(triangle.corners[k]);
    for (int k = 0; k < 3; ++k) {
        const Exact3 &from = p[k], &to = p[(k + 1) % 3];
        const Exact3 normal =
            light.w == 0 ? cross(difference(from, to), l) : cross(difference(to, l), difference(from, l));
        if (exactSide(normal, light.w == 0 ? from : l, point) < 0) return false;
    }
    return exactSide(cross(difference(p[1], p[0]), difference(p[2], p[0])), p[0], point) < 0;
}

}  // namespace gnomon
