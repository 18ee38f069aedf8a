// A volume holds a point if a lit triangle lies between the point and the light. So what it may hold of a
// patch is asked of the patch's *beam*, the convex hull of the patch and the light: which lit triangles meet
// it? Two things make the answer tight:
//
// - Points are asked about just before the surface that is seen, nearer by what depths may be off by. There a
//   lit triangle does not shadow itself, nor its neighbours in the same plane. Between there and the surface
//   no cap of a volume counts: caps are surfaces, and none is seen before the nearest.
// - So beside points in shadow only sides matter that come as near to the surface as that. A side does if the
//   edge that it hangs from meets the beam of the whole patch.

#include "needs/reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

#include "needs/beam.h"
#include "truth/infinity.h"
#include "volume/clip_space.h"
#include "volume/near_cap.h"

namespace gnomon {
namespace {

/// Of a sum of products, as a share of the sum of their sizes.
constexpr double kRounding = 1e-12;

/// Boxes in a binary tree.
class Tree {
  public:
    explicit Tree(std::vector<BeamBox> boxes) : m_boxes(std::move(boxes)), m_items(m_boxes.size()) {
        std::iota(m_items.begin(), m_items.end(), 0u);
        if (!m_items.empty()) split(0, std::uint32_t(m_items.size()));
    }

    /// Calls @p visit with each item whose box the beam may meet, until it returns true; whether it did.
    template <class Visit>
    bool find(Beam& beam, const Visit& visit) const {
        if (m_nodes.empty()) return false;
        std::uint32_t open[64];
        int count = 0;
        open[count++] = 0;
        while (count > 0) {
            const Node& node = m_nodes[open[--count]];
            if (beam.misses(node.box)) continue;
            if (node.second != 0) {
                open[count++] = node.second;
                open[count++] = std::uint32_t(&node - m_nodes.data()) + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (visit(m_items[i])) return true;
        }
        return false;
    }

  private:
    static constexpr std::uint32_t kLeaf = 4;

    struct Node {
        BeamBox box{};
        std::uint32_t begin = 0, end = 0;
        std::uint32_t second = 0;  ///< child; the first one follows its parent. 0: a leaf
    };

    void split(std::uint32_t begin, std::uint32_t end) {
        const std::size_t at = m_nodes.size();
        m_nodes.emplace_back();
        BeamBox box, middles;
        for (std::uint32_t i = begin; i < end; ++i) {
            const BeamBox& one = m_boxes[m_items[i]];
            box.include(one);
            middles.include(one.low + one.high);
        }
        m_nodes[at] = {box, begin, end, 0};
        if (end - begin <= kLeaf) return;
        const glm::dvec3 size = middles.high - middles.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t middle = begin + (end - begin) / 2;
        std::nth_element(m_items.begin() + begin, m_items.begin() + middle, m_items.begin() + end,
                         [&](std::uint32_t a, std::uint32_t b) {
                             return m_boxes[a].low[axis] + m_boxes[a].high[axis] <
                                    m_boxes[b].low[axis] + m_boxes[b].high[axis];
                         });
        split(begin, middle);
        m_nodes[at].second = std::uint32_t(m_nodes.size());
        split(middle, end);
    }

    std::vector<BeamBox> m_boxes;
    std::vector<std::uint32_t> m_items;
    std::vector<Node> m_nodes{};
};

/// One volume: the triangles that cap it and the edges that its sides hang from.
class Volume {
  public:
    Volume(const Scene& scene, std::uint32_t object, std::span<const glm::uvec3> caps,
           std::span<const Side> sides, const glm::dvec3& eye)
        : m_mesh(&scene.objects[object].mesh), m_object(object), m_caps(caps), m_sides(sides), m_eye(eye) {
        for (const glm::uvec3& t : caps)
            for (int k = 0; k < 3; ++k) m_box.include(at(t[k]));
    }

    const BeamBox& box() const { return m_box; }
    std::span<const glm::uvec3> caps() const { return m_caps; }
    glm::dvec3 at(std::uint32_t vertex) const { return glm::dvec3(m_mesh->positions[vertex]) - m_eye; }

    /// As frameVolumes() makes a caster of it.
    LitCaster caster() const {
        return {.object = m_object,
                .lit = {m_caps.begin(), m_caps.end()},
                .sides = {m_sides.begin(), m_sides.end()}};
    }

