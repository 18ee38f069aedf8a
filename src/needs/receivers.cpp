#include "needs/receivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "predict/window_line.h"
#include "truth/infinity.h"
#include "volume/clip_space.h"

namespace gnomon {
namespace {

constexpr double kInverseRounding = 1e-12;  ///< of an inverse distance, as a share
constexpr double kBoxRounding = 1e-9;       ///< of a box, as a share of its coordinates
constexpr std::size_t kMostPlanes = 4;      ///< patches of a block that are planes; the rest is put together
constexpr std::size_t kMostRests = 2;

/// The part of the window that some pixels take, and what lies beside them: an octagon.
struct Octagon {
    double left = kInfinity, right = -kInfinity, bottom = kInfinity, top = -kInfinity;
    double leastSum = kInfinity, mostSum = -kInfinity;                ///< of x + y
    double leastDifference = kInfinity, mostDifference = -kInfinity;  ///< of x - y

    /// The pixel with this centre.
    void include(double x, double y) {
        constexpr double b = Receivers::kBeside;
        left = std::min(left, x - b), right = std::max(right, x + b);
        bottom = std::min(bottom, y - b), top = std::max(top, y + b);
        leastSum = std::min(leastSum, x + y - 2 * b), mostSum = std::max(mostSum, x + y + 2 * b);
        leastDifference = std::min(leastDifference, x - y - 2 * b);
        mostDifference = std::max(mostDifference, x - y + 2 * b);
    }
    void include(const Octagon& other) {
        left = std::min(left, other.left), right = std::max(right, other.right);
        bottom = std::min(bottom, other.bottom), top = std::max(top, other.top);
        leastSum = std::min(leastSum, other.leastSum), mostSum = std::max(mostSum, other.mostSum);
        leastDifference = std::min(leastDifference, other.leastDifference);
        mostDifference = std::max(mostDifference, other.mostDifference);
    }

    /// Counter-clockwise; a corner that is not cut off is there once.
    Few<glm::dvec2, 8> corners() const {
        Few<glm::dvec2, 8> out;
        const auto add = [&](double x, double y) {
            const glm::dvec2 p(x, y);
            constexpr double kSame = 1e-9;
            const auto isSame = [&](const glm::dvec2& q) {
                return std::abs(p.x - q.x) + std::abs(p.y - q.y) < kSame;
            };
            if (out.size() > 0 && (isSame(out[out.size() - 1]) || isSame(out[0]))) return;
            out.push_back(p);
        };
        add(left, std::max(bottom, leastSum - left));
        add(std::max(left, leastSum - bottom), bottom);
        add(std::min(right, mostDifference + bottom), bottom);
        add(right, std::max(bottom, right - mostDifference));
        add(right, std::min(top, mostSum - right));
        add(std::min(right, mostSum - top), top);
        add(std::max(left, leastDifference + top), top);
        add(left, std::min(top, left - leastDifference));
        return out;
    }

    WindowRect pixels() const {
        const int x = int(std::floor(left + 0.25)), y = int(std::floor(bottom + 0.25));
        return {x, y, int(std::ceil(right - 0.25)) - x, int(std::ceil(top - 0.25)) - y};
    }
};

/// What some pixels of a block see of one plane, or between two distances.
struct SeenPiece {
    const SurfaceFace* face = nullptr;  ///< the first
    WindowLine inverse{};               ///< 1 / distance of its plane
    Octagon where{};
    double nearest = 0, farthest = kInfinity;  ///< as inverse distances
    double slope = 0;                          ///< the largest, of window depth
    double thickness = 0;                      ///< of the other faces in the plane, in inverse distances
    std::size_t pixels = 0;
    bool isPlane = true;
};

}  // namespace

class Receivers::Builder {
  public:
    Builder(const SeenWindow& window, Receivers& out) : m_window(window), m_view(window.view()), m_out(out) {}

    void build() {
        m_out.m_columns = (m_view.width + kBlock - 1) / kBlock;
        m_out.m_rows = (m_view.height + kBlock - 1) / kBlock;
        m_out.m_blocks.reserve(std::size_t(m_out.m_columns) * std::size_t(m_out.m_rows));
        for (int row = 0; row < m_out.m_rows; ++row)
            for (int column = 0; column < m_out.m_columns; ++column) addBlock(column * kBlock, row * kBlock);
    }

