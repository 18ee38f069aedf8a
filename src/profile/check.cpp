#include "profile/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace gnomon {
namespace {

bool readsDestinationAlpha(BlendFactor factor) {
    // The saturating factor is min(As, 1 - Ad).
    return factor == BlendFactor::DstAlpha || factor == BlendFactor::OneMinusDstAlpha ||
           factor == BlendFactor::SrcAlphaSaturate;
}

bool readsDestinationAlpha(const BlendPair& pair) {
    return readsDestinationAlpha(pair.first) || readsDestinationAlpha(pair.second);
}

/// Collects what is wrong; each rule is one line of contradictions().
class Rules {
  public:
    /// @p key, which the profile has if @p has, can't be without @p needed.
    void needs(bool has, const char* key, bool met, const char* needed) {
        if (has && !met) m_found.push_back({key, fmt::format("{} needs {}", key, needed)});
    }

    void forbid(bool wrong, const char* key, std::string what) {
        if (wrong) m_found.push_back({key, std::move(what)});
    }

    /// No factor in @p factors may read a destination alpha that isn't there.
    template <class Factors>
    void destinationAlpha(const Factors& factors, const char* key, bool hasAlpha) {
        const bool reads = std::any_of(factors.begin(), factors.end(),
                                       [](const auto& f) { return readsDestinationAlpha(f); });
        forbid(reads && !hasAlpha, key, fmt::format("{} reads destination alpha and needs alpha_bits", key));
    }

    std::vector<Contradiction> found() && { return std::move(m_found); }

  private:
    std::vector<Contradiction> m_found;
};

}  // namespace

