#pragma once

#include <array>
#include <glm/glm.hpp>
#include <initializer_list>
#include <set>
#include <string>
#include <type_traits>

#include "gl/buffer_format.h"
#include "gl/table.h"
#include "gl/words.h"
#include "profile/profile.h"

namespace gnomon {

/// The state that decides whether a draw is allowed, as far as the caller has set it.
struct DrawState {
    bool blend = false;
    bool logicOp = false;  ///< takes the place of blending
    GLenum source = GL_ONE, destination = GL_ZERO, alphaSource = GL_ONE, alphaDestination = GL_ZERO;
    GLenum equation = GL_FUNC_ADD;
    bool red = true, green = true, blue = true;
    bool alpha = false;  ///< asked for by the caller; the initial mask asks for nothing
    bool colourArray = false, texture = false, program = false;
    bool toTexture = false;  ///< draws to a texture instead of the window
    glm::vec4 colour{1};
};

/// What a profile allows, asked in OpenGL's enumerants. Every refusal is a thrown CapabilityViolation.
///
/// Asked at each call of a frame, and made for each frame: what the profile says in sets and lists is worked
/// out as bits, and a message is put together only for a call that is refused.
class Judge {
  public:
    /// @pre @p profile outlives the judge
    Judge(const Profile& profile, const BufferFormat& buffers);

    /// @param argument  of the call: text, an enumerant, or a function that gives the text
    template <class Argument>
    void need(bool has, const char* call, const Argument& argument, const char* capability) const {
        if (has) [[likely]]
            return;
        if constexpr (std::is_invocable_v<Argument>)
            refuse(call, argument(), capability);
        else if constexpr (std::is_same_v<Argument, GLenum>)
            refuse(call, enumName(argument), capability);
        else
            refuse(call, argument, capability);
    }

    void enable(GLenum what) const;

    template <class Argument>
    void stencil(const char* call, const Argument& argument) const {
        need(p.stencilBits > 0, call, argument, "stencil_bits");
    }
    void stencilOps(const char* call, std::initializer_list<GLenum> ops) const;
    void oneSide(const char* call, GLenum face) const;
    void depthFunction(GLenum function) const;
    void alphaFunction(GLenum function) const;

    /// A pair that no state makes possible is refused where it is set; one that needs a constant source at
    /// the draw.
    void blendPair(const char* call, GLenum source, GLenum destination) const;
    void blendEquation(const char* call, GLenum equation) const;
    void blendColour() const { need(m_constants, "glBlendColor", "constant colour", blendKey()); }
    void colourMask(bool r, bool g, bool blue, bool a) const;

    void viewport(GLint x, GLint y, GLsizei width, GLsizei height) const;
    void texture(const char* call, GLsizei width, GLsizei height) const;
    template <class Argument>
    void depthTexture(const char* call, const Argument& argument) const {
        need(p.depthTextures, call, argument, "depth_textures");
    }
    void shader(GLenum type) const;
    /// A program's text: what it asks for by name.
    void shaderSource(const std::string& text) const;
    template <class Argument>
    void copy(const char* call, const Argument& argument) const {
        need(p.textureUnits > 0, call, argument, "texture_units");
        need(p.frameTexture != FrameTexture::None, call, argument, "frame_texture");
    }
    template <class Argument>
    void alphaPlanes(const char* call, const Argument& argument) const {
        need(p.alphaBits > 0, call, argument, "alpha_bits");
        need(!p.alphaExcludesDepth || b.alpha > 0, call, argument, "alpha_excludes_depth");
    }

    /// A draw under the state that the caller has set.
    void draw(const char* call, const DrawState& state) const;

    const Profile& p;
    const BufferFormat b;

  private:
    [[noreturn]] void refuse(const char* call, const std::string& argument, const char* capability) const;
    const char* blendKey() const { return p.blendPairs.empty() ? "source_factors" : "blend_pairs"; }

    /// Pairs of blend factors: by source, bit i for the destination i.
    struct Pairs {
        std::array<unsigned, std::size_t(BlendFactor::OneMinusConstantAlpha) + 1> destinations{};
        bool has(BlendFactor source, BlendFactor destination) const {
            return destinations[std::size_t(source)] >> unsigned(destination) & 1;
        }
        void add(const std::set<BlendFactor>& sources, const std::set<BlendFactor>& destinationsOfAll);
        void add(const std::set<BlendPair>& pairs);
    };

    Pairs m_colour{};          ///< with any source colour
    Pairs m_constantColour{};  ///< with a source colour that is the same grey all over the draw
    Pairs m_alpha{};           ///< in the alpha channel
    unsigned m_depthFunctions = 0, m_alphaFunctions = 0, m_equations = 0;  ///< bit i for the word i
    bool m_constants = false;  ///< some pair has a constant factor
};

}  // namespace gnomon
