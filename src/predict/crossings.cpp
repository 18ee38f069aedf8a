#include "predict/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "predict/cone.h"
#include "truth/count_ties.h"
#include "volume/orient.h"

namespace gnomon {
namespace {

constexpr int kBandRows = 16;
/// How far a rasteriser may move a corner, pixels.
constexpr double kCorner = 1.4142135623730951 * kSubpixel;
constexpr double kNearRounding = 1e-6;  ///< of a cut at the near plane, in window depth
constexpr double kInverseRounding = 1e-12;

/// A face that is yet to be made a cone of: of the scene's surfaces, or of volumes.
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

/// The slope of window depth over the window; depth is 1 - near / distance.
glm::dvec2 depthSlope(const WindowLine& inverse, double near) {
    return -near * glm::dvec2(inverse.x, inverse.y);
}

/// A surface that one pixel may see; without a face it is the background.
struct Seen {
    const FaceSource* face = nullptr;
    double inverse = 0;  ///< 1 / distance
    glm::dvec2 slope{};  ///< of its window depth
    bool isSure = true, holds = true;
};

class Finder {
  public:
    Finder(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light, const View& view,
           const DepthTies& ties, float offset)
        : m_scene(scene), m_light(light), m_view(view), m_ties(ties), m_offset(offset) {
        listSurfaces();
        listVolumes(lit);
        const std::size_t bands = std::size_t((view.height + kBandRows - 1) / kBandRows);
        m_surfaceBands.resize(bands);
        m_volumeBands.resize(bands);
        assign(m_surfaces, m_surfaceBands);
        assign(m_volumes, m_volumeBands);
        m_hits.resize(std::size_t(kBandRows) * std::size_t(view.width));
        m_found.resize(m_hits.size());
    }

    Crossings find() {
        m_out.width = m_view.width, m_out.height = m_view.height;
        m_out.exact.resize(std::size_t(m_view.width) * std::size_t(m_view.height));
        for (int band = 0; band < int(m_surfaceBands.size()); ++band) {
            // Bands from the bottom, as the window's y.
            const int first = band * kBandRows, last = std::min(first + kBandRows, m_view.height);
            for (auto& hits : m_hits) hits.clear();
            for (auto& alternatives : m_found) alternatives.clear();
            for (const std::uint32_t s : m_surfaceBands[std::size_t(band)])
                findSurface(m_surfaces[s], first, last);
            for (auto& hits : m_hits) keepVisible(hits);
            for (const std::uint32_t v : m_volumeBands[std::size_t(band)])
                findFace(m_volumes[v], first, last);
            sign(first, last);
        }
        return std::move(m_out);
    }

  private:
    using Bands = std::vector<std::vector<std::uint32_t>>;

    void listSurfaces() {
        for (std::uint32_t o = 0; o < m_scene.objects.size(); ++o)
            for (const glm::uvec3& t : m_scene.objects[o].mesh.triangles)
                m_surfaces.push_back({.object = o, .corners = t});
    }

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

    Cone coneOf(const FaceSource& face, bool isSurface) const {
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
        if (isSurface) return Cone::triangle(m_view, at(face, 0), at(face, 1), at(face, 2));
        return Cone::triangle(m_view, start(face, 0), start(face, 1), start(face, 2));
    }

    /// Corners of the face as directions from the eye, those at infinity as directions; none for near caps.
    void directions(const FaceSource& face, bool isSurface, std::vector<glm::dvec3>& out) const {
        out.clear();
        const glm::dvec3 l(m_light);
        const int finite = face.piece == Piece::Side ? 2 : face.piece == Piece::LightCap ? 3 : 0;
        for (int k = 0; k < finite; ++k)
            out.push_back((isSurface ? at(face, k) : start(face, k)) - m_view.eye);
        const int infinite = face.piece == Piece::Side ? 2 : face.piece == Piece::FarCap ? 3 : 0;
        for (int k = 0; k < infinite; ++k)
            out.push_back(m_light.w == 0 ? -l
                                         : (face.piece == Piece::Side ? start(face, k) : at(face, k)) - l);
    }

