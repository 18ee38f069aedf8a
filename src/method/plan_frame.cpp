#include <fmt/format.h>

#include <bit>

#include "method/builder.h"
#include "method/method.h"

namespace gnomon {

using enum BlendFactor;

Parts partsOf(Count count) {
    const Parts open = Part::Sides | Part::FarCap;
    switch (count) {
        case Count::Zpass:
            return open;
        case Count::ZpassCap:
        case Count::ZpPlus:
            return open | Part::NearCap;
        case Count::Zfail:
            return open | Part::LightCap;
        case Count::PlusPlusZp:
            return open | Part::NearFaces;
        case Count::AtomicZp:
            return {};  // made by a geometry shader
    }
    return {};
}

CutStyle cutStyleOf(const Axes& axes, bool depthClamp) {
    return {axes.clip, !depthClamp, axes.offset};
}

namespace {

/// One light, as without any other: the lit scene is drawn once or twice, and the mask takes from it.
class OneLight {
  public:
    explicit OneLight(PlanBuilder& builder) : b(builder) {}

    void stencil() {
        b.clear({.label = "background", .background = true, .depth = true, .stencil = true});
        b.sceneFirst(lighting());
        b.countInStencil(0);
        const bool attenuated = b.axes.shade == Shade::Attenuated;
        const std::string where = b.shadowTest().reference ? "where the count is not that of the start"
                                                           : "where the count is not 0";
        if (b.canShadow(0)) {
            Pass& apply = b.rectangle((attenuated ? "attenuate " : "black ") + where,
                                      attenuated ? blending(Zero, SrcColor) : Blend{}, attenuated ? kHalf : 0,
                                      kWriteColour);
            apply.stencil = b.shadowTest();
            b.boundLast(0);
        }
        ambient();
    }

    void alpha() {
        b.startMask({.label = "background, mask starts",
                     .write = kWriteAll,
                     .background = true,
                     .value = b.maskStart(),
                     .depth = true},
                    kWriteAlpha);
        b.sceneFirst(lighting());
        b.countByBlending(0, kWriteAlpha);
        b.normalise(0, kWriteAlpha);
        if (!b.isNeutralOutside(0) || b.canShadow(0)) {
            b.rectangle("mask times the scene", blending(Zero, DstAlpha), 1, kWriteColour);
            if (b.isNeutralOutside(0)) b.boundLast(0);
        }
        ambient();
    }

    void screen() {
        if (b.isNeutralOutside(0)) return screenInWindow();
        b.startMask({.label = "mask starts", .value = b.maskStart(), .depth = true}, kWriteColour);
        b.sceneDepth();
        b.countByBlending(0, kWriteColour);
        b.normalise(0, kWriteColour);
        b.sceneAgain("scene over the mask", 0, lighting(), blending(DstColor, Zero));
        ambient();
    }

    /// Section 4.5: the mask first, at its own resolution; then the scene; then the mask over it.
    void texture() {
        const ColourWrite mask = b.axes.store == Store::Alpha ? kWriteAlpha : kWriteColour;
        const bool isApplied = b.canShadow(0) || !b.isNeutralOutside(0);
        if (isApplied) {
            b.startMask({.label = "mask starts", .write = mask, .value = b.maskStart(), .depth = true}, mask);
            b.sceneDepth();
            b.countByBlending(0, mask);
            b.normalise(0, mask);
            b.copyMask();
        }
        b.clear({.label = "background", .background = true, .depth = true});
        b.sceneFirst(lighting());
        if (isApplied) {
            b.applyTexture(0);
        } else {
            b.tap(0, MaskPlace::Colour);
            b.finishOutside(0);
        }
        ambient();
    }

    void counter() {
        b.clear({.label = "count starts at 0", .value = 0, .depth = true});
        b.sceneDepth();
        b.countInCounter(0);
        b.sceneAgain("scene, by the count", 0, lighting(), {}).program = Program::ShadeCount;
        ambient();
    }

    void depthMap() {
        b.drawDepthMap(0);
        b.clear({.label = "mask starts", .value = 1, .depth = true});
        b.maskFromDepthMap(0);
        b.sceneAgain("scene over the mask", 0, lighting(), blending(DstColor, Zero));
        ambient();
    }

  private:
    Shading lighting() const { return b.axes.shade == Shade::Ambient ? Shading::Diffuse : Shading::Lit; }

    /// The lit scene at once; the mask, and the scene over it, only where volumes matter.
    void screenInWindow() {
        b.clear({.label = "background", .background = true, .depth = true});
        b.sceneFirst(lighting());
        if (b.canShadow(0)) {
            b.clear({.label = "mask starts where volumes matter", .value = b.maskStart()});
            b.boundLast(0);
            b.countByBlending(0, kWriteColour);
        }
        b.normalise(0, kWriteColour);
        b.finishOutside(0);
        if (b.canShadow(0)) {
            b.sceneAgain("scene over the mask", 0, lighting(), blending(DstColor, Zero));
            b.boundLast(0);
        }
        ambient();
    }

    void ambient() {
        if (b.axes.shade == Shade::Ambient && b.hasAmbient())
            b.sceneAgain("scene: add the ambient part", 0, Shading::Ambient, blending(One, One));
    }

    PlanBuilder& b;
};

/// Several lights: what needs no light once, then each light's part is added where its mask lets it. A store
/// in the colour buffer starts anew for each light; the frame so far waits in a texture meanwhile.
class ManyLights {
  public:
    ManyLights(PlanBuilder& builder, std::vector<int> lights) : b(builder), m_lights(std::move(lights)) {}

