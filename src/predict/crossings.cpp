#include "predict/crossings.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "predict/cone.h"
#include "predict/pixel_block.h"
#include "predict/seen_surfaces.h"

namespace gnomon {
namespace {

constexpr int kBandRows = 16;
constexpr double kInverseRounding = 1e-12;

/// A face of a volume that is yet to be made a cone of.
struct FaceSource {
    Piece piece = Piece::LightCap;
    std::uint32_t volume = 0;
    std::uint32_t object = 0;
    glm::uvec3 corners{};  ///< vertices; of a side two
    int weight = 1;
};

glm::uvec3 sorted(glm::uvec3 t) {
    if (t.x > t.y) std::swap(t.x, t.y);
    if (t.y > t.z) std::swap(t.y, t.z);
    if (t.x > t.y) std::swap(t.x, t.y);
    return t;
}

class Finder {
  public:
    Finder(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light, const View& view,
           const DepthTies& ties, float offset)
        : m_scene(scene),
          m_light(light),
          m_view(view),
          m_offset(offset),
          m_surfaces(scene, surfaceFaces(scene), view, ties, view.width, kBandRows) {
        listVolumes(lit);
        m_bands.resize(std::size_t(m_surfaces.blockRows()));
        assignVolumes();
        m_found.resize(std::size_t(kBandRows) * std::size_t(view.width));
    }

    Crossings find() {
        m_out.width = m_view.width, m_out.height = m_view.height;
        m_out.exact.resize(std::size_t(m_view.width) * std::size_t(m_view.height));
        for (int row = 0; row < int(m_bands.size()); ++row) {
            const PixelBlock band = m_surfaces.block(0, row);
            m_hits = m_surfaces.find(0, row);
            for (auto& alternatives : m_found) alternatives.clear();
            for (const std::uint32_t v : m_bands[std::size_t(row)]) findFace(m_volumes[v], band);
            sign(band);
        }
        return std::move(m_out);
    }

  private:
    void listVolumes(std::span<const LitCaster> lit) {
        std::uint32_t volume = 0;
        const auto add = [&](const LitCaster& caster, std::span<const glm::uvec3> caps,
                             std::span<const Side> sides) {
            for (const Side& side : sides)
                m_volumes.push_back(
                    {Piece::Side, volume, caster.object, {side.from, side.to, 0}, side.weight});
            for (const glm::uvec3& cap : caps) {
                m_volumes.push_back({Piece::LightCap, volume, caster.object, cap});
                m_volumes.push_back({Piece::NearCap, volume, caster.object, cap});
                if (m_light.w != 0) m_volumes.push_back({Piece::FarCap, volume, caster.object, cap});
            }
            ++volume;
        };
        for (const LitCaster& caster : lit) {
            if (caster.lit.empty()) continue;
            if (!caster.perTriangle) {
                add(caster, caster.lit, caster.sides);
                continue;
            }
            for (std::size_t i = 0; i < caster.lit.size(); ++i)
                add(caster, {&caster.lit[i], 1}, std::span(caster.sides).subspan(3 * i, 3));
        }
    }

    glm::dvec3 at(const FaceSource& face, int corner) const {
        return m_scene.objects[face.object].mesh.positions[face.corners[corner]];
    }

    /// Where a volume's vertex stands.
    glm::dvec3 start(const FaceSource& face, int corner) const {
        const glm::dvec3 p = at(face, corner);
        if (m_offset == 0) return p;
        const glm::dvec3 l(m_light);
        return p + double(m_offset) * glm::normalize(m_light.w == 0 ? -l : p - l);
    }

    Cone coneOf(const FaceSource& face) const {
        switch (face.piece) {
            case Piece::Side:
            case Piece::NearSide:
                return Cone::side(m_view, start(face, 0), start(face, 1), m_light);
            case Piece::FarCap:
                return Cone::farCap(m_view, at(face, 0), at(face, 1), at(face, 2), m_light);
            case Piece::NearCap:
                return Cone::nearCap(m_view, at(face, 0), at(face, 1), at(face, 2), m_light);
            case Piece::LightCap:
            case Piece::NearLightCap:
                break;
        }
        return Cone::triangle(m_view, start(face, 0), start(face, 1), start(face, 2));
    }

    /// Corners of the face as directions from the eye, those at infinity as directions; none for near caps.
    void directions(const FaceSource& face, std::vector<glm::dvec3>& out) const {
        out.clear();
        const glm::dvec3 l(m_light);
        const int finite = face.piece == Piece::Side ? 2 : face.piece == Piece::LightCap ? 3 : 0;
        for (int k = 0; k < finite; ++k) out.push_back(start(face, k) - m_view.eye);
        const int infinite = face.piece == Piece::Side ? 2 : face.piece == Piece::FarCap ? 3 : 0;
        for (int k = 0; k < infinite; ++k)
            out.push_back(m_light.w == 0 ? -l
                                         : (face.piece == Piece::Side ? start(face, k) : at(face, k)) - l);
    }

