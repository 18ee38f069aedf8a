#include "scene/t_junctions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "scene/buckets.h"

namespace gnomon {
namespace {

constexpr double kTolerance = 1e-6;  ///< of the diagonal

using Segment = std::array<std::uint32_t, 2>;

std::vector<Segment> boundaryOf(const Mesh& mesh) {
    const Buckets<std::uint32_t> uses(mesh.positions.size(), [&](const auto& add) {
        for (const glm::uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax({t[k], t[(k + 1) % 3]});
                add(low, high);
            }
    });
    std::vector<Segment> boundary;
    uses.forEachRun([](std::uint32_t high) { return high; },
                    [&](std::uint32_t low, std::span<const std::uint32_t> run) {
                        if (run.size() == 1) boundary.push_back({low, run[0]});
                    });
    return boundary;
}

struct Box {
    glm::dvec3 least{std::numeric_limits<double>::infinity()};
    glm::dvec3 most{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& p) {
        least = glm::min(least, p);
        most = glm::max(most, p);
    }
};

/// Whether the way from @p a to @p b comes within @p margin of the box, along each axis.
bool passes(const Box& box, const glm::dvec3& a, const glm::dvec3& b, double margin) {
    double enter = 0, leave = 1;
    for (int k = 0; k < 3; ++k) {
        const double least = box.least[k] - margin, most = box.most[k] + margin, way = b[k] - a[k];
        if (way == 0) {
            if (a[k] < least || a[k] > most) return false;
            continue;
        }
        const double first = (least - a[k]) / way, last = (most - a[k]) / way;
        enter = std::max(enter, std::min(first, last));
        leave = std::min(leave, std::max(first, last));
    }
    return enter <= leave;
}

/// A k-d tree of vertices.
class Tree {
  public:
    Tree(const Mesh& mesh, std::vector<std::uint32_t> vertices)
        : m_mesh(mesh), m_vertices(std::move(vertices)) {
        if (!m_vertices.empty()) build(0, m_vertices.size());
    }

    /// Calls @p found(vertex) for all vertices in leaves that the way passes.
    template <class Found>
    void along(const glm::dvec3& a, const glm::dvec3& b, double margin, const Found& found) const {
        std::vector<std::size_t>& rest = m_rest;
        rest.assign(m_nodes.empty() ? 0 : 1, 0);
        while (!rest.empty()) {
            const Node& node = m_nodes[rest.back()];
            const std::size_t left = rest.back() + 1;
            rest.pop_back();
            if (!passes(node.box, a, b, margin)) continue;
            if (node.right == 0) {
                for (std::size_t i = node.begin; i < node.end; ++i) found(m_vertices[i]);
            } else {
                rest.insert(rest.end(), {left, node.right});
            }
        }
    }

    /// The vertices so that neighbours in space are mostly neighbours here.
    const std::vector<std::uint32_t>& order() const { return m_vertices; }

  private:
    static constexpr std::size_t kLeaf = 8;

    struct Node {
        Box box{};
        std::size_t begin = 0, end = 0;
        std::size_t right = 0;  ///< the left child comes next; 0: a leaf
    };

    void build(std::size_t begin, std::size_t end) {
        const std::size_t index = m_nodes.size();
        Node node{.begin = begin, .end = end};
        for (std::size_t i = begin; i < end; ++i) node.box.add(m_mesh.positions[m_vertices[i]]);
        m_nodes.push_back(node);
        if (end - begin <= kLeaf) return;
        const glm::dvec3 size = node.box.most - node.box.least;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) { return m_vertices.begin() + std::ptrdiff_t(i); };
        std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
            return m_mesh.positions[a][axis] < m_mesh.positions[b][axis];
        });
        build(begin, middle);
        m_nodes[index].right = m_nodes.size();
        build(middle, end);
    }

    const Mesh& m_mesh;
    std::vector<std::uint32_t> m_vertices;
    std::vector<Node> m_nodes{};
    mutable std::vector<std::size_t> m_rest{};
};

}  // namespace

std::size_t tJunctions(const Mesh& mesh) {
    std::vector<Segment> boundary = boundaryOf(mesh);
    std::vector<std::uint32_t> ends;
    for (const Segment& s : boundary) ends.insert(ends.end(), s.begin(), s.end());
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    if (ends.empty()) return 0;

    Box box;
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) box.add(mesh.positions[t[k]]);
    const double tolerance = kTolerance * glm::distance(box.least, box.most);

    const Tree tree(mesh, ends);
    // In the tree's order: one way finds the nodes of the last in the cache.
    std::vector<std::uint32_t> rank(mesh.positions.size());
    for (std::uint32_t i = 0; i < tree.order().size(); ++i) rank[tree.order()[i]] = i;
    std::sort(boundary.begin(), boundary.end(),
              [&](const Segment& s, const Segment& t) { return rank[s[0]] < rank[t[0]]; });

    std::vector<bool> isInside(mesh.positions.size());
    for (const Segment& s : boundary) {
        const glm::dvec3 a(mesh.positions[s[0]]), b(mesh.positions[s[1]]);
        const double length = glm::distance(a, b);
        const glm::dvec3 direction = (b - a) / length;
        tree.along(a, b, tolerance, [&](std::uint32_t vertex) {
            const glm::dvec3 offset = glm::dvec3(mesh.positions[vertex]) - a;
            const double distance = glm::dot(offset, direction);
            if (distance > tolerance && distance < length - tolerance &&
                glm::length(offset - distance * direction) <= tolerance)
                isInside[vertex] = true;
        });
    }
    return std::size_t(std::count(isInside.begin(), isInside.end(), true));
}

}  // namespace gnomon