    /// Which rows, from the bottom, a face may touch.
    std::pair<int, int> rowsOf(const FaceSource& face, bool isSurface) {
        const std::pair<int, int> none{0, 0}, all{0, m_view.height};
        if (face.piece == Piece::NearCap) {
            const Cone cone = coneOf(face, isSurface);
            return cone.missesWindow(m_view.width, m_view.height, kCorner) ? none : all;
        }
        directions(face, isSurface, m_corners);
        double low = m_view.height, high = 0, left = m_view.width, right = 0;
        bool anyInFront = false, allInFront = true;
        for (const glm::dvec3& d : m_corners) {
            const double w = glm::dot(d, m_view.forward);
            const bool isInFront = w > 1e-9 * glm::length(d);
            anyInFront = anyInFront || w > 0;
            allInFront = allInFront && isInFront;
            if (!isInFront) continue;
            const double x = (glm::dot(d, m_view.right) / (w * m_view.tanHalfX) + 1) / 2 * m_view.width;
            const double y = (glm::dot(d, m_view.up) / (w * m_view.tanHalfY) + 1) / 2 * m_view.height;
            low = std::min(low, y), high = std::max(high, y);
            left = std::min(left, x), right = std::max(right, x);
        }
        if (!anyInFront) return none;
        if (!allInFront)
            return coneOf(face, isSurface).missesWindow(m_view.width, m_view.height, kCorner) ? none : all;
        constexpr double kBeside = 1;
        if (high < -kBeside || low > m_view.height + kBeside || right < -kBeside ||
            left > m_view.width + kBeside)
            return none;
        return {std::max(0, int(std::floor(std::max(low, 0.0) - kBeside))),
                int(std::ceil(std::min(high, double(m_view.height)) + kBeside))};
    }

    void assign(const std::vector<FaceSource>& faces, Bands& bands) {
        for (std::uint32_t i = 0; i < faces.size(); ++i) {
            const auto [first, last] = rowsOf(faces[i], &faces == &m_surfaces);
            const int end = std::min(last, m_view.height);
            for (int band = first / kBandRows; band * kBandRows < end; ++band)
                bands[std::size_t(band)].push_back(i);
        }
    }

    EyeRay rayAt(double x, double y) const { return {m_view.eye, rayDirection(m_view, x, y)}; }

    /// Calls @p visit(slot, x, y, isSure, holds) for each pixel of the rows [first, last) that the cone may
    /// cover.
    template <class Visit>
    void eachPixel(const Cone& cone, int first, int last, const Visit& visit) {
        if (cone.isEmpty()) return;
        const double slack = kCorner + cone.insideError();
        for (int row = first; row < last; ++row) {
            const double y = row + 0.5;
            const auto [begin, end] = cone.columns(y, kCorner, m_view.width);
            for (int column = begin; column < end; ++column) {
                const double x = column + 0.5, inside = cone.inside(x, y);
                const bool isSure = inside > slack;
                const bool holds =
                    isSure ||
                    (std::abs(inside) > cone.insideError() ? inside > 0 : cone.holds(rayAt(x, y), x, y));
                visit(std::size_t(row - first) * std::size_t(m_view.width) + std::size_t(column), x, y,
                      isSure, holds);
            }
        }
    }

    void findSurface(const FaceSource& face, int first, int last) {
        const Cone cone = coneOf(face, true);
        const glm::dvec2 slope = depthSlope(cone.inverseDistance(), m_view.nearPlane);
        const double nearSlack = kCorner * glm::length(slope) + kNearRounding;
        eachPixel(cone, first, last, [&](std::size_t slot, double x, double y, bool isSure, bool holds) {
            const double inverse = cone.inverseDistance().at(x, y);
            const double depth = 1 - m_view.nearPlane * inverse;
            if (depth < -nearSlack) return;
            m_hits[slot].push_back({&face, inverse, slope, isSure && depth > nearSlack, holds && depth >= 0});
        });
    }