    /// The rows that a face may touch: [first, second), from the bottom.
    std::pair<int, int> rowsOf(const FaceSource& face) {
        if (face.piece != Piece::NearCap) {
            directions(face, m_corners);
            if (const auto block = blockOf(m_view, m_corners))
                return block->isEmpty() ? std::pair(0, 0) : std::pair(block->bottom, block->top);
        }
        if (coneOf(face).missesWindow(m_view.width, m_view.height, kCorner)) return {0, 0};
        return {0, m_view.height};
    }

    void assignVolumes() {
        for (std::uint32_t i = 0; i < m_volumes.size(); ++i) {
            const auto [first, last] = rowsOf(m_volumes[i]);
            for (int band = first / kBandRows; band * kBandRows < last; ++band)
                m_bands[std::size_t(band)].push_back(i);
        }
    }

    EyeRay rayAt(double x, double y) const { return {m_view.eye, rayDirection(m_view, x, y)}; }

    void findFace(const FaceSource& face, const PixelBlock& band) {
        const Cone cone = coneOf(face);
        const glm::dvec2 slope = depthSlope(cone.inverseDistance(), m_view.nearPlane);
        const bool splits = face.piece == Piece::Side || face.piece == Piece::LightCap;
        const double nearSlack = splits ? kCorner * glm::length(slope) + kNearRounding : 0;
        const glm::uvec3 own = face.piece == Piece::LightCap ? sorted(face.corners) : glm::uvec3(0);
        eachPixel(cone, m_view, band, [&](std::size_t slot, double x, double y, bool isSure, bool holds) {
            const double inverse = cone.inverseDistance().at(x, y);
            const double depth = 1 - m_view.nearPlane * inverse;
            const auto& seen = m_hits[slot];
            auto& alternatives = m_found[slot];
            alternatives.resize(seen.size());
            for (std::size_t s = 0; s < seen.size(); ++s) {
                Crossing c{.volume = face.volume, .piece = face.piece, .front = cone.isFront()};
                bool covers = isSure, has = holds;
                const bool isOwnCap = splits && isOwn(face, own, seen[s]);
                if (isOwnCap && face.piece == Piece::LightCap && m_offset == 0) {
                    // The same polygon as the surface: drawn where it is, at its depth to the bit.
                    c.own = true;
                    c.exact = c.possible = kAt;
                    add(alternatives[s], c, face.weight);
                    continue;
                }
                c.own = isOwnCap;
                if (splits && depth < nearSlack) {
                    // Before the near plane, or perhaps.
                    Crossing near = c;
                    near.piece = face.piece == Piece::Side ? Piece::NearSide : Piece::NearLightCap;
                    const bool sureNear = depth < -nearSlack;
                    relate(near, seen[s], m_view.nearPlane > 0 ? 1 / m_view.nearPlane : 0, {}, x, y, nullptr,
                           covers && sureNear, has && depth < 0);
                    add(alternatives[s], near, face.weight);
                    if (sureNear) continue;
                    covers = false;
                    has = has && depth >= 0;
                }
                relate(c, seen[s], inverse, slope, x, y, splits ? &cone : nullptr, covers, has);
                add(alternatives[s], c, face.weight);
            }
        });
    }

    /// Whether the face is the cap of the seen triangle, or a side from one of its edges.
    bool isOwn(const FaceSource& face, const glm::uvec3& sortedCap, const Seen& seen) const {
        if (!seen.face || seen.face->object != face.object) return false;
        const glm::uvec3& t = seen.face->corners;
        if (face.piece == Piece::LightCap) return sorted(t) == sortedCap;
        const auto has = [&](std::uint32_t v) { return t.x == v || t.y == v || t.z == v; };
        return has(face.corners.x) && has(face.corners.y);
    }

    static void add(Signature& signature, const Crossing& c, int times) {
        for (int i = 0; i < times; ++i) signature.push_back(c);
    }