  private:
    void addBlock(int left, int bottom) {
        Block block;
        block.pixels = {left, bottom, std::min(kBlock, m_view.width - left),
                        std::min(kBlock, m_view.height - bottom)};
        m_pieces.clear();
        m_faceLow = glm::dvec3(kInfinity), m_faceHigh = glm::dvec3(-kInfinity);
        for (int y = bottom; y < bottom + block.pixels.height; ++y) {
            std::size_t last = 0;
            for (int x = left; x < left + block.pixels.width; ++x) {
                const auto pixel = std::size_t(m_view.height - 1 - y) * std::size_t(m_view.width);
                for (const Seen& seen : m_window.at(pixel + std::size_t(x))) {
                    if (seen.face)
                        last = see(seen, x + 0.5, y + 0.5, last);
                    else
                        block.seesBackground = true;
                }
            }
        }
        block.seesSurface = !m_pieces.empty();
        if (block.seesSurface) {
            for (SeenPiece& piece : m_pieces) finish(piece);
            joinPlanes();
            joinRest();
            addPatches(block);
        }
        m_out.m_blocks.push_back(block);
    }

    /// Adds a pixel to the piece of its face: @p last or another. Returns which.
    std::size_t see(const Seen& seen, double x, double y, std::size_t last) {
        const auto isOf = [&](const SeenPiece& piece) { return piece.face == seen.face; };
        if (last >= m_pieces.size() || !isOf(m_pieces[last])) {
            const auto found = std::find_if(m_pieces.begin(), m_pieces.end(), isOf);
            last = std::size_t(found - m_pieces.begin());
            if (found == m_pieces.end()) {
                const glm::dvec2 rise = -seen.slope / m_view.nearPlane;
                m_pieces.push_back({.face = seen.face,
                                    .inverse = {rise.x, rise.y, seen.inverse - rise.x * x - rise.y * y},
                                    .slope = glm::length(seen.slope)});
            }
        }
        m_pieces[last].where.include(x, y);
        ++m_pieces[last].pixels;
        return last;
    }

    /// Finds the distances of one face's piece.
    void finish(SeenPiece& piece) {
        double nearest = 0, farthest = kInfinity;
        for (const glm::dvec2& corner : piece.where.corners()) {
            nearest = std::max(nearest, piece.inverse.at(corner.x, corner.y));
            farthest = std::min(farthest, piece.inverse.at(corner.x, corner.y));
        }
        // No point of the face is nearer or farther than all of its corners.
        double nearestCorner = 0, farthestCorner = kInfinity;
        const Mesh& mesh = m_window.scene().objects[piece.face->object].mesh;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 p = mesh.positions[piece.face->corners[k]];
            m_faceLow = glm::min(m_faceLow, p), m_faceHigh = glm::max(m_faceHigh, p);
            const double distance = glm::dot(p - m_view.eye, m_view.forward);
            const double inverse = distance > 0 ? 1 / distance : kInfinity;
            nearestCorner = std::max(nearestCorner, inverse);
            farthestCorner = std::min(farthestCorner, inverse);
        }
        const double slack = apartOf(std::min(nearest, nearestCorner), piece.slope);
        piece.isPlane = nearest <= nearestCorner + slack && farthest >= farthestCorner - slack;
        piece.nearest = std::min(nearest, nearestCorner);
        piece.farthest = std::max(0.0, std::max(farthest, farthestCorner));
    }

    /// By how much two distances near 1 / @p inverse may differ and still compare either way, as inverse
    /// distances.
    double apartOf(double inverse, double slope) const {
        return (m_window.bandOf(inverse) + kBeside * slope) / m_view.nearPlane + kInverseRounding * inverse;
    }
    double apart(const SeenPiece& piece) const {
        // Between two distances all that lies beside is there already.
        return apartOf(piece.nearest, piece.isPlane ? piece.slope : 0) + piece.thickness;
    }

    static void join(SeenPiece& piece, const SeenPiece& other) {
        piece.where.include(other.where);
        piece.nearest = std::max(piece.nearest, other.nearest);
        piece.farthest = std::min(piece.farthest, other.farthest);
        piece.slope = std::max(piece.slope, other.slope);
        piece.thickness = std::max(piece.thickness, other.thickness);
        piece.pixels += other.pixels;
    }