    /// Whether reaches() is worth asking about a patch that is only one of many.
    bool isQuick() const { return m_tree || isSmall(); }

    /// Whether it may hold something of the patch, or touch it.
    bool reaches(Beam& beam) {
        if (isSmall()) {
            for (std::uint32_t i = 0; i < m_caps.size() + m_sides.size(); ++i)
                if (reaches(beam, i)) return true;
            return false;
        }
        // Most volumes of a large scene are never asked.
        if (!m_tree) m_tree = std::make_unique<Tree>(boxes());
        return m_tree->find(beam, [&](std::uint32_t i) { return reaches(beam, i); });
    }

  private:
    bool isSmall() const { return m_caps.size() + m_sides.size() <= 8; }

    /// @p part  a cap, or after all of them a side
    bool reaches(Beam& beam, std::uint32_t part) const {
        if (part < m_caps.size()) {
            const glm::uvec3& t = m_caps[part];
            return beam.isCutBy(at(t.x), at(t.y), at(t.z));
        }
        const Side& side = m_sides[part - m_caps.size()];
        return beam.isTouchedFrom(at(side.from), at(side.to));
    }

    std::vector<BeamBox> boxes() const {
        std::vector<BeamBox> boxes;
        boxes.reserve(m_caps.size() + m_sides.size());
        for (const glm::uvec3& t : m_caps) {
            boxes.emplace_back();
            for (int k = 0; k < 3; ++k) boxes.back().include(at(t[k]));
        }
        for (const Side& side : m_sides) {
            boxes.emplace_back();
            boxes.back().include(at(side.from));
            boxes.back().include(at(side.to));
        }
        return boxes;
    }

    const Mesh* m_mesh;
    std::uint32_t m_object;
    std::span<const glm::uvec3> m_caps;
    std::span<const Side> m_sides;
    glm::dvec3 m_eye;
    BeamBox m_box{};
    std::unique_ptr<Tree> m_tree{};
};

std::vector<Volume> volumes(const Scene& scene, std::span<const LitCaster> lit, const glm::dvec3& eye) {
    std::vector<Volume> out;
    for (const LitCaster& caster : lit) {
        if (caster.lit.empty()) continue;
        if (!caster.perTriangle) {
            out.emplace_back(scene, caster.object, caster.lit, caster.sides, eye);
            continue;
        }
        for (std::size_t i = 0; i < caster.lit.size(); ++i)
            out.emplace_back(scene, caster.object, std::span(&caster.lit[i], 1),
                             std::span(caster.sides).subspan(3 * i, 3), eye);
    }
    return out;
}

bool holds(const WindowRect& outer, const WindowRect& inner) {
    return !outer.empty() && outer.x <= inner.x && outer.y <= inner.y &&
           inner.x + inner.width <= outer.x + outer.width && inner.y + inner.height <= outer.y + outer.height;
}

/// Patches of neighbouring blocks, and one that holds them all. Volumes that don't reach that one are not
/// asked about the others.
struct PatchGroup {
    WindowRect pixels{};
    std::vector<const Receivers::Patch*> patches{};
    double nearest = 0, farthest = kInfinity;  ///< as inverse distances

    void include(const Receivers::Patch& patch, std::span<const Receivers::Corner> corners) {
        pixels = around(pixels, patch.pixels);
        patches.push_back(&patch);
        for (const Receivers::Corner& c : corners)
            nearest = std::max(nearest, c.nearer), farthest = std::min(farthest, c.farther);
    }

