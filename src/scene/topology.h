#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace gnomon {

/// An edge by the places of its ends: these are the same whatever the order of vertices and triangles.
using Edge = std::array<glm::vec3, 2>;

/// How the triangles of a mesh hang together. Independent of the order of vertices and triangles, and of the
/// corner with which a triangle begins.
struct Topology {
    std::size_t triangles = 0;
    std::size_t vertices = 0;  ///< that a triangle uses
    std::size_t edges = 0;
    std::map<int, std::size_t> valences{};  ///< number of triangles at an edge -> number of such edges
    std::size_t windingConflicts = 0;       ///< edges whose two triangles run along them the same way
    std::size_t unbalancedEdges = 0;        ///< edges that are run along more often one way than the other
    std::size_t duplicates = 0;             ///< triangles beyond the first on the same three vertices
    std::size_t duplicatesSameWay = 0;      ///< those among them that have the orientation of another
    std::size_t tJunctions = 0;             ///< vertices inside of boundary edges: tJunctions()
    std::size_t components = 0;             ///< pieces connected by vertices
    std::size_t bowTies = 0;                ///< fans at a vertex beyond its first

    /// One of each kind, the least by coordinates.
    std::optional<Edge> boundaryEdge{}, nonManifoldEdge{}, conflictEdge{}, unbalancedEdge{};

    std::size_t boundaryEdges() const;     ///< edges of one triangle
    std::size_t nonManifoldEdges() const;  ///< edges of three or more
    int maxValence() const;                ///< 0 without any edge
    long euler() const;                    ///< vertices - edges + triangles

    /// Along every edge the two directions cancel: volumes of all its triangles close, manifold or not.
    bool isBalanced() const { return unbalancedEdges == 0; }
    /// Every edge has two triangles that run along it opposite ways, every vertex one fan.
    bool isClosedManifold() const;
    std::optional<long> genus() const;  ///< summed over the components; of closed manifolds only
};

/// Counts in time proportional to the mesh.
/// @pre no triangle repeats a vertex
Topology topologyOf(const Mesh& mesh);

/// In a few words: "closed manifold, genus 1"; "open, non-manifold".
std::string describe(const Topology& topology);

}  // namespace gnomon
