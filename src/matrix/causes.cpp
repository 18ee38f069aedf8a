#include "matrix/causes.h"

#include <algorithm>

namespace gnomon {
namespace {

/// Faces of one volume in front of the visible surface, per pixel, rows from the top.
struct FaceCounts {
    std::vector<int> fronts{}, backs{};
};

/// Counts faces by adding 1 of 255 to a colour: fronts in red, backs in green. Any depth format goes with
/// that.
class FaceCounter {
  public:
    FaceCounter(const View& view, const FrameSurfaces& surfaces, int depthBits)
        : m_surface({.depth = depthBits, .stencil = 0}, view.width, view.height) {
        const GlTable& gl = m_surface.driver();
        gl.Viewport(0, 0, view.width, view.height);
        gl.ClearColor(0, 0, 0, 0);
        gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl.Enable(GL_DEPTH_TEST);
        gl.EnableClientState(GL_VERTEX_ARRAY);
        gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        draw(surfaces.positions);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_FALSE, GL_FALSE);
        gl.DepthMask(GL_FALSE);
        gl.DepthFunc(GL_LEQUAL);
        gl.Enable(GL_BLEND);
        gl.BlendFunc(GL_ONE, GL_ONE);
        gl.Enable(GL_CULL_FACE);
    }

    /// The faces of volume @p index before the surface, or behind it where @p behind.
    FaceCounts count(const FrameVolumes& volumes, std::size_t index, bool behind) {
        const GlTable& gl = m_surface.driver();
        gl.Clear(GL_COLOR_BUFFER_BIT);
        for (const bool back : {false, true}) {
            gl.Color4f(back ? 0 : 1 / 255.0f, back ? 1 / 255.0f : 0, 0, 0);
            gl.CullFace(back ? GL_FRONT : GL_BACK);
            gl.DepthFunc(behind ? GL_GREATER : GL_LEQUAL);
            for (const Part part : {Part::Sides, Part::FarCap}) draw(volumes.of(part, index));
            if (!behind) draw(volumes.of(Part::NearCap, index));
            if (!behind) continue;
            gl.DepthFunc(GL_GEQUAL);
            draw(volumes.of(Part::LightCap, index));
        }
        const Image colour = readColour(m_surface);
        FaceCounts counts;
        for (std::size_t i = 0; i < colour.data.size(); i += 3) {
            counts.fronts.push_back(colour.data[i]);
            counts.backs.push_back(colour.data[i + 1]);
        }
        return counts;
    }

  private:
    void draw(std::span<const glm::vec4> triangles) {
        if (triangles.empty()) return;
        m_surface.driver().VertexPointer(4, GL_FLOAT, 0, triangles.data());
        m_surface.driver().DrawArrays(GL_TRIANGLES, 0, GLsizei(triangles.size()));
    }

    Surface m_surface;
};

/// Which pixels a mask of limited range calls a shadow, after the entries and then the exits of each volume
/// (fronts and backs before the surface; the other way round behind it). In steps of a factor of 2 away from
/// the value of a lit pixel: doubling clamps at 1, which is @p range steps up; halving ends at the lowest
/// code, @p range steps down.
std::vector<bool> limitedMask(const CauseInputs& in, int range) {
    const bool behind = in.axes.count == Count::Zfail;
    FaceCounter counter(in.view, in.surfaces, in.depthBits);
    // Fewer than 8 bits end at 0, which no doubling leaves; 8 bits round 1/2 up to 1 again.
    const bool endsAtZero = in.axes.arithmetic == Arithmetic::Halve && in.maskBits < 8;
    constexpr int kForEver = 1 << 20;
    std::vector<int> steps(std::size_t(in.view.width) * in.view.height);
    for (std::size_t v = 0; v < in.volumes.size(); ++v) {
        const FaceCounts faces = counter.count(in.volumes, v, behind);
        const auto &entries = behind ? faces.backs : faces.fronts,
                   &exits = behind ? faces.fronts : faces.backs;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const bool lost = endsAtZero && (steps[i] == kForEver || steps[i] + entries[i] > range);
            steps[i] = lost ? kForEver : std::min(steps[i] + entries[i], range) - exits[i];
        }
    }
    std::vector<bool> shadow(steps.size());
    std::transform(steps.begin(), steps.end(), shadow.begin(), [](int s) { return s > 0; });
    return shadow;
}

