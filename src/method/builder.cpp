#include "method/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "method/count_step.h"

namespace gnomon {

using enum BlendFactor;

namespace {

const char* facesName(Faces faces) {
    return faces == Faces::Front  ? "front faces"
           : faces == Faces::Back ? "back faces"
                                  : "front and back faces";
}

}  // namespace

PlanBuilder::PlanBuilder(const Axes& a, const FrameShape& frame, const Profile& profile)
    : axes(a), m_frame(frame), m_profile(profile) {
    m_plan.width = frame.width;
    m_plan.height = frame.height;
    m_plan.maskWidth = (frame.width + axes.maskDivisor - 1) / axes.maskDivisor;
    m_plan.maskHeight = (frame.height + axes.maskDivisor - 1) / axes.maskDivisor;
    m_plan.clip = axes.clip;
    m_plan.mapSize = axes.mapSize;
    m_plan.mapBias = axes.mapBias;
    const bool attenuated = axes.shade == Shade::Attenuated;
    m_plan.threshold = attenuated ? 0.75 : 0.5;
    m_plan.shadowShare = attenuated ? kHalf : 0;
}

Pass& PlanBuilder::add(PassKind kind, std::string label) {
    Pass& pass = m_plan.passes.emplace_back();
    pass.kind = kind;
    pass.label = std::move(label);
    return pass;
}

void PlanBuilder::clear(const Clearing& what) {
    Pass& pass = add(PassKind::Clear, what.label);
    pass.colour = glm::vec4(what.value);
    pass.clearsToBackground = what.background;
    pass.clearsDepth = what.depth;
    pass.clearsStencil = what.stencil;
    if (what.stencil && axes.start == Start::Middle) pass.stencilValue = shadowTest().reference;
    if (what.stencil && axes.start == Start::Bias) pass.stencilValue = shape(what.light).holdingEye;
    pass.write = what.write;
}

void PlanBuilder::startMask(Clearing what, ColourWrite channels) {
    const auto& window = shape(what.light).window;
    const auto& finished = shape(what.light).finished;
    if (!window || !finished) return clear(what);
    const float start = what.value;
    what.value = *finished;
    if (what.value == start || window->all.empty()) return clear(what);
    clear(what);
    m_plan.passes.back().label += ", as a lit pixel ends";
    clear({.label = "mask starts where volumes matter",
           .write = channels,
           .value = start,
           .light = what.light});
    boundLast(what.light);
}

void PlanBuilder::boundLast(int light) {
    if (!shape(light).window) return;
    m_plan.passes.back().light = light;
    m_plan.passes.back().extent = Extent::Shadows;
}

bool PlanBuilder::canShadow(int light) const {
    return !shape(light).window || !shape(light).window->all.empty();
}

bool PlanBuilder::isNeutralOutside(int light) const {
    return shape(light).window && shape(light).finishedIsNeutral;
}

Parts PlanBuilder::open(int light) const {
    return shape(light).withoutFarCaps ? Parts(Part::Sides) : Part::Sides | Part::FarCap;
}

void PlanBuilder::sceneDepth() {
    Pass& pass = add(PassKind::Scene, "scene: depth only");
    pass.target = axes.maskDivisor != 1 ? Target::Mask : Target::Window;
    pass.depthTest = pass.depthWrite = true;
    pass.write = kWriteNothing;
}

void PlanBuilder::sceneFirst(Shading shading, int light) {
    const char* label = shading == Shading::Lit       ? "scene: lit"
                        : shading == Shading::Diffuse ? "scene: the light's part"
                        : shading == Shading::Ambient ? "scene: the ambient part"
                                                      : "scene: black";
    Pass& pass = add(PassKind::Scene, label);
    pass.shading = shading;
    pass.light = light;
    pass.depthTest = pass.depthWrite = true;
}

Pass& PlanBuilder::sceneAgain(const std::string& label, int light, Shading shading, const Blend& how) {
    Pass& pass = add(PassKind::Scene, label);
    pass.shading = shading;
    pass.light = light;
    pass.depthTest = true;
    pass.depthFunction = Compare::Lequal;
    pass.blend = how;
    return pass;
}

Pass& PlanBuilder::rectangle(const std::string& label, const Blend& how, float value, ColourWrite write) {
    Pass& pass = add(PassKind::Rectangle, label);
    pass.blend = how;
    pass.colour = glm::vec4(value);
    pass.write = write;
    return pass;
}

Pass& PlanBuilder::volume(int light, int index, Faces faces, Parts parts, Compare function,
                          const std::string& what) {
    const char* which = parts == Parts(Part::LightCap)  ? " of the light caps"
                        : parts == Parts(Part::NearCap) ? " of the near caps"
                                                        : "";
    Pass& pass = add(PassKind::Volume,
                     index == kAllVolumes
                         ? fmt::format("{}{} of all volumes: {}", facesName(faces), which, what)
                         : fmt::format("{}{} of volume {}: {}", facesName(faces), which, index, what));
    pass.light = light;
    pass.volume = index;
    pass.faces = faces;
    pass.parts = parts;
    pass.depthTest = true;
    pass.depthFunction = function;
    pass.target = axes.maskDivisor != 1 ? Target::Mask : Target::Window;
    if (shape(light).window) pass.extent = Extent::Volumes;
    return pass;
}

void PlanBuilder::tap(int light, MaskPlace place) {
    m_plan.masks.push_back(
        {m_plan.passes.size(), light, place, place == MaskPlace::Stencil ? shadowTest() : Stencil{}});
}

void PlanBuilder::finishOutside(int light) {
    m_plan.masks.back().outside = int(std::lround(255 * shape(light).finished.value_or(1)));
}

// LEQUAL lets the far cap pass where depth was cleared, so that the background counts out of every volume. A
// light cap has the depth of its surface, which must lie before it: LESS.

void PlanBuilder::countInStencil(int light) {
    if (axes.arithmetic == Arithmetic::Parity) return countParity(light);
    const bool zfail = axes.count == Count::Zfail;
    const bool wrap = countWraps(axes, m_profile);
    const StencilOp incr = wrap ? StencilOp::IncrWrap : StencilOp::Incr,
                    decr = wrap ? StencilOp::DecrWrap : StencilOp::Decr;
    const auto side = [&](StencilOp op) {
        return zfail ? StencilSide{.onDepthFail = op} : StencilSide{.onPass = op};
    };
    const int volumes = shape(light).volumes;
    const Parts open = this->open(light);

    if (axes.count == Count::PlusPlusZp) {
        Pass& blockers = add(PassKind::Volume, "casters from the light onto the eye, one pixel: count +1");
        blockers.light = light;
        blockers.drawn = Drawn::Blockers;
        blockers.target = Target::OnePixel;
        blockers.write = kWriteNothing;
        blockers.stencil = {.enabled = true, .front = side(incr), .back = side(incr)};
        clear({.label = "count starts at that pixel's", .write = kWriteNothing, .stencil = true});
        m_plan.passes.back().stencilIsBlockers = true;
    }
    if (axes.count == Count::ZpPlus && volumes > 0) {
        Pass& pass = volume(light, kAllVolumes, Faces::Both, Part::NearCap, Compare::Always,
                            "casters from the light onto the near plane: count +1");
        pass.depthTest = false;
        pass.write = kWriteNothing;
        pass.stencil = {.enabled = true, .front = side(incr), .back = side(incr)};
    }

    // Fronts go in and backs out, seen from the eye; seen from infinity it is the other way round.
    struct Group {
        Parts parts{};
        Compare function = Compare::Lequal;
    };
    std::vector<Group> groups{{zfail                             ? open
                               : axes.count == Count::ZpassCap   ? open | Part::NearCap
                               : axes.count == Count::PlusPlusZp ? open | Part::NearFaces
                                                                 : open,
                               Compare::Lequal}};
    if (zfail) groups.push_back({Part::LightCap, Compare::Less});
    const auto pass = [&](Faces faces, const Group& group, StencilOp front, StencilOp back,
                          const std::string& what) {
        Pass& p = volume(light, kAllVolumes, faces, group.parts, group.function, what);
        p.write = kWriteNothing;
        p.stencil = {.enabled = true, .front = side(front), .back = side(back)};
        // Sides that the host left whole reach before the near plane; flattened ones lie in it.
        p.depthClamp =
            (axes.count == Count::PlusPlusZp && (m_profile.depthClamp || axes.clip != Clip::Frustum)) ||
            axes.count == Count::AtomicZp;
        if (axes.count == Count::AtomicZp) {
            p.drawn = Drawn::Silhouettes;
            p.countsBlockers = true;
            p.label = "sides and far caps that a geometry shader makes: count +1 and -1";
        }
    };
    const std::string behind = zfail ? " behind the surface" : "";
    if (volumes > 0 && ((m_profile.twoSidedStencil && wrap) || axes.count == Count::AtomicZp)) {
        for (const Group& group : groups)
            zfail ? pass(Faces::Both, group, decr, incr, "count -1 and +1" + behind)
                  : pass(Faces::Both, group, incr, decr, "count +1 and -1");
    } else if (volumes > 0) {
        // Up before down: a decrement that clamps at 0 before its increment would lose a count.
        for (const Group& group : groups)
            pass(zfail ? Faces::Back : Faces::Front, group, incr, incr, "count +1" + behind);
        for (const Group& group : groups)
            pass(zfail ? Faces::Front : Faces::Back, group, decr, decr, "count -1" + behind);
    }
    tap(light, MaskPlace::Stencil);
}

/// Each face inverts the lowest bit. Overlapping volumes would cancel, so each is counted by itself, and
/// what it shadows goes to the next bit.
void PlanBuilder::countParity(int light) {
    const int volumes = shape(light).volumes;
    const bool zfail = axes.count == Count::Zfail;
    const bool folds = volumes > 1;
    for (int i = 0; i < volumes; ++i) {
        const auto pass = [&](Parts parts, Compare function) {
            Pass& p = volume(light, folds ? i : kAllVolumes, Faces::Both, parts, function, "invert");
            p.write = kWriteNothing;
            const StencilSide side = zfail ? StencilSide{.onDepthFail = StencilOp::Invert}
                                           : StencilSide{.onPass = StencilOp::Invert};
            p.stencil = {.enabled = true, .writeMask = 1, .front = side, .back = side};
        };
        const Parts open = this->open(light);
        pass(axes.count == Count::ZpassCap ? open | Part::NearCap : open, Compare::Lequal);
        if (zfail) pass(Part::LightCap, Compare::Less);
        if (!folds) continue;
        Pass& fold = rectangle(fmt::format("keep the shadow of volume {}", i), {}, 1, kWriteNothing);
        const StencilSide replace{.onPass = StencilOp::Replace};
        fold.stencil = {.enabled = true,
                        .function = Compare::Equal,
                        .reference = 3,
                        .readMask = 1,
                        .writeMask = 2,
                        .front = replace,
                        .back = replace};
        boundLast(light);
        clear({.label = "parity starts anew", .write = kWriteNothing, .stencil = true});
        m_plan.passes.back().stencil.writeMask = 1;
        boundLast(light);
    }
    tap(light, MaskPlace::Stencil);
}

Stencil PlanBuilder::shadowTest() const {
    Stencil test{.enabled = true, .function = Compare::Notequal};
    if (axes.start == Start::Middle) test.reference = 1 << std::max(0, m_profile.stencilBits - 1);
    test.minusBlockers = axes.count == Count::AtomicZp;
    return test;
}

void PlanBuilder::countInCounter(int light) {
    const int volumes = shape(light).volumes;
    const bool zfail = axes.count == Count::Zfail;
    const auto pass = [&](Parts parts, Compare function, const std::string& what) -> Pass& {
        Pass& p = volume(light, kAllVolumes, Faces::Both, parts, function, what);
        p.program = Program::CountFaces;
        p.frontCount = zfail ? -1 : 1;
        return p;
    };
    const Parts open = this->open(light);
    if (volumes > 0 && zfail) {
        pass(open, Compare::Greater, "count -1 and +1 behind the surface");
        pass(Part::LightCap, Compare::Gequal, "count -1 and +1 behind the surface");
    } else if (volumes > 0) {
        if (axes.count == Count::ZpPlus)
            pass(Part::NearCap, Compare::Always, "casters from the light onto the near plane: count +1")
                .depthTest = false;
        pass(axes.count == Count::ZpassCap ? open | Part::NearCap : open, Compare::Lequal, "count +1 and -1");
    }
    m_plan.smallestMaskBits = 8;
    tap(light, MaskPlace::Counter);
}

int PlanBuilder::textureSide(int texels) const {
    return m_profile.textureNonPowerOfTwo ? texels : int(std::bit_ceil(unsigned(texels)));
}

void PlanBuilder::keepFrame() {
    m_plan.frameTextureWidth = textureSide(m_plan.width);
    m_plan.frameTextureHeight = textureSide(m_plan.height);
    Pass& pass = add(PassKind::Copy, fmt::format("frame so far to a texture of {}x{}",
                                                 m_plan.frameTextureWidth, m_plan.frameTextureHeight));
    pass.texture = MaskTexture::Rgb;
    pass.frameTexture = true;
}

void PlanBuilder::addFrameSoFar() {
    Pass& pass = rectangle("add the frame so far", blending(One, One), 1, kWriteColour);
    pass.texture = MaskTexture::Rgb;
    pass.frameTexture = true;
}

void PlanBuilder::drawDepthMap(int light) {
    const int faces = m_frame.lights[std::size_t(light)].directional ? 1 : 6;
    for (int face = 0; face < faces; ++face) {
        const std::string label =
            faces == 1 ? "depth map" : fmt::format("depth map, face {} of the cube", face);
        const auto into = [&](PassKind kind, const std::string& what) -> Pass& {
            Pass& pass = add(kind, label + what);
            pass.target = Target::DepthMap;
            pass.light = light;
            pass.mapFace = face;
            pass.write = kWriteNothing;
            return pass;
        };
        into(PassKind::Clear, " starts").clearsDepth = true;
        Pass& pass = into(PassKind::Scene, ": casters from the light");
        pass.depthTest = pass.depthWrite = true;
    }
}

void PlanBuilder::maskFromDepthMap(int light, bool isFirst) {
    Pass& pass = add(PassKind::Scene, "scene: what the depth map shows of the light");
    pass.shading = Shading::Mask;
    pass.light = light;
    pass.depthTest = true;
    pass.depthWrite = isFirst;
    pass.depthFunction = isFirst ? Compare::Less : Compare::Lequal;
    tap(light, MaskPlace::Colour);
}

Plan PlanBuilder::take() {
    const auto& lights = m_frame.lights;
    if (std::any_of(lights.begin(), lights.end(), [](const LightShape& l) { return l.window.has_value(); }))
        for (const LightShape& light : lights) m_plan.windows.push_back(light.window.value_or(MaskWindow{}));
    return std::move(m_plan);
}

}  // namespace gnomon