std::vector<Contradiction> contradictions(const Profile& p) {
    Rules rules;
    const bool alpha = p.alphaBits > 0;
    const bool alphaFactors = !p.alphaSourceFactors.empty() && !p.alphaDestinationFactors.empty();
    const bool anyPair = (!p.sourceFactors.empty() && !p.destinationFactors.empty()) || !p.blendPairs.empty();

    // Frame buffer
    rules.forbid(p.colourFormats.empty(), "colour_formats", "colour_formats is missing");
    const bool formatHasAlpha = std::any_of(p.colourFormats.begin(), p.colourFormats.end(),
                                            [&](const ColourFormat& f) { return f.alpha == p.alphaBits; });
    rules.forbid(alpha && !p.alphaExcludesDepth && !formatHasAlpha, "alpha_bits",
                 fmt::format("alpha_bits = {}, but no colour format has that many, and no auxiliary buffer "
                             "(alpha_excludes_depth) does",
                             p.alphaBits));
    rules.needs(p.alphaExcludesDepth, "alpha_excludes_depth", alpha, "alpha_bits");
    rules.needs(p.alphaExcludesDepth, "alpha_excludes_depth", p.depth, "depth_bits");
    rules.needs(p.depth, "depth_bits", !p.depthFunctions.empty(), "depth_functions");
    rules.needs(!p.depthFunctions.empty(), "depth_functions", p.depth, "depth_bits");
    rules.forbid(p.depth && !p.depthBits.empty() && p.depthBits.front() > 24, "depth_bits",
                 "depth_bits: gnomon renders into the first, and has 24 bits at most");
    rules.needs(!p.depthEncodings.empty(), "depth_encodings", p.depth, "depth_bits");
    rules.needs(p.stencilWrap, "stencil_wrap", p.stencilBits > 0, "stencil_bits");
    rules.needs(p.geometryShaders, "geometry_shaders", p.shaders, "shaders");
    rules.needs(p.atomicCounters, "atomic_counters", p.shaders, "shaders");
    rules.needs(p.framebufferFetch, "framebuffer_fetch", p.shaders, "shaders");
    rules.needs(p.depthClamp, "depth_clamp", p.depth, "depth_bits");
    rules.needs(p.depthTextures, "depth_textures", p.textureUnits > 0, "texture_units");
    rules.needs(p.twoSidedStencil, "two_sided_stencil", p.stencilBits > 0, "stencil_bits");
    rules.needs(p.polygonOffsetUnits, "polygon_offset_units", p.depth, "depth_bits");
    rules.needs(p.polygonOffsetFactor, "polygon_offset_factor", p.depth, "depth_bits");
    rules.needs(p.maxWidth > 0, "max_width", p.maxHeight > 0, "max_height");
    rules.needs(p.maxHeight > 0, "max_height", p.maxWidth > 0, "max_width");

    // Blending of colour
    rules.needs(!p.sourceFactors.empty(), "source_factors", !p.destinationFactors.empty(),
                "destination_factors");
    rules.needs(!p.destinationFactors.empty(), "destination_factors", !p.sourceFactors.empty(),
                "source_factors");
    rules.needs(!p.blendEquations.empty(), "blend_equations", anyPair,
                "source_factors and destination_factors, or blend_pairs");
    rules.needs(!p.sourceFactors.empty(), "source_factors", !p.blendEquations.empty(), "blend_equations");
    rules.needs(!p.blendPairs.empty(), "blend_pairs", !p.blendEquations.empty(), "blend_equations");
    rules.needs(!p.constantSourcePairs.empty(), "constant_source_pairs", !p.blendEquations.empty(),
                "blend_equations");
    rules.needs(!p.blendUnits.empty(), "blend_units", !p.blendEquations.empty(), "blend_equations");
    for (const auto& [source, destination] : p.constantSourcePairs)
        rules.forbid(p.allowsBlend(source, destination), "constant_source_pairs",
                     fmt::format("constant_source_pairs has \"{} {}\", which any source colour may use",
                                 name(source), name(destination)));
    rules.destinationAlpha(p.sourceFactors, "source_factors", alpha);
    rules.destinationAlpha(p.destinationFactors, "destination_factors", alpha);
    rules.destinationAlpha(p.blendPairs, "blend_pairs", alpha);
    rules.destinationAlpha(p.constantSourcePairs, "constant_source_pairs", alpha);

    // Blending of alpha
    rules.needs(p.blendWritesAlpha, "blend_writes_alpha", alpha, "alpha_bits");
    rules.needs(p.blendWritesAlpha, "blend_writes_alpha", alphaFactors,
                "alpha_source_factors and alpha_destination_factors");
    rules.needs(!p.alphaSourceFactors.empty(), "alpha_source_factors", alpha, "alpha_bits");
    rules.needs(!p.alphaSourceFactors.empty(), "alpha_source_factors", p.blendWritesAlpha,
                "blend_writes_alpha");
    rules.needs(!p.alphaDestinationFactors.empty(), "alpha_destination_factors", alpha, "alpha_bits");
    rules.needs(!p.alphaDestinationFactors.empty(), "alpha_destination_factors", p.blendWritesAlpha,
                "blend_writes_alpha");
    rules.needs(p.separateAlphaFactors, "separate_alpha_factors", alpha, "alpha_bits");
    rules.needs(p.separateAlphaFactors, "separate_alpha_factors", p.blendWritesAlpha, "blend_writes_alpha");

    // Textures
    rules.needs(p.textureUnits > 0, "texture_units", p.maxTextureSize > 0, "max_texture_size");
    rules.needs(p.maxTextureSize > 0, "max_texture_size", p.textureUnits > 0, "texture_units");
    rules.needs(p.maxTextureAspect > 0, "max_texture_aspect", p.textureUnits > 0, "texture_units");
    rules.needs(p.textureNonPowerOfTwo, "texture_non_power_of_two", p.textureUnits > 0, "texture_units");
    rules.needs(p.frameTexture != FrameTexture::None, "frame_texture", p.textureUnits > 0, "texture_units");
    rules.forbid(p.maxTextureSize > 0 && !std::has_single_bit(static_cast<unsigned>(p.maxTextureSize)),
                 "max_texture_size",
                 fmt::format("max_texture_size = {} is not a power of two", p.maxTextureSize));
    return std::move(rules).found();
}

}  // namespace gnomon