    void stencil() {
        b.clear({.label = "background",
                 .background = true,
                 .depth = true,
                 .stencil = true,
                 .light = m_lights.front()});
        b.sceneFirst(base());
        for (const int light : m_lights) {
            if (!isFirst(light))
                b.clear(
                    {.label = "count starts anew", .write = kWriteNothing, .stencil = true, .light = light});
            b.countInStencil(light);
            const auto add = [&](const std::string& label, Shading shading) -> Pass& {
                return b.sceneAgain(label, light, shading, blending(One, One));
            };
            Stencil lit = b.shadowTest();
            lit.function = Compare::Equal;
            if (b.axes.shade == Shade::Attenuated) {
                add("scene: add half of light " + std::to_string(light), Shading::HalfDiffuse);
                add("scene: add the rest where it is lit", Shading::RestDiffuse).stencil = lit;
            } else {
                add("scene: add light " + std::to_string(light) + " where it is lit", Shading::Diffuse)
                    .stencil = lit;
            }
        }
    }

    void alpha() {
        b.clear({.label = "background", .background = true, .depth = true});
        b.sceneFirst(base());
        for (const int light : m_lights) {
            b.startMask(
                {.label = "mask starts", .write = kWriteAlpha, .value = b.maskStart(), .light = light},
                kWriteAlpha);
            b.countByBlending(light, kWriteAlpha);
            b.normalise(light, kWriteAlpha);
            b.sceneAgain("scene: add light " + std::to_string(light) + " times the mask", light,
                         Shading::Diffuse, blending(DstAlpha, One));
        }
    }

    /// @p mask makes the mask of a light in the colour buffer.
    template <class Mask>
    void colour(const Mask& mask) {
        for (const int light : m_lights) {
            b.startMask({.label = b.axes.store == Store::Counter ? "count starts at 0" : "mask starts",
                         .value = b.axes.store == Store::DepthMap  ? 1
                                  : b.axes.store == Store::Counter ? 0
                                                                   : b.maskStart(),
                         .depth = isFirst(light),
                         .light = light},
                        kWriteColour);
            if (isFirst(light) && b.axes.store != Store::DepthMap) b.sceneDepth();
            mask(light, isFirst(light));
            Pass& over = b.sceneAgain("scene: light " + std::to_string(light) + " over the mask", light,
                                      Shading::Diffuse,
                                      b.axes.store == Store::Counter ? Blend{} : blending(DstColor, Zero));
            if (b.axes.store == Store::Counter) over.program = Program::ShadeCount;
            over.blackBackdrop = !isFirst(light);
            finish(light);
        }
    }

    void screen() {
        colour([&](int light, bool) {
            b.countByBlending(light, kWriteColour);
            b.normalise(light, kWriteColour);
        });
    }

    void counter() {
        colour([&](int light, bool) { b.countInCounter(light); });
    }

    void depthMap() {
        for (const int light : m_lights) b.drawDepthMap(light);
        colour([&](int light, bool first) { b.maskFromDepthMap(light, first); });
    }

    void texture() {
        const ColourWrite mask = b.axes.store == Store::Alpha ? kWriteAlpha : kWriteColour;
        for (const int light : m_lights) {
            b.startMask({.label = "mask starts",
                         .write = mask,
                         .value = b.maskStart(),
                         .depth = true,
                         .light = light},
                        mask);
            b.sceneDepth();
            b.countByBlending(light, mask);
            b.normalise(light, mask);
            b.copyMask();
            b.clear({.label = isFirst(light) ? "background" : "black",
                     .background = isFirst(light),
                     .value = 0,
                     .depth = true});
            b.sceneFirst(Shading::Diffuse, light);
            b.applyTexture(light);
            finish(light);
        }
    }

  private:
    bool isFirst(int light) const { return light == m_lights.front(); }
    Shading base() const { return b.axes.shade == Shade::Black ? Shading::Black : Shading::Ambient; }

    void finish(int light) {
        if (isFirst(light) && b.axes.shade != Shade::Black && b.hasAmbient())
            b.sceneAgain("scene: add the ambient part", 0, Shading::Ambient, blending(One, One));
        if (!isFirst(light)) b.addFrameSoFar();
        if (light != m_lights.back()) b.keepFrame();
    }

    PlanBuilder& b;
    std::vector<int> m_lights;
};

template <class Flow>
void draw(Flow flow, const Axes& axes) {
    if (axes.store == Store::Stencil) return flow.stencil();
    if (axes.store == Store::Counter) return flow.counter();
    if (axes.store == Store::DepthMap) return flow.depthMap();
    if (axes.apply == Apply::Texture) return flow.texture();
    if (axes.store == Store::Alpha) return flow.alpha();
    flow.screen();
}

}  // namespace

Plan planFrame(const Axes& given, const FrameShape& frame, const Profile& profile) {
    const Axes axes = normalised(given);
    PlanBuilder b(axes, frame, profile);
    const int lights = int(frame.lights.size());
    std::vector<int> drawn;
    for (int light = 0; light < lights; ++light)
        if (lights == 1 || !b.isLeftOut(light)) drawn.push_back(light);
    // Without any light there is nothing to mask, whatever the method.
    if (axes.store == Store::None || drawn.empty()) {
        b.clear({.label = "background", .background = true, .depth = true});
        b.sceneFirst(lights == 1 ? Shading::Lit : Shading::Ambient);
        for (std::size_t i = 0; lights > 1 && i < drawn.size(); ++i)
            b.sceneAgain("scene: add light " + std::to_string(drawn[i]), drawn[i], Shading::Diffuse,
                         blending(One, One));
    } else if (lights == 1) {
        draw(OneLight(b), axes);
    } else {
        draw(ManyLights(b, drawn), axes);
    }
    return b.take();
}

}  // namespace gnomon
