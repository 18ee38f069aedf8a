#pragma once

#include <filesystem>
#include <string>

#include "gl/renderer.h"
#include "gl/tools.h"
#include "scene/scene_file.h"

namespace gnomon {

inline Scene shippedScene(const std::string& id) {
    return loadSceneFile(std::filesystem::path(GNOMON_SOURCE) / "scenes" / (id + ".toml"));
}

/// A scene's first frame on one surface of the chip that can do all, to be drawn again and again by several
/// plans.
class Easel {
  public:
    Easel(const Scene& scene, int width, int height)
        : m_profile(chip("ideal")),
          m_width(width),
          m_height(height),
          m_frame(frameOf(scene, width, height)),
          m_surface(bufferFormatOf(m_profile), width, height) {}

    /// The whole plan; its mask is not read.
    Plan plan(const std::string& method) const {
        Plan made = planFrame(findMethod(method)->axes,
                              shapeOf(int(m_frame.volumes().size()), m_width, m_height), m_profile);
        made.masks.clear();
        return made;
    }

    Rendered draw(const Plan& plan, const RenderOptions& options = {}) {
        return render(m_surface, m_profile, plan, m_frame.surfaces, m_frame.lights(), options);
    }

    /// Thread CPU time of a frame's OpenGL calls, milliseconds; the same frame is drawn first and not timed.
    double frameMs(const Plan& plan, const RenderOptions& options = {}) {
        draw(plan, options);
        return draw(plan, options).cpuMs;
    }

    const Profile& profile() const { return m_profile; }
    const Frame& frame() const { return m_frame; }
    Surface& surface() { return m_surface; }

  private:
    Profile m_profile;
    int m_width, m_height;
    Frame m_frame;
    Surface m_surface;
};

}  // namespace gnomon