    /// Where the face lies with regard to a surface, exactly and possibly.
    /// @pre what @p covers the pixel however corners are rounded holds its ray
    void relate(Crossing& c, const Seen& seen, double inverse, const glm::dvec2& slope, double x, double y,
                const Cone* cone, bool covers, bool holds) const {
        assert(holds || !covers);
        const double behind = m_view.nearPlane * (seen.inverse - inverse);
        const double slack = m_surfaces.bandOf(seen.inverse) + kCorner * glm::length(slope - seen.slope);
        std::uint8_t possible = kBefore | kAt | kBehind;
        if (behind > slack) possible = kBehind;
        if (behind < -slack) possible = kBefore;
        // Nothing lies behind the background, nor before the near plane or beyond infinity.
        if (!seen.face) possible &= kBefore | kAt;
        if (c.piece == Piece::FarCap) possible &= kAt | kBehind;
        if (c.piece == Piece::FarCap && !seen.face) possible = kAt;
        if (c.piece == Piece::NearCap || c.piece == Piece::NearSide || c.piece == Piece::NearLightCap)
            possible &= kBefore | kAt;
        if (possible == 0) possible = kAt;

        c.exact = kAbsent;
        if (holds) {
            const double rounding = kInverseRounding * m_view.nearPlane * (seen.inverse + inverse);
            double exact = behind;
            if (std::abs(behind) <= rounding && cone && seen.face)
                exact = exactlyBehind(*cone, *seen.face, x, y);
            c.exact = exact > 0 ? kBehind : exact < 0 ? kBefore : kAt;
            if ((c.exact & possible) == 0)  // a depth that ends at that of infinity, or of the near plane
                c.exact = (possible & kAt) ? std::uint8_t(kAt) : possible;
        }
        c.possible = covers ? possible : std::uint8_t(possible | kMaybeAbsent);
    }

    /// Sign of the face's depth less that of a surface's plane along the same ray.
    double exactlyBehind(const Cone& face, const SurfaceFace& surface, double x, double y) const {
        const EyeRay ray = rayAt(x, y);
        const Rational difference = m_surfaces.coneOf(surface).exactInverse(ray) - face.exactInverse(ray);
        return difference.sign();
    }

    /// Turns what was found in a band into signatures.
    void sign(const PixelBlock& band) {
        for (int row = band.bottom; row < band.top; ++row) {
            for (int column = 0; column < m_view.width; ++column) {
                const std::size_t slot = band.slot(column, row);
                const auto pixel = std::uint32_t((m_view.height - 1 - row) * m_view.width + column);
                auto& alternatives = m_found[slot];
                alternatives.resize(m_hits[slot].size());
                m_out.exact[pixel] = signatureOf(alternatives[0]);
                for (std::size_t a = 1; a < alternatives.size(); ++a) {
                    const std::uint32_t id = signatureOf(alternatives[a]);
                    if (id == m_out.exact[pixel]) continue;
                    auto& others = m_out.others[pixel];
                    if (std::find(others.begin(), others.end(), id) == others.end()) others.push_back(id);
                }
            }
        }
    }

    std::uint32_t signatureOf(Signature& crossings) {
        std::sort(crossings.begin(), crossings.end());
        std::uint64_t hash = 14695981039346656037ull;
        for (const Crossing& c : crossings) {
            const std::uint64_t word = (std::uint64_t(c.volume) << 20) | (std::uint64_t(c.piece) << 16) |
                                       (std::uint64_t(c.front) << 13) | (std::uint64_t(c.own) << 12) |
                                       (std::uint64_t(c.exact) << 4) | c.possible;
            hash = (hash ^ word) * 1099511628211ull;
            hash ^= hash >> 29;
        }
        auto& same = m_known[hash];
        for (const std::uint32_t id : same)
            if (m_out.signatures[id] == crossings) return id;
        same.push_back(std::uint32_t(m_out.signatures.size()));
        m_out.signatures.push_back(crossings);
        return same.back();
    }

    const Scene& m_scene;
    const glm::vec4 m_light;
    const View& m_view;
    const float m_offset;
    SeenSurfaces m_surfaces;
    std::vector<FaceSource> m_volumes{};
    std::vector<std::vector<std::uint32_t>> m_bands{};  ///< faces of volumes that a band of rows may see
    std::vector<glm::dvec3> m_corners{};

    // Of one band, by pixel
    std::span<const std::vector<Seen>> m_hits{};
    std::vector<std::vector<Signature>> m_found{};  ///< for each surface that may be seen

    Crossings m_out{};
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> m_known{};
};

}  // namespace

std::size_t volumeCount(std::span<const LitCaster> lit) {
    std::size_t count = 0;
    for (const LitCaster& caster : lit)
        count += caster.perTriangle ? caster.lit.size() : std::size_t(!caster.lit.empty());
    return count;
}

int volumesAround(const Signature& signature) {
    int count = 0;
    for (const Crossing& c : signature) {
        const bool counts = c.piece == Piece::NearCap || (c.piece == Piece::Side && c.exact == kBefore) ||
                            // Where nothing is seen all that enters leaves at infinity.
                            (c.piece == Piece::FarCap && c.exact == kAt) ||
                            (c.piece == Piece::Side && c.exact == kAt);
        if (counts && c.exact != kAbsent) count += c.front ? 1 : -1;
    }
    return count;
}

Crossings crossingsOf(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                      const View& view, const DepthTies& ties, float offset) {
    return Finder(scene, lit, light, view, ties, offset).find();
}

}  // namespace gnomon