/// Which pixels a count of limited range calls a shadow, after all entries and then all exits.
std::vector<bool> countMask(const CauseInputs& in) {
    const bool behind = in.axes.count == Count::Zfail;
    FaceCounter counter(in.view, in.surfaces, in.depthBits);
    std::vector<int> entries(std::size_t(in.view.width) * in.view.height), exits(entries.size());
    for (std::size_t v = 0; v < in.volumes.size(); ++v) {
        const FaceCounts faces = counter.count(in.volumes, v, behind);
        for (std::size_t i = 0; i < entries.size(); ++i) {
            entries[i] += behind ? faces.backs[i] : faces.fronts[i];
            exits[i] += behind ? faces.fronts[i] : faces.backs[i];
        }
    }
    std::vector<bool> shadow(entries.size());
    for (std::size_t i = 0; i < shadow.size(); ++i)
        shadow[i] = countsAsShadow(entries[i], exits[i], in.range);
    return shadow;
}

/// Which pixels a bit calls a shadow that each face inverts: one bit for each volume in a stencil, one for
/// all of them in a colour.
std::vector<bool> parityMask(const CauseInputs& in) {
    const bool folds = in.axes.store == Store::Stencil;
    FaceCounter counter(in.view, in.surfaces, in.depthBits);
    std::vector<bool> shadow(std::size_t(in.view.width) * in.view.height);
    for (std::size_t v = 0; v < in.volumes.size(); ++v) {
        const FaceCounts faces = counter.count(in.volumes, v, in.axes.count == Count::Zfail);
        for (std::size_t i = 0; i < shadow.size(); ++i) {
            const bool odd = (faces.fronts[i] + faces.backs[i]) % 2 != 0;
            shadow[i] = folds ? shadow[i] || odd : shadow[i] != odd;
        }
    }
    return shadow;
}

/// What a mask of limited range does at its limit.
std::string limitOf(const CauseInputs& in) {
    const bool stencil = in.axes.store == Store::Stencil;
    switch (in.axes.arithmetic) {
        case Arithmetic::Count:
            if (in.range.wraps) return stencil ? "stencil wraps" : "mask wraps";
            return stencil ? "stencil saturates" : "mask clamps";
        case Arithmetic::Double:
            return "mask clamps";
        case Arithmetic::Halve:
            return "mask underflows";
        case Arithmetic::Parity:
            return "parity of overlapping volumes";
    }
    return {};
}

}  // namespace

std::map<std::string, int> causesOf(const CauseInputs& in) {
    const int wrong = in.judgement.wrong();
    if (wrong == 0) return {};
    if (in.axes.store == Store::None) return {{"no shadow is drawn", wrong}};
    if (in.axes.store == Store::DepthMap) return {{"shadow-map resolution or bias", wrong}};
    if (in.axes.count == Count::Zpass && in.eyeInVolume) return {{"eye inside a volume", wrong}};

    std::map<std::string, int> causes;
    const auto each = [&](const auto& causeOf) {
        for (std::size_t i = 0; i < in.judgement.pixels.size(); ++i) {
            const PixelVerdict verdict = in.judgement.pixels[i];
            if (verdict == PixelVerdict::WrongEdge || verdict == PixelVerdict::WrongInterior)
                ++causes[causeOf(i)];
        }
    };
    const std::string unknown = in.axes.maskDivisor > 1 ? "low mask resolution" : "unexplained";
    const std::string residue = in.dithers ? "dither drift" : "rounding residue";
    const auto rest = [&](std::size_t i) {
        return in.byOpenGl && (*in.byOpenGl)[i] == in.truth.blocked[i] ? residue : unknown;
    };
    if (in.axes.capFaces == CapFaces::Away) {
        // Volumes start at the faces turned away: what is inside a caster lies in none.
        each(
            [&](std::size_t i) { return in.truth.blocked[i] ? std::string("inside of a caster") : rest(i); });
        return causes;
    }
    const bool startsAtEye = in.axes.count == Count::PlusPlusZp || in.axes.count == Count::AtomicZp;
    if (startsAtEye && in.eyeOnFace) {
        each([&](std::size_t) { return std::string("eye on a face of a volume"); });
        return causes;
    }
    const bool counts = in.axes.arithmetic == Arithmetic::Count;
    // The others start somewhere else, or never overflow.
    const bool fromStart = in.axes.count <= Count::Zfail && in.axes.start != Start::Bias;
    if (counts && (in.axes.store == Store::Counter || !fromStart)) {
        each(rest);
        return causes;
    }
    const bool doubles = in.axes.arithmetic == Arithmetic::Double;
    const bool parity = in.axes.arithmetic == Arithmetic::Parity;
    const std::vector<bool> mask = counts   ? countMask(in)
                                   : parity ? parityMask(in)
                                            : limitedMask(in, doubles ? in.axes.levels : in.maskBits);
    const std::string limit = limitOf(in);
    each([&](std::size_t i) { return mask[i] != in.truth.blocked[i] ? limit : rest(i); });
    return causes;
}

}  // namespace gnomon
