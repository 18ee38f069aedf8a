#pragma once

#include <filesystem>
#include <string>

#include "gl/renderer.h"
#include "gl/tools.h"
#include "scene/scene_file.h"

namespace gnomon {

/// A shipped scene's first frame on one surface, to be drawn again and again by several plans.
class Easel {
  public:
    Easel(const std::string& scene, const std::string& profile, int side)
        : m_profile(chip(profile)),
          m_side(side),
          m_frame(frameOf(loadSceneFile(std::filesystem::path(GNOMON_SOURCE) / "scenes" / (scene + ".toml")),
                          side, side)),
          m_surface(bufferFormatOf(m_profile), side, side) {}

    /// The whole plan; its mask is not read.
    Plan plan(const std::string& method) const {
        Plan made = planFrame(findMethod(method)->axes,
                              shapeOf(int(m_frame.volumes().size()), m_side, m_side), m_profile);
        made.masks.clear();
        return made;
    }

    Rendered draw(const Plan& plan, const RenderOptions& options = {}) {
        return render(m_surface, m_profile, plan, m_frame.surfaces, m_frame.lights(), options);
    }

    /// Thread CPU time of a frame's OpenGL calls, milliseconds; the same frame is drawn first and not timed.
    double frameMs(const Plan& plan) {
        draw(plan);
        return draw(plan).cpuMs;
    }

    const Profile& profile() const { return m_profile; }
    const Frame& frame() const { return m_frame; }
    Surface& surface() { return m_surface; }

  private:
    Profile m_profile;
    int m_side;
    Frame m_frame;
    Surface m_surface;
};

}  // namespace gnomon