    double bandOf(double inverse) const { return m_ties.bandAt(1 - m_view.nearPlane * inverse); }

    /// Leaves the surfaces that may be seen, the one that is seen in exact arithmetic first; the background
    /// where there may be none.
    void keepVisible(std::vector<Seen>& hits) const {
        const Seen* sure = nullptr;
        std::size_t nearest = hits.size();
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (hits[i].isSure && (!sure || hits[i].inverse > sure->inverse)) sure = &hits[i];
            // Of surfaces at one depth any is as good.
            if (hits[i].holds && (nearest == hits.size() || hits[i].inverse > hits[nearest].inverse))
                nearest = i;
        }
        const std::optional<Seen> front = sure ? std::optional(*sure) : std::nullopt;
        std::vector<Seen> kept;
        const Seen background{};
        kept.push_back(nearest < hits.size() ? hits[nearest] : background);
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (i == nearest) continue;
            if (front) {
                const double behind = m_view.nearPlane * (front->inverse - hits[i].inverse);
                const double slack =
                    bandOf(front->inverse) + kCorner * glm::length(front->slope - hits[i].slope);
                if (behind > slack) continue;
            }
            kept.push_back(hits[i]);
        }
        if (!front && nearest < hits.size()) kept.push_back(background);
        hits.swap(kept);
    }

    void findFace(const FaceSource& face, int first, int last) {
        const Cone cone = coneOf(face, false);
        const glm::dvec2 slope = depthSlope(cone.inverseDistance(), m_view.nearPlane);
        const bool splits = face.piece == Piece::Side || face.piece == Piece::LightCap;
        const double nearSlack = splits ? kCorner * glm::length(slope) + kNearRounding : 0;
        const glm::uvec3 own = face.piece == Piece::LightCap ? sorted(face.corners) : glm::uvec3(0);
        eachPixel(cone, first, last, [&](std::size_t slot, double x, double y, bool isSure, bool holds) {
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
    void relate(Crossing& c, const Seen& seen, double inverse, const glm::dvec2& slope, double x, double y,
                const Cone* cone, bool covers, bool holds) const {
        const double behind = m_view.nearPlane * (seen.inverse - inverse);
        const double slack = bandOf(seen.inverse) + kCorner * glm::length(slope - seen.slope);
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
        if (covers && c.exact == kAbsent) c.exact = possible;
        if (!covers && !holds) c.exact = kAbsent;
    }

    /// Sign of the face's depth less that of a surface's plane along the same ray.
    double exactlyBehind(const Cone& face, const FaceSource& surface, double x, double y) const {
        const EyeRay ray = rayAt(x, y);
        const Rational difference = coneOf(surface, true).exactInverse(ray) - face.exactInverse(ray);
        return difference.sign();
    }

    /// Turns what was found in the rows [first, last) into signatures.
    void sign(int first, int last) {
        for (int row = first; row < last; ++row) {
            for (int column = 0; column < m_view.width; ++column) {
                const std::size_t slot =
                    std::size_t(row - first) * std::size_t(m_view.width) + std::size_t(column);
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
    const DepthTies& m_ties;
    const float m_offset;
    std::vector<FaceSource> m_surfaces{}, m_volumes{};
    Bands m_surfaceBands{}, m_volumeBands{};  ///< faces that a band of rows may see
    std::vector<glm::dvec3> m_corners{};

    // Of one band, by pixel
    std::vector<std::vector<Seen>> m_hits{};
    std::vector<std::vector<Signature>> m_found{};  ///< for each surface that may be seen

    Crossings m_out{};
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> m_known{};
};

}  // namespace

std::vector<VolumeOrigin> volumesOf(std::span<const LitCaster> lit) {
    std::vector<VolumeOrigin> origins;
    for (std::uint32_t c = 0; c < lit.size(); ++c) {
        if (lit[c].lit.empty()) continue;
        const std::size_t count = lit[c].perTriangle ? lit[c].lit.size() : 1;
        for (std::uint32_t t = 0; t < count; ++t) origins.push_back({c, t});
    }
    return origins;
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
