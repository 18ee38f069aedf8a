#pragma once

#include <map>
#include <optional>
#include <string>

#include "gl/depth_map.h"
#include "gl/link_program.h"
#include "gl/silhouette_mesh.h"
#include "gl/table.h"
#include "plan/plan.h"

namespace gnomon {

/// The programs that some plans need, compiled when first used.
class Programs {
  public:
    /// @param known   the context's programs
    /// @param prefix  of their names there: what one chip may compile another may not
    Programs(const GlTable& table, std::map<std::string, unsigned>& known, std::string prefix)
        : gl(table), m_known(known), m_prefix(std::move(prefix)) {}

    /// Binds Program::CountFaces: adds @p frontCount where a front face is drawn, subtracts it at a back
    /// face.
    void useCountFaces(int frontCount);
    /// Binds Program::ShadeCount. @p shadowShare: of the source colour where the count is not 0
    void useShadeCount(float shadowShare);
    /// Binds the comparison with a depth map whose faces are the textures bound to units 0, 1, ...
    void useDepthMap(const DepthMapFrame& map, int size, float bias, float shadowShare);
    /// Draws the silhouettes' volumes with a geometry shader.
    /// @param counts  also how many lit triangles hide the eye
    /// @return  that number, as its atomic counter says; nothing if it doesn't count
    std::optional<int> drawSilhouettes(const SilhouetteMesh& mesh, Clip clip, bool counts);
    /// Back to fixed functions.
    void useNone() { gl.UseProgram(0); }

  private:
    void use(const char* name, std::initializer_list<ShaderStage> stages);
    GLint uniform(const char* name) const { return gl.GetUniformLocation(m_current, name); }

    const GlTable& gl;
    std::map<std::string, unsigned>& m_known;
    std::string m_prefix;
    GLuint m_current = 0;
};

}  // namespace gnomon
