#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>

namespace gnomon {

using Rational = boost::multiprecision::cpp_rational;

/// A triangle of the scene, wound so that the light does not see its back.
struct LitTriangle {
    glm::vec3 corners[3]{};
    bool edgeOn = false;  ///< the light lies in its plane
    bool casts = false;   ///< belongs to a caster, and is a face of it that casts a shadow of this light
};

/// An eye ray: eye + t * direction, taken as the doubles that they are.
struct EyeRay {
    glm::dvec3 eye{}, direction{};
};

/// Values that an expression may have, rounding included.
struct Interval {
    double low = 0, high = 0;
    bool holds(double value) const { return low <= value && value <= high; }
};

/// The point of an eye ray where it meets a triangle's plane, moved along the ray; or at a given parameter.
class RayPoint {
  public:
    /// @pre the ray is not parallel to the plane
    RayPoint(const EyeRay& ray, const LitTriangle& triangle);
    RayPoint(const EyeRay& ray, double t);

    /// The point farther along the ray by @p shift.
    /// @pre this one was made of a triangle, and not moved
    RayPoint moved(double shift) const;

    const EyeRay& ray() const { return m_ray; }
    double t() const { return m_t; }
    const glm::dvec3& position() const { return m_position; }
    double error() const { return m_error; }  ///< bound on the error of each coordinate of position()
    const Rational& exactT() const;
    /// Coordinate @p k of the point itself.
    Rational exact(int k) const { return Rational(m_ray.eye[k]) + exactT() * Rational(m_ray.direction[k]); }

  private:
    RayPoint() = default;
    void place(const Interval& t);

    EyeRay m_ray;
    const LitTriangle* m_triangle = nullptr;
    double m_shift = 0, m_t = 0, m_error = 0;
    Interval m_bounds{};  ///< of the parameter
    glm::dvec3 m_position{};
    mutable std::unique_ptr<Rational> m_exact{};
};

/// Sign of (p - eye) x (q - eye) . direction: on which side of the edge from p to q the ray passes. Never 0:
/// a ray through the edge counts as turned a little, always in the same way, so that exactly one of two
/// triangles that share an edge has it (Edelsbrunner and Muecke 1990, Simulation of Simplicity).
int edgeSide(const EyeRay& ray, const glm::vec3& p, const glm::vec3& q);

/// Bounds on the parameters at which the ray, or any with a direction inside direction +- spreadX +- spreadY,
/// meets the triangle's plane; nothing if one of them may be parallel to it.
std::optional<Interval> planeHit(const EyeRay& ray, const LitTriangle& triangle,
                                 const glm::dvec3& spreadX = {}, const glm::dvec3& spreadY = {});

/// The exact parameter; nothing if the ray is parallel to the plane.
std::optional<Rational> exactPlaneHit(const EyeRay& ray, const LitTriangle& triangle);

enum class Answer : std::uint8_t { No, Yes, Unsure };

/// Whether the segment from @p point to the light crosses @p triangle, for all points within @p radius of it:
/// No and Yes are certain.
/// @pre the triangle is not edge-on
Answer crosses(const LitTriangle& triangle, const glm::dvec4& light, const RayPoint& point, double radius);

/// The same for the point itself, in the limit from the eye's side; exact.
bool crossesExactly(const LitTriangle& triangle, const glm::dvec4& light, const RayPoint& point);

}  // namespace gnomon
