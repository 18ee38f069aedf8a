#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <span>

namespace gnomon {

/// An axis-aligned box, world space.
struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

/// Finds the boxes that a ray may hit. Embree walks its own tree of them; what is in a box it never sees, so
/// that its rounding can't decide anything: boxes are inflated by reach() and the rounding of a ray in float.
class Candidates {
  public:
    /// @param reach  how far beside a box a ray may pass and still find it, world units
    Candidates(std::span<const Box> boxes, double reach);
    ~Candidates();
    Candidates(const Candidates&) = delete;
    Candidates& operator=(const Candidates&) = delete;

    double reach() const { return m_reach; }

    /// The range of the ray's parameter in which it may meet a box; empty (first > second) if it misses them
    /// all.
    std::pair<double, double> clip(const glm::dvec3& origin, const glm::dvec3& direction, double first,
                                   double last) const;

    /// Calls @p visit(index) for each box that the ray from parameter @p first to @p last may meet, the
    /// nearest first, roughly. It returns up to which parameter the search goes on, negative infinity to
    /// stop.
    template <class Visit>
    void nearestFirst(const glm::dvec3& origin, const glm::dvec3& direction, double first, double last,
                      Visit&& visit) const {
        search(origin, direction, first, last, {&visit, &call<Visit>}, true);
    }

    /// The same in any order.
    template <class Visit>
    void anyOrder(const glm::dvec3& origin, const glm::dvec3& direction, double first, double last,
                  Visit&& visit) const {
        search(origin, direction, first, last, {&visit, &call<Visit>}, false);
    }

  private:
    struct Visitor {
        void* self;
        double (*call)(void*, std::uint32_t);
    };
    struct Impl;

    template <class Visit>
    static double call(void* self, std::uint32_t index) {
        return (*static_cast<std::remove_reference_t<Visit>*>(self))(index);
    }
    void search(const glm::dvec3& origin, const glm::dvec3& direction, double first, double last,
                Visitor visitor, bool ordered) const;

    double m_reach = 0;
    Box m_bounds{};
    std::unique_ptr<Impl> m_impl;
};

}  // namespace gnomon
