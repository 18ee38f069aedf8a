#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "predict/cone.h"
#include "predict/pixel_block.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "truth/truth.h"

namespace gnomon {

/// A triangle of a scene.
struct SurfaceFace {
    std::uint32_t object = 0;
    glm::uvec3 corners{};  ///< vertices
};

/// All triangles of a scene.
std::vector<SurfaceFace> surfaceFaces(const Scene& scene);

/// A surface that one pixel may see; without a face it is the background.
struct Seen {
    const SurfaceFace* face = nullptr;
    double inverse = 0;  ///< 1 / distance; parallel rays: 1 - window depth
    glm::dvec2 slope{};  ///< of its window depth
    bool isSure = true, holds = true;
};

enum class Rays {
    FromEye,
    Parallel,  ///< a view of LightMap
};

/// Finds the surfaces that the pixels of a view may see, in exact arithmetic and however a rasteriser rounds
/// corners (to 1/256 pixel) and depths, block by block of pixels.
class SeenSurfaces {
  public:
    /// @param scene  must outlive it
    /// @param ties   of the depths of two surfaces
    /// @param blockWidth  of a block, pixels; so is @p blockHeight
    SeenSurfaces(const Scene& scene, std::vector<SurfaceFace> faces, const View& view, const DepthTies& ties,
                 int blockWidth, int blockHeight, Rays rays = Rays::FromEye);
    // What was found points to the faces.
    SeenSurfaces(SeenSurfaces&&) = default;

    const View& view() const { return m_view; }
    int blockColumns() const { return m_blockColumns; }
    int blockRows() const { return m_blockRows; }
    PixelBlock block(int column, int row) const;

    /// What each pixel of a block may see, by PixelBlock::slot(): the surface that is seen in exact
    /// arithmetic first. Valid until the next call.
    std::span<const std::vector<Seen>> find(int column, int row);

    /// The faces that a block may see.
    std::span<const std::uint32_t> facesIn(int column, int row) const {
        return m_blocks[std::size_t(row) * std::size_t(m_blockColumns) + std::size_t(column)];
    }
    const SurfaceFace& face(std::uint32_t index) const { return m_faces[index]; }

    Cone coneOf(const SurfaceFace& face) const;
    /// What depths near 1 / @p inverse may be off by, in window depth.
    double bandOf(double inverse) const { return m_ties.bandAt(1 - m_view.nearPlane * inverse); }

  private:
    glm::dvec3 at(const SurfaceFace& face, int corner) const {
        return m_scene->objects[face.object].mesh.positions[face.corners[corner]];
    }
    PixelBlock reach(const SurfaceFace& face) const;
    void findFace(const SurfaceFace& face, const PixelBlock& block);
    void keepVisible(std::vector<Seen>& hits) const;

    const Scene* m_scene;
    std::vector<SurfaceFace> m_faces;
    View m_view;
    DepthTies m_ties;
    int m_blockWidth, m_blockHeight, m_blockColumns, m_blockRows;
    Rays m_rays;
    std::vector<std::vector<std::uint32_t>> m_blocks{};  ///< faces that a block may see
    std::vector<std::vector<Seen>> m_hits{};             ///< of one block
};

}  // namespace gnomon