    /// Faces in one plane become one piece.
    void joinPlanes() {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < m_pieces.size(); ++i) {
            const SeenPiece piece = m_pieces[i];
            const auto end = m_pieces.begin() + std::ptrdiff_t(kept);
            const auto found = std::find_if(m_pieces.begin(), end, [&](SeenPiece& other) {
                if (!piece.isPlane || !other.isPlane) return false;
                const double apartBy = distanceOf(piece, other);
                if (apartBy > 0.25 * apartOf(std::min(piece.nearest, other.nearest), 0)) return false;
                other.thickness = std::max(other.thickness, apartBy);
                return true;
            });
            if (found == end)
                m_pieces[kept++] = piece;
            else
                join(*found, piece);
        }
        m_pieces.resize(kept);
    }

    /// How far two planes are apart where the pieces are, in inverse distances.
    static double distanceOf(const SeenPiece& a, const SeenPiece& b) {
        const double left = std::min(a.where.left, b.where.left),
                     right = std::max(a.where.right, b.where.right);
        const double bottom = std::min(a.where.bottom, b.where.bottom),
                     top = std::max(a.where.top, b.where.top);
        const WindowLine between{a.inverse.x - b.inverse.x, a.inverse.y - b.inverse.y,
                                 a.inverse.c - b.inverse.c};
        return std::max({std::abs(between.at(left, bottom)), std::abs(between.at(right, bottom)),
                         std::abs(between.at(left, top)), std::abs(between.at(right, top))});
    }

    /// Keeps the largest pieces; the others are put together, the near ones and the far ones.
    void joinRest() {
        if (m_pieces.size() <= kMostPlanes + kMostRests) return;
        const auto rest = m_pieces.begin() + std::ptrdiff_t(kMostPlanes);
        std::partial_sort(m_pieces.begin(), rest, m_pieces.end(),
                          [](const SeenPiece& a, const SeenPiece& b) { return a.pixels > b.pixels; });
        std::sort(rest, m_pieces.end(),
                  [](const SeenPiece& a, const SeenPiece& b) { return a.nearest > b.nearest; });
        // The widest gap between them.
        auto split = m_pieces.end();
        double widest = 1, farthest = rest->farthest;
        for (auto at = rest + 1; at != m_pieces.end(); ++at) {
            const double share = at->nearest / farthest;
            if (share < widest) widest = share, split = at;
            farthest = std::min(farthest, at->farthest);
        }
        std::vector<SeenPiece> joined;
        for (auto at = rest; at != m_pieces.end(); ++at) {
            if (at == rest || at == split)
                joined.push_back(*at);
            else
                join(joined.back(), *at);
            joined.back().isPlane = false;
        }
        m_pieces.resize(kMostPlanes);
        m_pieces.insert(m_pieces.end(), joined.begin(), joined.end());
    }

    void addPatches(Block& block) {
        block.low = glm::dvec3(kInfinity), block.high = glm::dvec3(-kInfinity);
        for (SeenPiece& piece : m_pieces) {
            const auto corners = piece.where.corners();
            limit(piece, corners);
            Patch patch{.pixels = piece.where.pixels(), .first = std::uint32_t(m_out.m_corners.size())};
            const double by = apart(piece);
            for (const glm::dvec2& corner : corners) {
                const double inverse = piece.inverse.at(corner.x, corner.y);
                const double nearer = piece.isPlane ? inverse : piece.nearest,
                             farther = piece.isPlane ? inverse : piece.farthest;
                const Corner added{.direction = rayDirection(m_view, corner.x, corner.y),
                                   .nearer = std::min(nearer + by, 1 / m_view.nearPlane),
                                   .farther = std::max(farther - by, 0.0)};
                include(block, added.direction / added.nearer);
                include(block, added.direction / added.farther);
                m_out.m_corners.push_back(added);
                ++patch.corners;
            }
            m_out.m_patches.push_back(patch);
        }
        const glm::dvec3 size = glm::max(glm::abs(m_faceLow), glm::abs(m_faceHigh)) + glm::abs(m_view.eye);
        block.low = glm::max(block.low, m_faceLow) - kBoxRounding * size;
        block.high = glm::min(block.high, m_faceHigh) + kBoxRounding * size;
    }

    /// A plane that reaches before the near plane or beyond infinity in some corner is no plane in all.
    void limit(SeenPiece& piece, const Few<glm::dvec2, 8>& corners) const {
        if (!piece.isPlane) return;
        double nearest = 0, farthest = kInfinity;
        for (const glm::dvec2& corner : corners) {
            nearest = std::max(nearest, piece.inverse.at(corner.x, corner.y));
            farthest = std::min(farthest, piece.inverse.at(corner.x, corner.y));
        }
        if (nearest + apart(piece) <= 1 / m_view.nearPlane && farthest > 0) return;
        piece.isPlane = false;
        piece.nearest = nearest, piece.farthest = std::max(farthest, 0.0);
    }

    void include(Block& block, const glm::dvec3& fromEye) const {
        for (int k = 0; k < 3; ++k) {
            // 0 / 0: a ray in the plane of the axis to infinity.
            const double at = m_view.eye[k] + (std::isnan(fromEye[k]) ? 0 : fromEye[k]);
            block.low[k] = std::min(block.low[k], at), block.high[k] = std::max(block.high[k], at);
        }
    }

    const SeenWindow& m_window;
    const View& m_view;
    Receivers& m_out;
    std::vector<SeenPiece> m_pieces{};  ///< of one block
    glm::dvec3 m_faceLow{}, m_faceHigh{};
};

Receivers::Receivers(const SeenWindow& window) {
    Builder(window, *this).build();
}

}  // namespace gnomon
