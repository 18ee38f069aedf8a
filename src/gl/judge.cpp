#include "gl/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "gl/capability.h"
#include "plan/plan.h"
#include "profile/blend.h"

namespace gnomon {
namespace {

bool readsDestinationAlpha(GLenum factor) {
    return factor == GL_DST_ALPHA || factor == GL_ONE_MINUS_DST_ALPHA || factor == GL_SRC_ALPHA_SATURATE;
}

/// In the alpha channel a colour factor means the alpha value of the same side.
BlendFactor inAlphaChannel(BlendFactor factor) {
    switch (factor) {
        case BlendFactor::SrcColor:
            return BlendFactor::SrcAlpha;
        case BlendFactor::OneMinusSrcColor:
            return BlendFactor::OneMinusSrcAlpha;
        case BlendFactor::DstColor:
            return BlendFactor::DstAlpha;
        case BlendFactor::OneMinusDstColor:
            return BlendFactor::OneMinusDstAlpha;
        default:
            return factor;
    }
}

/// All factors that mean one of @p allowed in the alpha channel.
std::set<BlendFactor> inAlphaChannel(const std::set<BlendFactor>& allowed) {
    std::set<BlendFactor> all = allowed;
    for (const BlendFactor colour : {BlendFactor::SrcColor, BlendFactor::OneMinusSrcColor,
                                     BlendFactor::DstColor, BlendFactor::OneMinusDstColor})
        if (allowed.contains(inAlphaChannel(colour))) all.insert(colour);
    return all;
}

template <class Word>
unsigned bitsOf(const std::set<Word>& words) {
    unsigned bits = 0;
    for (const Word word : words) bits |= 1u << unsigned(word);
    return bits;
}

template <class Word>
bool has(unsigned bits, Word word) {
    return bits >> unsigned(word) & 1;
}

}  // namespace

Judge::Judge(const Profile& profile, const BufferFormat& buffers)
    : p(profile),
      b(buffers),
      m_depthFunctions(bitsOf(p.depthFunctions)),
      m_alphaFunctions(bitsOf(p.alphaFunctions)),
      m_equations(bitsOf(p.blendEquations)) {
    m_colour.add(p.sourceFactors, p.destinationFactors);
    m_colour.add(p.blendPairs);
    m_constantColour = m_colour;
    m_constantColour.add(p.constantSourcePairs);
    if (p.blendWritesAlpha)
        m_alpha.add(inAlphaChannel(p.alphaSourceFactors), inAlphaChannel(p.alphaDestinationFactors));
    m_constants = std::any_of(p.sourceFactors.begin(), p.sourceFactors.end(), isConstant) ||
                  std::any_of(p.destinationFactors.begin(), p.destinationFactors.end(), isConstant) ||
                  std::any_of(p.blendPairs.begin(), p.blendPairs.end(), [](const BlendPair& pair) {
                      return isConstant(pair.first) || isConstant(pair.second);
                  });
}

void Judge::Pairs::add(const std::set<BlendFactor>& sources, const std::set<BlendFactor>& destinationsOfAll) {
    for (const BlendFactor source : sources) destinations[std::size_t(source)] |= bitsOf(destinationsOfAll);
}

void Judge::Pairs::add(const std::set<BlendPair>& pairs) {
    for (const auto& [source, destination] : pairs)
        destinations[std::size_t(source)] |= 1u << unsigned(destination);
}

void Judge::refuse(const char* call, const std::string& argument, const char* capability) const {
    throw CapabilityViolation(call, argument, capability, p.sourceOf(capability));
}

void Judge::enable(GLenum what) const {
    const char* call = "glEnable";
    switch (what) {
        case GL_DEPTH_TEST:
            return need(p.depth, call, what, "depth_bits");
        case GL_STENCIL_TEST:
            return need(p.stencilBits > 0, call, what, "stencil_bits");
        case GL_ALPHA_TEST:
            return need(m_alphaFunctions != 0, call, what, "alpha_functions");
        case GL_COLOR_LOGIC_OP:
            return need(p.logicOps, call, what, "logic_ops");
        case GL_DEPTH_CLAMP:
            return need(p.depthClamp, call, what, "depth_clamp");
        case GL_TEXTURE_2D:
            return need(p.textureUnits > 0, call, what, "texture_units");
        case GL_POLYGON_OFFSET_FILL:
            return need(p.polygonOffsetUnits || p.polygonOffsetFactor, call, what, "polygon_offset_units");
        default:
            if (what >= GL_CLIP_PLANE0 && what < GL_CLIP_PLANE0 + 32)
                need(int(what - GL_CLIP_PLANE0) < p.clipPlanes, call, what, "clip_planes");
    }
}

void Judge::stencilOps(const char* call, std::initializer_list<GLenum> ops) const {
    for (const GLenum op : ops)
        if (op == GL_INCR_WRAP || op == GL_DECR_WRAP) need(p.stencilWrap, call, op, "stencil_wrap");
}

void Judge::oneSide(const char* call, GLenum face) const {
    stencil(call, face);
    need(face == GL_FRONT_AND_BACK || p.twoSidedStencil, call, face, "two_sided_stencil");
}

void Judge::depthFunction(GLenum function) const {
    need(p.depth, "glDepthFunc", function, "depth_bits");
    const auto word = compareOf(function);
    need(!word || has(m_depthFunctions, *word), "glDepthFunc", function, "depth_functions");
}

void Judge::alphaFunction(GLenum function) const {
    const auto word = compareOf(function);
    need(!word || has(m_alphaFunctions, *word), "glAlphaFunc", function, "alpha_functions");
}

void Judge::blendPair(const char* call, GLenum source, GLenum destination) const {
    const auto s = blendFactorOf(source), d = blendFactorOf(destination);
    if (!s || !d) return;
    need(
        m_constantColour.has(*s, *d) || m_alpha.has(*s, *d), call,
        [&] { return fmt::format("{}, {}", enumName(source), enumName(destination)); }, blendKey());
}

void Judge::blendEquation(const char* call, GLenum equation) const {
    const auto word = blendEquationOf(equation);
    need(!word || has(m_equations, *word), call, equation, "blend_equations");
}

void Judge::colourMask(bool r, bool g, bool blue, bool a) const {
    const auto argument = [=] { return fmt::format("{:d}, {:d}, {:d}, {:d}", r, g, blue, a); };
    const bool partial = r != g || g != blue;
    need(!partial || p.writeMask == WriteMask::Channel, "glColorMask", argument, "write_mask");
    need(p.writeMask != WriteMask::Fixed || p.alphaBits == 0 || r == a, "glColorMask", argument,
         "write_mask");
}

void Judge::viewport(GLint x, GLint y, GLsizei width, GLsizei height) const {
    const int right = x + width, top = y + height;
    const auto argument = [=] { return fmt::format("{}x{}", right, top); };
    need(!p.maxWidth || right <= p.maxWidth, "glViewport", argument, "max_width");
    need(!p.maxHeight || top <= p.maxHeight, "glViewport", argument, "max_height");
    need(!p.frameBytes || gnomon::frameBytes(p, right, top) <= p.frameBytes, "glViewport", argument,
         "frame_bytes");
}

void Judge::texture(const char* call, GLsizei width, GLsizei height) const {
    const auto argument = [=] { return fmt::format("{}x{}", width, height); };
    need(p.textureUnits > 0, call, argument, "texture_units");
    const int longest = std::max(width, height), shortest = std::min(width, height);
    need(longest <= p.maxTextureSize, call, argument, "max_texture_size");
    need(!p.maxTextureAspect || longest <= p.maxTextureAspect * shortest, call, argument,
         "max_texture_aspect");
    const bool powers = std::has_single_bit(unsigned(longest)) && std::has_single_bit(unsigned(shortest));
    need(powers || p.textureNonPowerOfTwo, call, argument, "texture_non_power_of_two");
}

void Judge::shader(GLenum type) const {
    need(p.shaders, "glCreateShader", type, "shaders");
    need(type != GL_GEOMETRY_SHADER || p.geometryShaders, "glCreateShader", type, "geometry_shaders");
}

void Judge::shaderSource(const std::string& text) const {
    need(p.framebufferFetch || text.find("GL_EXT_shader_framebuffer_fetch") == text.npos, "glShaderSource",
         "GL_EXT_shader_framebuffer_fetch", "framebuffer_fetch");
    need(p.atomicCounters || text.find("atomic_uint") == text.npos, "glShaderSource", "atomic_uint",
         "atomic_counters");
}

void Judge::draw(const char* call, const DrawState& s) const {
    const bool colour = s.red || s.green || s.blue;
    if (s.alpha) alphaPlanes(call, "writing alpha");
    if (s.logicOp)
        return need(!s.alpha || p.blendWritesAlpha, call, "a logic op on alpha", "blend_writes_alpha");
    if (!s.blend || !(colour || s.alpha)) return;
    if (s.equation == GL_MIN || s.equation == GL_MAX) return;
    const auto pair = [&] {
        return fmt::format("blending {}, {}", enumName(s.source), enumName(s.destination));
    };
    if (readsDestinationAlpha(s.source) || readsDestinationAlpha(s.destination)) alphaPlanes(call, pair);
    if (colour) {
        const BlendFactor source = *blendFactorOf(s.source), destination = *blendFactorOf(s.destination);
        const bool byConstant = m_constantColour.has(source, destination);
        const bool constantGrey = !s.colourArray && !s.texture && !s.program && s.colour.r == s.colour.g &&
                                  s.colour.g == s.colour.b;
        need(
            m_colour.has(source, destination) || (byConstant && constantGrey), call,
            [&] { return fmt::format("{}{}", pair(), byConstant ? " with a varying source colour" : ""); },
            blendKey());
    }
    if (s.alpha) {
        need(p.blendWritesAlpha, call, "blending alpha", "blend_writes_alpha");
        const auto source = blendFactorOf(s.alphaSource), destination = blendFactorOf(s.alphaDestination);
        need(
            source && destination && m_alpha.has(*source, *destination), call,
            [&] { return fmt::format("{} in alpha", pair()); }, "alpha_source_factors");
    }
}

}  // namespace gnomon
