#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// The parts of a frame's simulation that a scene may or may not call for. A minimal plan has each only as
/// far as the scene calls for it; a full plan has all.
enum class Effect {
    Lights,     ///< passes of lights that give nothing to what is seen
    Ambient,    ///< adding an ambient part that is black
    Volumes,    ///< volumes that hold no point that is seen
    NearCaps,   ///< caps at the near plane, counting from infinity or from the eye: z-pass, or with caps,
                ///< instead
    FarCaps,    ///< caps at infinity, where z-pass sees no background
    Levels,     ///< levels of nesting that doubling resolves
    Window,     ///< mask passes outside of the rectangles in which volumes matter
    Emulation,  ///< programs of the chip's arithmetic for draws that don't depend on it
    Mask,       ///< the mask itself where nothing can be in shadow
};
constexpr int kEffects = 9;

/// Those that are simulated though nothing calls for them.
class Effects {
  public:
    static Effects none() { return {}; }
    static Effects all() {
        Effects e;
        e.m_bits = (1u << kEffects) - 1;
        return e;
    }
    bool has(Effect effect) const { return (m_bits >> int(effect)) & 1u; }
    void add(Effect effect) { m_bits |= 1u << int(effect); }
    bool operator==(const Effects&) const = default;
    auto operator<=>(const Effects&) const = default;

  private:
    unsigned m_bits = 0;
};

const std::string& name(Effect);  ///< "lights", "ambient", "volumes", "near-caps", "far-caps", "levels", ...
std::optional<Effect> effectNamed(const std::string& word);

/// "full", "needed", or what is simulated besides what is needed: "levels,ambient".
std::string toString(const Effects& effects);
/// The inverse; nothing for an unknown word.
std::optional<Effects> effectsFrom(const std::string& words);

}  // namespace gnomon
