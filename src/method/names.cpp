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
    static const std::array<std::string, 4> names{"none", "stencil", "alpha", "screen"};
    return pick(names, v);
}
const std::string& name(Arithmetic v) {
    static const std::array<std::string, 3> names{"count", "double", "halve"};
    return pick(names, v);
}
const std::string& name(Count v) {
    static const std::array<std::string, 2> names{"zpass", "zpass-cap"};
    return pick(names, v);
}
const std::string& name(Silhouette v) {
    static const std::array<std::string, kSilhouettes> names{"triangular", "visible", "manifold", "winding",
                                                             "per-triangle"};
    return pick(names, v);
}
const std::string& name(Apply v) {
    static const std::array<std::string, 2> names{"blend", "texture"};
    return pick(names, v);
}
const std::string& name(Shade v) {
    static const std::array<std::string, 3> names{"black", "ambient", "attenuated"};
    return pick(names, v);
}
std::string maskScaleName(int divisor) {
    return divisor == 1 ? "1" : fmt::format("1/{}", divisor);
}

const std::vector<NamedMethod>& namedMethods() {
    using enum Store;
    using enum Arithmetic;
    const auto row = [](std::string id, Store store, Arithmetic arithmetic, int divisor, Apply apply,
                        std::string source, std::string summary) {
        Axes axes{.store = store, .arithmetic = arithmetic, .maskDivisor = divisor, .apply = apply};
        axes.levels = arithmetic == Double ? 2 : 0;
        axes.count = store == Alpha || store == Screen ? gnomon::Count::ZpassCap : gnomon::Count::Zpass;
        return NamedMethod{std::move(id), axes, std::move(source), std::move(summary)};
    };
    static const std::vector<NamedMethod> methods{
        row("none", None, Arithmetic::Count, 1, Apply::Blend, "-", "the unshadowed frame"),
        row("heidmann", Stencil, Arithmetic::Count, 1, Apply::Blend, "Heidmann 1991, Real Shadows Real Time",
            "stencil counts faces in front of the surface, from 0 at the eye"),
        row("roettger-alpha", Alpha, Double, 1, Apply::Blend,
            "Roettger et al. 2002, sections 4.2 and 4.3; near plane 3.2",
            "destination alpha doubles at front faces and halves at back faces"),
        row("roettger-alpha-max", Alpha, Halve, 1, Apply::Blend, "Roettger et al. 2002, section 4.4",
            "the same from 1 downwards, normalised by the maximum blend equation"),
        row("roettger-screen", Screen, Double, 1, Apply::Blend,
            "Roettger et al. 2002, sections 4.2 and 4.3; near plane 3.2",
            "the colour buffer doubles and halves; the scene is drawn over it with DST_COLOR"),
        row("roettger-screen-max", Screen, Halve, 1, Apply::Blend, "Roettger et al. 2002, section 4.4",
            "the same from 1 downwards, normalised by the maximum blend equation"),
        row("screen-texture", Screen, Double, 1, Apply::Texture,
            "Roettger et al. 2002, section 4.5; what a PlayStation 2 needs",
            "the colour buffer's mask goes over the finished scene as a texture"),
        row("roettger-half", Screen, Double, 2, Apply::Texture, "Roettger et al. 2002, section 4.5",
            "the same with a mask of half the width and height"),
        row("roettger-quarter", Screen, Double, 4, Apply::Texture, "Roettger et al. 2002, section 4.5",
            "the same with a mask of a quarter of the width and height"),
    };
    return methods;
}

const NamedMethod* findMethod(const std::string& id) {
    const auto& all = namedMethods();
    const auto found = std::find_if(all.begin(), all.end(), [&](const NamedMethod& m) { return m.id == id; });
    return found == all.end() ? nullptr : &*found;
}

std::string methodId(const Axes& axes) {
    if (axes.store == Store::None) return "none";
    for (const NamedMethod& method : namedMethods()) {
        Axes same = axes;
        same.shade = method.axes.shade;
        if (same == method.axes) return method.id;
    }
    std::string id = name(axes.store) + "-" + name(axes.arithmetic);
    if (axes.arithmetic == Arithmetic::Double) id += fmt::format("-{}", axes.levels);
    id += "-" + name(axes.count) + "-" + name(axes.silhouette) + "-" + maskScaleName(axes.maskDivisor) + "-" +
          name(axes.apply);
    std::replace(id.begin(), id.end(), '/', ':');
    return id;
}

std::optional<std::string> contradiction(const Axes& axes) {
    if (axes.store == Store::None) return std::nullopt;
    const bool stencil = axes.store == Store::Stencil;
    if (stencil && axes.arithmetic != Arithmetic::Count)
        return fmt::format("a stencil can't {}: only count", name(axes.arithmetic));
    if (!stencil && axes.arithmetic == Arithmetic::Count)
        return fmt::format("counting in the {} buffer: double or halve", name(axes.store));
    if (stencil && (axes.apply == Apply::Texture || axes.maskDivisor != 1))
        return "a stencil can't become a texture: apply blend at mask scale 1";
    if (axes.maskDivisor != 1 && axes.apply != Apply::Texture)
        return "a mask below scale 1 goes over the scene as a texture only";
    if (axes.arithmetic == Arithmetic::Double && (axes.levels < 1 || axes.levels > 8))
        return fmt::format("{} levels: 1 to 8", axes.levels);
    return std::nullopt;
}

std::vector<Axes> pathCandidates() {
    std::vector<Axes> path;
    for (const char* id : {"heidmann", "roettger-alpha", "roettger-screen", "screen-texture"})
        path.push_back(findMethod(id)->axes);
    return path;
}

}  // namespace gnomon
