#include <fmt/format.h>

#include <algorithm>

#include "method/method.h"

namespace gnomon {
namespace {

template <class Word, std::size_t N>
const std::string& pick(const std::array<std::string, N>& names, Word word) {
    return names[std::size_t(word)];
}

}  // namespace

const std::string& name(Store v) {
    static const std::array<std::string, kStores> names{"none",   "stencil", "alpha",
                                                        "screen", "counter", "depth-map"};
    return pick(names, v);
}
const std::string& name(Arithmetic v) {
    static const std::array<std::string, kArithmetics> names{"count", "double", "halve", "parity"};
    return pick(names, v);
}
const std::string& name(Count v) {
    static const std::array<std::string, kCounts> names{"zpass", "zpass-cap", "zfail",
                                                        "zp+",   "++zp",      "atomiczp"};
    return pick(names, v);
}
const std::string& name(Silhouette v) {
    static const std::array<std::string, kSilhouettes> names{"triangular", "visible", "manifold", "winding",
                                                             "per-triangle"};
    return pick(names, v);
}
const std::string& name(Apply v) {
    static const std::array<std::string, kApplies> names{"blend", "texture"};
    return pick(names, v);
}
const std::string& name(Shade v) {
    static const std::array<std::string, kShades> names{"black", "ambient", "attenuated"};
    return pick(names, v);
}
const std::string& name(Start v) {
    static const std::array<std::string, kStarts> names{"zero", "middle", "bias"};
    return pick(names, v);
}
const std::string& name(Overflow v) {
    static const std::array<std::string, kOverflows> names{"either", "wrap", "saturate"};
    return pick(names, v);
}
const std::string& name(CapFaces v) {
    static const std::array<std::string, kCapFaces> names{"lit", "away"};
    return pick(names, v);
}
const std::string& name(Clip v) {
    static const std::array<std::string, kClips> names{"frustum", "eye", "none"};
    return pick(names, v);
}
std::string maskScaleName(int divisor) {
    return divisor == 1 ? "1" : fmt::format("1/{}", divisor);
}

const std::vector<NamedMethod>& namedMethods() {
    using enum Store;
    using enum Arithmetic;
    const auto row = [](std::string id, const Axes& axes, std::string source, std::string summary) {
        return NamedMethod{std::move(id), normalised(axes), std::move(source), std::move(summary)};
    };
    const auto stencil = [](gnomon::Count count) { return Axes{.store = Stencil, .count = count}; };
    const auto blended = [](Store store, Arithmetic arithmetic) {
        return Axes{.store = store, .arithmetic = arithmetic, .count = gnomon::Count::ZpassCap};
    };
    const auto textured = [](int divisor) {
        return Axes{.store = Screen,
                    .arithmetic = Double,
                    .count = gnomon::Count::ZpassCap,
                    .maskDivisor = divisor,
                    .apply = Apply::Texture};
    };
    const auto counted = [](Store store) {
        return Axes{.store = store,
                    .arithmetic = Arithmetic::Count,
                    .count = gnomon::Count::ZpassCap,
                    .apply = Apply::Texture};
    };
    static const std::vector<NamedMethod> methods{
        row("none", {.store = None}, "-", "the unshadowed frame"),
        row("heidmann", stencil(gnomon::Count::Zpass), "Heidmann 1991, Real Shadows Real Time",
            "stencil counts faces in front of the surface, from 0 at the eye"),
        row("carmack", stencil(gnomon::Count::Zfail),
            "Bilodeau and Songy 1998; Carmack 2000; Usta et al. 2019, section 2.2",
            "stencil counts faces behind the surface, from 0 at infinity"),
        row("parity", {.store = Stencil, .arithmetic = Parity}, "Wikipedia, Shadow volume, Exclusive-or",
            "faces in front of the surface invert a stencil bit, volume by volume"),
        row("roettger-alpha", blended(Alpha, Double),
            "Roettger et al. 2002, sections 4.2 and 4.3; near plane 3.2",
            "destination alpha doubles at front faces and halves at back faces"),
        row("roettger-alpha-max", blended(Alpha, Halve), "Roettger et al. 2002, section 4.4",
            "the same from 1 downwards, normalised by the maximum blend equation"),
        row("roettger-screen", blended(Screen, Double),
            "Roettger et al. 2002, sections 4.2 and 4.3; near plane 3.2",
            "the colour buffer doubles and halves; the scene is drawn over it with DST_COLOR"),
        row("roettger-screen-max", blended(Screen, Halve), "Roettger et al. 2002, section 4.4",
            "the same from 1 downwards, normalised by the maximum blend equation"),
        row("screen-texture", textured(1), "Roettger et al. 2002, section 4.5; what a PlayStation 2 needs",
            "the colour buffer's mask goes over the finished scene as a texture"),
        row("roettger-half", textured(2), "Roettger et al. 2002, section 4.5",
            "the same with a mask of half the width and height"),
        row("roettger-quarter", textured(4), "Roettger et al. 2002, section 4.5",
            "the same with a mask of a quarter of the width and height"),
        row("alpha-zfail", {.store = Alpha, .arithmetic = Double, .count = gnomon::Count::Zfail},
            "gnomon: Roettger et al. 2002 with the depth test turned round",
            "destination alpha counts the faces behind the surface"),
        row("screen-zfail", {.store = Screen, .arithmetic = Double, .count = gnomon::Count::Zfail},
            "gnomon: Roettger et al. 2002 with the depth test turned round",
            "the colour buffer counts the faces behind the surface"),
        row("hornus", stencil(gnomon::Count::ZpPlus),
            "Hornus et al. 2005, ZP+; Usta et al. 2019, section 2.3",
            "casters drawn from the light onto the near plane start the count of each pixel"),
        row("eisemann", stencil(gnomon::Count::PlusPlusZp),
            "Eisemann et al. 2011, ++ZP; Usta et al. 2019, section 2.4",
            "a view of one pixel from the light to the eye starts the count of all pixels"),
        row("atomiczp", stencil(gnomon::Count::AtomicZp), "Usta et al. 2019, section 3",
            "a geometry shader extrudes silhouettes and counts what hides the eye atomically"),
        row("counter", {.store = Store::Counter, .count = gnomon::Count::Zfail},
            "Usta et al. 2019, section 4", "16 bits of the colour buffer count the faces behind the surface"),
        row("williams", {.store = DepthMap}, "Williams 1978; Kolivand and Sunar 2011, section 4",
            "the scene's depth from the light, compared at each pixel"),
        // What games did; the sources are hardware.md's.
        row("screen-count", counted(Screen), "PCSX2 issues 1920, 380: Crash Tag Team Racing, Castlevania",
            "the colour buffer counts by steps that wrap or clamp; an alpha test tells them apart"),
        row("alpha-count", counted(Alpha), "DOLPHIN PR 11406: Super Mario Galaxy",
            "destination alpha counts by steps that wrap or clamp; an alpha test tells them apart"),
        row("screen-parity", blended(Screen, Parity), "DOLPHIN PR 10841, 10864: F-Zero GX",
            "faces in front of the surface invert the colour buffer"),
        row("auto", {.automatic = true}, "gnomon: of these, Heidmann 1991 to Usta et al. 2019",
            "for each frame and chip the cheapest of these, at the levels it takes, that is proved exact"),
    };
    return methods;
}

const std::vector<AxisValue>& axisValues() {
    const auto count = [](Count value, std::string source, std::string summary) {
        return AxisValue{"count", name(value), std::move(source), std::move(summary)};
    };
    const auto silhouette = [](Silhouette value, std::string source, std::string summary) {
        return AxisValue{"silhouette", name(value), std::move(source), std::move(summary)};
    };
    static const std::vector<AxisValue> values{
        count(Count::Zpass, "Heidmann 1991; Usta et al. 2019, section 2.1",
              "faces before the surface, from 0: wrong where a volume holds the eye"),
        count(Count::ZpassCap, "Roettger et al. 2002, section 3.2",
              "the same, volumes closed by a cap at the near plane"),
        count(Count::Zfail, "Carmack 2000; Usta et al. 2019, section 2.2",
              "faces behind the surface, volumes closed by caps at the caster and at infinity"),
        count(Count::ZpPlus, "Hornus et al. 2005; Usta et al. 2019, section 2.3",
              "from what a view from the light onto the near plane counts"),
        count(Count::PlusPlusZp, "Eisemann et al. 2011; Usta et al. 2019, section 2.4",
              "from what one pixel counts between light and eye"),
        count(Count::AtomicZp, "Usta et al. 2019, section 3",
              "from what an atomic counter counts there while volumes are drawn"),
        silhouette(Silhouette::Triangular, "Kolivand and Sunar 2011, section 2.1",
                   "edges that an odd number of lit triangles has"),
        silhouette(Silhouette::Visible, "Kolivand and Sunar 2011, section 2.2",
                   "edges that exactly one lit triangle has"),
        silhouette(Silhouette::Manifold, "Crow 1977; Bergeron 1986; Aldridge and Woods, section 2",
                   "edges between a lit and an unlit triangle; refuses all but closed two-manifolds"),
        silhouette(Silhouette::Winding, "Aldridge and Woods, section 2.4",
                   "a signed counter per edge: any mesh, any subset of its triangles"),
        silhouette(Silhouette::PerTriangle, "Aldridge and Woods, section 2.6 (brute force)",
                   "each lit triangle has a volume of its own"),
    };
    return values;
}

const NamedMethod* findMethod(const std::string& id) {
    const auto& all = namedMethods();
    const auto found = std::find_if(all.begin(), all.end(), [&](const NamedMethod& m) { return m.id == id; });
    return found == all.end() ? nullptr : &*found;
}

Axes normalised(Axes axes) {
    if (axes.automatic) return {.levels = 0, .shade = axes.shade, .automatic = true};
    if (axes.arithmetic != Arithmetic::Double) axes.levels = 0;
    if (axes.store == Store::None) return {.store = Store::None, .levels = 0, .shade = axes.shade};
    if (axes.store != Store::DepthMap) {
        axes.mapSize = 0, axes.mapBias = 0;
        return axes;
    }
    return {.store = Store::DepthMap,
            .levels = 0,
            .shade = axes.shade,
            .mapSize = axes.mapSize ? axes.mapSize : kDefaultMapSize,
            .mapBias = axes.mapSize ? axes.mapBias : kDefaultMapBias};
}

std::string methodId(const Axes& given) {
    const Axes axes = normalised(given);
    for (const NamedMethod& method : namedMethods()) {
        Axes same = axes;
        same.shade = method.axes.shade;
        if (same == method.axes) return method.id;
    }
    if (axes.store == Store::DepthMap) return fmt::format("depth-map-{}-{}", axes.mapSize, axes.mapBias);
    std::string id = name(axes.store) + "-" + name(axes.arithmetic);
    if (axes.arithmetic == Arithmetic::Double) id += fmt::format("-{}", axes.levels);
    id += "-" + name(axes.count) + "-" + name(axes.silhouette) + "-" + maskScaleName(axes.maskDivisor) + "-" +
          name(axes.apply);
    if (axes.start != Start::Zero) id += "-start-" + name(axes.start);
    if (axes.overflow != Overflow::Either) id += "-" + name(axes.overflow);
    if (axes.capFaces != CapFaces::Lit) id += "-caps-" + name(axes.capFaces);
    if (axes.clip != Clip::Frustum) id += "-clip-" + name(axes.clip);
    if (axes.offset != 0) id += fmt::format("-offset-{}", axes.offset);
    std::replace(id.begin(), id.end(), '/', ':');
    return id;
}

namespace {

std::optional<std::string> stencilContradiction(const Axes& axes) {
    using enum Arithmetic;
    if (axes.arithmetic != Arithmetic::Count && axes.arithmetic != Parity)
        return fmt::format("a stencil can't {}: only count or parity", name(axes.arithmetic));
    if (axes.apply == Apply::Texture || axes.maskDivisor != 1)
        return "a stencil can't become a texture: apply blend at mask scale 1";
    const bool counts = axes.arithmetic == Arithmetic::Count;
    if (!counts && int(axes.count) > int(gnomon::Count::Zfail))
        return fmt::format("{} starts a count: parity has none", name(axes.count));
    if (!counts && (axes.start != Start::Zero || axes.overflow != Overflow::Either))
        return "parity has one bit: no start and no overflow";
    return std::nullopt;
}

std::optional<std::string> blendContradiction(const Axes& axes) {
    if (int(axes.count) > int(gnomon::Count::Zfail))
        return fmt::format("{} needs a stencil or a counter", name(axes.count));
    if (axes.maskDivisor != 1 && axes.apply != Apply::Texture)
        return "a mask below scale 1 goes over the scene as a texture only";
    if (axes.arithmetic == Arithmetic::Double && (axes.levels < 1 || axes.levels > 8))
        return fmt::format("{} levels: 1 to 8", axes.levels);
    if (axes.start == Start::Bias) return "a bias for the eye is of a stencil's count";
    if (axes.start == Start::Middle && axes.overflow == Overflow::Wrap)
        return "a count that wraps starts at zero: the middle is for one that saturates";
    return std::nullopt;
}

std::optional<std::string> counterContradiction(const Axes& axes) {
    if (axes.arithmetic != Arithmetic::Count) return "a counter only counts";
    if (axes.apply == Apply::Texture || axes.maskDivisor != 1)
        return "a counter is read where it stands: apply blend at mask scale 1";
    if (int(axes.count) > int(gnomon::Count::ZpPlus))
        return fmt::format("{} starts the count of a stencil", name(axes.count));
    return std::nullopt;
}

}  // namespace

std::optional<std::string> contradiction(const Axes& axes) {
    if (axes.store == Store::None || axes.store == Store::DepthMap) return std::nullopt;
    const auto own = axes.store == Store::Stencil   ? stencilContradiction(axes)
                     : axes.store == Store::Counter ? counterContradiction(axes)
                                                    : blendContradiction(axes);
    if (own) return own;
    const bool overflows = axes.store != Store::Counter && axes.arithmetic == Arithmetic::Count;
    if (!overflows && (axes.start != Start::Zero || axes.overflow != Overflow::Either))
        return "start and overflow are of a count in a stencil, colour or alpha";
    if (axes.start == Start::Bias && axes.count != gnomon::Count::Zpass)
        return fmt::format("a bias for the eye is for zpass: {} needs none", name(axes.count));
    if (axes.count == gnomon::Count::AtomicZp &&
        (axes.silhouette != Silhouette::Winding || axes.capFaces != CapFaces::Lit ||
         axes.overflow == Overflow::Saturate))
        return "atomiczp finds its own silhouettes, from lit faces, and its count wraps";
    if (axes.silhouette == Silhouette::PerTriangle && axes.capFaces == CapFaces::Away)
        return "caps of faces turned away close whole casters, not single triangles";
    if (axes.offset != 0 && axes.count != gnomon::Count::Zfail)
        return "an offset is for volumes with a light cap: zfail";
    if (axes.clip != Clip::Frustum && axes.maskDivisor != 1)
        return "clip eye and none draw at the window's size only";
    return std::nullopt;
}

std::vector<Axes> pathCandidates() {
    std::vector<Axes> path;
    for (const char* id : {"heidmann", "roettger-alpha", "roettger-screen", "screen-texture"})
        path.push_back(findMethod(id)->axes);
    return path;
}

}  // namespace gnomon