    std::array<Receivers::Corner, 4> corners(const View& view) const {
        const int right = pixels.x + pixels.width, top = pixels.y + pixels.height;
        const auto at = [&](int x, int y) {
            return Receivers::Corner{rayDirection(view, x, y), nearest, farthest};
        };
        return {at(pixels.x, pixels.y), at(right, pixels.y), at(right, top), at(pixels.x, top)};
    }
};

std::vector<PatchGroup> groupsOf(const Receivers& receivers) {
    constexpr int kBlocks = 8;  // of 2, 4 and 8 the fastest in a scene of 450 volumes
    constexpr int kPixels = kBlocks * Receivers::kBlock;
    const int columns = (receivers.columns() + kBlocks - 1) / kBlocks,
              rows = (receivers.rows() + kBlocks - 1) / kBlocks;
    std::vector<PatchGroup> groups(std::size_t(columns) * std::size_t(rows));
    for (const Receivers::Patch& patch : receivers.patches())
        groups[std::size_t(patch.pixels.y / kPixels * columns + patch.pixels.x / kPixels)].include(
            patch, receivers.corners(patch));
    std::erase_if(groups, [](const PatchGroup& group) { return group.patches.empty(); });
    return groups;
}

/// Calls @p visit with each of @p items, in leaps over all of them.
template <class Item, class Visit>
void leapOver(const std::vector<Item>& items, const Visit& visit) {
    std::size_t leap = std::size_t(0.618 * double(items.size())) + 1;
    while (std::gcd(leap, items.size()) != 1) ++leap;
    for (std::size_t i = 0, at = 0; i < items.size(); ++i, at = (at + leap) % items.size()) visit(items[at]);
}

std::vector<WindowRect> windowsOf(std::vector<Volume>& all, const glm::dvec4& light, const View& view,
                                  const Receivers& receivers) {
    std::vector<BeamBox> boxes;
    double farthest = 0;
    for (const Volume& volume : all) {
        boxes.push_back(volume.box());
        const glm::dvec3 most = glm::max(glm::abs(volume.box().low), glm::abs(volume.box().high));
        farthest = std::max({farthest, most.x, most.y, most.z});
    }
    const Tree tree(std::move(boxes));
    std::vector<WindowRect> windows(all.size());
    std::vector<std::uint32_t> found;
    // In leaps, so that rectangles grow early: what they hold is not asked again.
    leapOver(groupsOf(receivers), [&](const PatchGroup& group) {
        found.clear();
        Beam whole(group.corners(view), light, farthest);
        tree.find(whole, [&](std::uint32_t v) {
            if (holds(windows[v], group.pixels)) return false;
            if (!all[v].isQuick() || all[v].reaches(whole)) found.push_back(v);
            return false;
        });
        if (found.empty()) return;
        leapOver(group.patches, [&](const Receivers::Patch* patch) {
            std::optional<Beam> beam;
            for (const std::uint32_t v : found) {
                if (holds(windows[v], patch->pixels)) continue;
                if (!beam) beam.emplace(receivers.corners(*patch), light, farthest);
                if (!beam->misses(all[v].box()) && all[v].reaches(*beam))
                    windows[v] = around(windows[v], patch->pixels);
            }
        });
    });
    return windows;
}

/// The near rectangle.
struct NearRectangle {
    std::array<glm::dvec3, 4> corners{};
    glm::dvec3 centre{}, right{}, up{}, forward{};

