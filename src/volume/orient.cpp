#include "volume/orient.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

/// A number as an exact sum of doubles that don't overlap, smallest first, without zeros (Shewchuk 1997,
/// section 2.2).
class Expansion {
  public:
    Expansion() = default;

    /// The exact difference a - b.
    static Expansion difference(double a, double b) {
        Expansion e;
        e.add(a);
        e.add(-b);
        return e;
    }

    /// Adds one double (Grow-Expansion, theorem 10).
    void add(double b) {
        double rest = b;
        int kept = 0;
        for (int i = 0; i < m_size; ++i) {
            const double sum = rest + m_terms[i];
            const double restPart = sum - m_terms[i];
            const double error = (rest - restPart) + (m_terms[i] - (sum - restPart));
            if (error != 0) m_terms[kept++] = error;
            rest = sum;
        }
        if (rest != 0) {
            assert(kept < kMaxTerms);
            m_terms[kept++] = rest;
        }
        m_size = kept;
    }

    void add(const Expansion& other, double sign = 1) {
        for (int i = 0; i < other.m_size; ++i) add(sign * other.m_terms[i]);
    }

    Expansion operator*(const Expansion& other) const {
        Expansion product;
        for (int i = 0; i < m_size; ++i) {
            for (int j = 0; j < other.m_size; ++j) {
                const double high = m_terms[i] * other.m_terms[j];
                product.add(std::fma(m_terms[i], other.m_terms[j], -high));
                product.add(high);
            }
        }
        return product;
    }

    /// The last term outweighs all others together.
    int sign() const { return m_size == 0 ? 0 : m_terms[m_size - 1] > 0 ? 1 : -1; }

  private:
    /// A difference has 2 terms, a product twice the product of the sizes: 8, their difference 16, times 2 is
    /// 64, three of them 192.
    static constexpr int kMaxTerms = 192;
    std::array<double, kMaxTerms> m_terms;
    int m_size = 0;
};

int exactOrientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& p) {
    Expansion u[3], v[3], w[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = Expansion::difference(b[k], a[k]);
        v[k] = Expansion::difference(c[k], a[k]);
        w[k] = Expansion::difference(p[k], p.w == 0 ? 0 : a[k]);
    }
    Expansion determinant;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        Expansion minor = u[i] * v[j];
        minor.add(u[j] * v[i], -1);
        determinant.add(minor * w[k]);
    }
    return determinant.sign();
}

}  // namespace

int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& p) {
    assert(p.w == 0 || p.w == 1);
    const glm::dvec3 u = b - a, v = c - a, w = p.w == 0 ? glm::dvec3(p) : glm::dvec3(p) - a;
    double determinant = 0, permanent = 0;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double left = u[i] * v[j], right = u[j] * v[i];
        determinant += (left - right) * w[k];
        permanent += (std::abs(left) + std::abs(right)) * std::abs(w[k]);
    }
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon() / 2;
    constexpr double kBound = (7 + 56 * kEpsilon) * kEpsilon;  // errboundA of Shewchuk, section 4.3
    if (determinant > kBound * permanent) return 1;
    if (determinant < -kBound * permanent) return -1;
    return exactOrientation(a, b, c, p);
}

int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p) {
    return orientation(a, b, c, glm::dvec4(p, 1));
}

int orientation(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec4& p) {
    return orientation(glm::dvec3(a), glm::dvec3(b), glm::dvec3(c), glm::dvec4(p));
}

}  // namespace gnomon
