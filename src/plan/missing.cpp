#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

#include "plan/plan.h"

namespace gnomon {
namespace {

/// Collects what is missing, each phrase once.
class Wants {
  public:
    explicit Wants(const Profile& profile) : m_profile(profile) {}

    void need(bool has, const std::string& key, const std::string& what) {
        if (has ||
            std::any_of(m_missing.begin(), m_missing.end(), [&](const Missing& m) { return m.what == what; }))
            return;
        m_missing.push_back({key, what, m_profile.sourceOf(key)});
    }
    std::vector<Missing> take() { return std::move(m_missing); }

  private:
    const Profile& m_profile;
    std::vector<Missing> m_missing{};
};

bool readsDestinationAlpha(BlendFactor f) {
    return f == BlendFactor::DstAlpha || f == BlendFactor::OneMinusDstAlpha ||
           f == BlendFactor::SrcAlphaSaturate;
}

/// Colour factors mean the channel's own value when they stand in the alpha channel.
BlendFactor asAlphaFactor(BlendFactor f) {
    switch (f) {
        case BlendFactor::SrcColor:
            return BlendFactor::SrcAlpha;
        case BlendFactor::OneMinusSrcColor:
            return BlendFactor::OneMinusSrcAlpha;
        case BlendFactor::DstColor:
            return BlendFactor::DstAlpha;
        case BlendFactor::OneMinusDstColor:
            return BlendFactor::OneMinusDstAlpha;
        default:
            return f;
    }
}

std::string listOf(const std::set<BlendFactor>& factors) {
    std::vector<std::string> names;
    for (const BlendFactor f : factors) names.push_back(name(f));
    return fmt::format("{}", fmt::join(names, ", "));
}

/// A draw whose fragments all have one grey source colour.
bool constantGrey(const Pass& pass) {
    const bool constant =
        (pass.kind == PassKind::Volume || pass.kind == PassKind::Rectangle) && pass.program == Program::None;
    return constant && pass.texture == MaskTexture::None && pass.colour.r == pass.colour.g &&
           pass.colour.g == pass.colour.b;
}

bool partial(const ColourWrite& w) {
    return w.red != w.green || w.green != w.blue;
}

void needSurface(Wants& wants, const Profile& p, const Plan& plan) {
    const bool wide = p.maxWidth && plan.width > p.maxWidth;
    const bool high = p.maxHeight && plan.height > p.maxHeight;
    wants.need(
        !wide && !high, wide ? "max_width" : "max_height",
        fmt::format("a frame of {}x{} ({}x{} at most)", plan.width, plan.height, p.maxWidth, p.maxHeight));
    const std::int64_t bytes = frameBytes(p, plan.width, plan.height);
    wants.need(!p.frameBytes || bytes <= p.frameBytes, "frame_bytes",
               fmt::format("{} bytes of frame memory for {}x{} ({} at most)", bytes, plan.width, plan.height,
                           p.frameBytes));
}

void needTexture(Wants& wants, const Profile& p, int width, int height, const std::string& what) {
    wants.need(p.textureUnits > 0, "texture_units", "textures");
    if (p.textureUnits == 0) return;
    const int longest = std::max(width, height);
    const int shortest = std::min(width, height);
    const std::string size = fmt::format("{}x{}", width, height);
    wants.need(longest <= p.maxTextureSize, "max_texture_size",
               fmt::format("a texture of {} for {} ({} at most)", size, what, p.maxTextureSize));
    wants.need(!p.maxTextureAspect || longest <= p.maxTextureAspect * shortest, "max_texture_aspect",
               fmt::format("a texture of {} ({}:1 at most)", size, p.maxTextureAspect));
    const bool powers = std::has_single_bit(unsigned(longest)) && std::has_single_bit(unsigned(shortest));
    wants.need(powers || p.textureNonPowerOfTwo, "texture_non_power_of_two",
               "textures whose sides are not powers of two");
}

void needDepthMap(Wants& wants, const Profile& p, const Plan& plan) {
    wants.need(p.depthTextures, "depth_textures", "a depth buffer as a texture");
    if (p.depthTextures) needTexture(wants, p, plan.mapSize, plan.mapSize, "the depth map");
}

void needPrograms(Wants& wants, const Profile& p, const Pass& pass) {
    const bool fetches = pass.program != Program::None;
    const bool extrudes = pass.drawn == Drawn::Silhouettes;
    wants.need(p.shaders || !(fetches || extrudes || pass.shading == Shading::Mask), "shaders",
               "programs for vertices and fragments");
    wants.need(p.framebufferFetch || !fetches, "framebuffer_fetch",
               "a fragment program that reads the frame buffer");
    wants.need(p.geometryShaders || !extrudes, "geometry_shaders", "geometry shaders with adjacency");
    wants.need(p.atomicCounters || !pass.countsBlockers, "atomic_counters", "atomic counters");
    wants.need(p.depthClamp || !pass.depthClamp, "depth_clamp", "depth clamp");
}

void needPass(Wants& wants, const Profile& p, const Pass& pass) {
    needPrograms(wants, p, pass);
    const bool usesDepth = pass.depthTest || pass.depthWrite || pass.clearsDepth;
    wants.need(!usesDepth || p.depth, "depth_bits", "a depth buffer");
    wants.need(!pass.depthTest || !p.depth || p.depthFunctions.contains(pass.depthFunction),
               "depth_functions", "depth function " + name(pass.depthFunction));

    const bool usesStencil = pass.stencil.enabled || pass.clearsStencil;
    wants.need(!usesStencil || p.stencilBits > 0, "stencil_bits", "stencil");
    if (pass.stencil.enabled && p.stencilBits > 0) {
        wants.need(pass.stencil.front == pass.stencil.back || p.twoSidedStencil, "two_sided_stencil",
                   "two-sided stencil");
        const auto wraps = [](const StencilSide& s) {
            const auto is = [](StencilOp op) {
                return op == StencilOp::IncrWrap || op == StencilOp::DecrWrap;
            };
            return is(s.onDepthFail) || is(s.onPass);
        };
        wants.need(p.stencilWrap || !(wraps(pass.stencil.front) || wraps(pass.stencil.back)), "stencil_wrap",
                   "stencil that wraps");
    }

    if (pass.kind == PassKind::Copy) {
        wants.need(p.frameTexture != FrameTexture::None, "frame_texture",
                   "a frame buffer that becomes a texture");
        if (pass.texture == MaskTexture::Alpha) {
            wants.need(p.alphaBits > 0, "alpha_bits", "destination alpha");
            wants.need(!p.alphaExcludesDepth, "alpha_excludes_depth", "destination alpha beside depth");
        }
        return;
    }

    // Write masks.
    const ColourWrite& w = pass.write;
    wants.need(!partial(w) || p.writeMask == WriteMask::Channel, "write_mask", "a write mask per channel");
    wants.need(p.writeMask != WriteMask::Fixed || p.alphaBits == 0 || !w.any() || (w.red && w.alpha),
               "write_mask", "a write mask for colour and alpha apart");

    // Destination alpha, and depth beside it.
    const bool draws = pass.kind != PassKind::Clear;
    const bool inverts = draws && pass.logicInvert && w.any();
    const bool blends = draws && pass.blend.enabled && !inverts && w.any();
    const bool readsAlpha =
        blends && pass.blend.equation != BlendEquation::Min && pass.blend.equation != BlendEquation::Max &&
        (readsDestinationAlpha(pass.blend.source) || readsDestinationAlpha(pass.blend.destination));
    if (w.alpha || readsAlpha) {
        wants.need(p.alphaBits > 0, "alpha_bits", "destination alpha");
        // The buffer is chosen when the context is made: a plan whose scene needs depth has no alpha
        // anywhere.
        wants.need(!p.alphaExcludesDepth, "alpha_excludes_depth", "destination alpha beside depth");
    }
    if (draws && pass.alphaTest.enabled)
        wants.need(p.alphaFunctions.contains(pass.alphaTest.function), "alpha_functions",
                   fmt::format("alpha test {}", name(pass.alphaTest.function)));
    wants.need(!inverts || p.logicOps, "logic_ops", "logic operations");
    // What keeps the blender from alpha keeps the logic operation: PSP's alpha is its stencil.
    if (inverts && w.alpha && p.alphaBits > 0)
        wants.need(p.blendWritesAlpha, "blend_writes_alpha", "blending of destination alpha");
    if (!blends) return;

    wants.need(p.blendEquations.contains(pass.blend.equation), "blend_equations",
               "blend equation " + name(pass.blend.equation));
    if (pass.blend.equation == BlendEquation::Min || pass.blend.equation == BlendEquation::Max) return;
    const auto [s, d] = std::pair(pass.blend.source, pass.blend.destination);
    if (w.red || w.green || w.blue) {
        const bool constant = p.allowsBlendWithConstantSource(s, d);
        const bool allowed = p.allowsBlend(s, d) || (constant && constantGrey(pass));
        wants.need(
            allowed, p.blendPairs.empty() ? "source_factors" : "blend_pairs",
            fmt::format("blend {} {}{}", name(s), name(d), constant ? " with a varying source colour" : ""));
    }
    if (w.alpha && p.alphaBits > 0) {
        wants.need(p.blendWritesAlpha, "blend_writes_alpha", "blending of destination alpha");
        if (p.blendWritesAlpha) {
            const bool listed = p.alphaSourceFactors.contains(s) && p.alphaDestinationFactors.contains(d);
            const bool sameMeaning = p.alphaSourceFactors.contains(asAlphaFactor(s)) &&
                                     p.alphaDestinationFactors.contains(asAlphaFactor(d));
            wants.need(listed || sameMeaning, "alpha_source_factors",
                       fmt::format("alpha blend factors {} {} (only {})", name(s), name(d),
                                   listOf(p.alphaSourceFactors)));
        }
    }
}

}  // namespace

PixelBytes pixelBytes(const Profile& p) {
    const auto bytes = [](int bits) { return bits <= 8 ? 1 : bits <= 16 ? 2 : 4; };
    PixelBytes pixel;
    if (!p.colourFormats.empty()) {
        const ColourFormat& f = p.colourFormats.front();
        pixel.colour = bytes(f.red + f.green + f.blue + f.alpha);
    }
    if (!p.depthBits.empty()) pixel.depth = bytes(p.depthBits.front());
    return pixel;
}

std::int64_t frameBytes(const Profile& profile, int width, int height) {
    const PixelBytes pixel = pixelBytes(profile);
    return std::int64_t(width) * height * (2 * pixel.colour + pixel.depth);
}

std::vector<Missing> missing(const Profile& profile, const Plan& plan) {
    Wants wants(profile);
    needSurface(wants, profile, plan);
    for (const Pass& pass : plan.passes) {
        if (pass.kind == PassKind::Copy && pass.frameTexture)
            needTexture(wants, profile, plan.frameTextureWidth, plan.frameTextureHeight, "the frame so far");
        else if (pass.kind == PassKind::Copy)
            needTexture(wants, profile, plan.textureWidth, plan.textureHeight, "the mask");
        if (pass.target == Target::DepthMap) needDepthMap(wants, profile, plan);
        needPass(wants, profile, pass);
    }
    if (plan.smallestMaskBits > 0 && !profile.colourFormats.empty()) {
        const ColourFormat& f = profile.colourFormats.front();
        // A mask made in alpha stands there, or goes from there into a texture.
        const bool inAlpha = plan.maskPlace() == MaskPlace::Alpha ||
                             std::any_of(plan.passes.begin(), plan.passes.end(),
                                         [](const Pass& pass) { return pass.texture == MaskTexture::Alpha; });
        const int bits = inAlpha ? profile.alphaBits : std::min({f.red, f.green, f.blue});
        wants.need(bits >= plan.smallestMaskBits, "colour_formats",
                   fmt::format("{} bits per channel of the mask ({} at most)", plan.smallestMaskBits, bits));
    }
    return wants.take();
}

}  // namespace gnomon