    explicit NearRectangle(const View& view) : right(view.right), up(view.up), forward(view.forward) {
        const glm::dvec3 x = view.nearPlane * view.tanHalfX * right, y = view.nearPlane * view.tanHalfY * up;
        centre = view.nearPlane * forward;
        corners = {centre - x - y, centre + x - y, centre + x + y, centre - x + y};
    }
};

/// A lower bound of the distance between the rectangle and the convex hull of points that are extruded from
/// the light; 0 or less if none is found. Of all directions in which two convex polyhedra that do not meet
/// can be told apart, one is always the normal of a face or normal to an edge of each.
double gapBetween(const NearRectangle& rectangle, std::span<const glm::dvec3> points,
                  std::span<const glm::dvec3> edges, std::span<const glm::dvec3> normals,
                  const glm::dvec4& light) {
    std::array<glm::dvec3, 8> rays{};
    double size = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        rays[i] = points[i] * light.w - glm::dvec3(light);
        size = std::max(size, glm::length(points[i]));
    }
    double widest = 0;
    const auto tryOne = [&](const glm::dvec3& direction) {
        const double length = glm::length(direction);
        if (length == 0) return;
        const glm::dvec3 n = direction / length;
        double nearest = kInfinity, farthest = -kInfinity;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (glm::dot(n, rays[i]) < -1e-14 * glm::length(rays[i])) return;
            nearest = std::min(nearest, glm::dot(n, points[i]));
        }
        for (const glm::dvec3& corner : rectangle.corners) farthest = std::max(farthest, glm::dot(n, corner));
        widest = std::max(widest, nearest - farthest);
    };
    const auto tryBoth = [&](const glm::dvec3& direction) { tryOne(direction), tryOne(-direction); };
    tryBoth(rectangle.forward), tryBoth(rectangle.right), tryBoth(rectangle.up);
    for (const glm::dvec3& normal : normals) tryBoth(normal);
    for (const glm::dvec3& edge : edges) {
        tryBoth(glm::cross(edge, rectangle.right)), tryBoth(glm::cross(edge, rectangle.up));
        for (std::size_t i = 0; i < points.size(); ++i) tryBoth(glm::cross(edge, rays[i]));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        tryBoth(glm::cross(rays[i], rectangle.right)), tryBoth(glm::cross(rays[i], rectangle.up));
        tryOne(points[i] - rectangle.centre);  // not needed to tell them apart, but often wider
        for (const glm::dvec3& corner : rectangle.corners) tryOne(points[i] - corner);
    }
    return widest - kRounding * (size + glm::length(rectangle.corners[0]));
}

double nearDistance(const Scene& scene, const Volume& volume, const glm::vec4& light,
                    const glm::dvec4& fromEye, const View& view) {
    if (touchesNearRectangle(scene, volume.caster(), light, view)) return 0;
    const NearRectangle rectangle(view);
    const std::array<glm::dvec3, 3> axes{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    std::array<glm::dvec3, 8> box;
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k)
            box[std::size_t(i)][k] = (i >> k) & 1 ? volume.box().high[k] : volume.box().low[k];
    const double gap = gapBetween(rectangle, box, axes, axes, fromEye);
    if (gap > 0) return gap;
    // The volume itself, as all that its triangles hide.
    double nearest = kInfinity;
    for (const glm::uvec3& t : volume.caps()) {
        const std::array<glm::dvec3, 3> p{volume.at(t.x), volume.at(t.y), volume.at(t.z)};
        const std::array<glm::dvec3, 3> edges{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
        const std::array<glm::dvec3, 1> normal{glm::cross(edges[0], edges[1])};
        nearest = std::min(nearest, gapBetween(rectangle, p, edges, normal, fromEye));
    }
    // They do not meet, for the test above is certain; but how far they are apart is lost in rounding.
    return std::max(nearest, std::numeric_limits<double>::min());
}

}  // namespace

Reach reachOf(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light, const View& view,
              const Receivers& receivers) {
    std::vector<Volume> all = volumes(scene, lit, view.eye);
    const glm::dvec4 fromEye(glm::dvec3(light) - double(light.w) * view.eye, light.w);
    Reach reach{.windows = windowsOf(all, fromEye, view, receivers)};
    for (const Volume& volume : all)
        reach.nearDistances.push_back(nearDistance(scene, volume, light, fromEye, view));
    return reach;
}

double surfaceDistance(const Scene& scene, const View& view) {
    // The view's pyramid and a pixel more, in eye space with z forward.
    const double limitX = view.tanHalfX * (1 + 2.0 / view.width),
                 limitY = view.tanHalfY * (1 + 2.0 / view.height);
    const std::array<glm::dvec3, 4> borders{glm::dvec3(-1, 0, limitX), glm::dvec3(1, 0, limitX),
                                            glm::dvec3(0, -1, limitY), glm::dvec3(0, 1, limitY)};
    const double near = view.nearPlane * (1 - kRounding);
    double nearest = kInfinity;
    std::vector<glm::dvec3> polygon, kept;
    for (const Object& object : scene.objects) {
        for (const glm::uvec3& t : object.mesh.triangles) {
            polygon.clear();
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 p = glm::dvec3(object.mesh.positions[t[k]]) - view.eye;
                polygon.emplace_back(glm::dot(p, view.right), glm::dot(p, view.up),
                                     glm::dot(p, view.forward));
            }
            const auto [low, high] = std::minmax({polygon[0].z, polygon[1].z, polygon[2].z});
            if (high < near || low >= nearest) continue;
            for (const glm::dvec3& border : borders) {
                kept.clear();
                for (std::size_t i = 0; i < polygon.size(); ++i) {
                    const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                    const double atA = glm::dot(border, a), atB = glm::dot(border, b);
                    if (atA >= 0) kept.push_back(a);
                    if ((atA >= 0) != (atB >= 0)) kept.push_back((atA * b - atB * a) / (atA - atB));
                }
                polygon.swap(kept);
            }
            // What lies before the near plane is not drawn; what reaches across is cut there.
            double least = kInfinity, most = -kInfinity;
            for (const glm::dvec3& p : polygon) least = std::min(least, p.z), most = std::max(most, p.z);
            if (most >= near) nearest = std::min(nearest, std::max(least * (1 - kRounding), view.nearPlane));
        }
    }
    return nearest - view.nearPlane;
}

}  // namespace gnomon
