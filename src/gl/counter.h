#pragma once

#include <memory>

#include "gl/table.h"
#include "plan/plan.h"

namespace gnomon {

/// What a frame cost, as seen at the OpenGL calls; knows nothing of plans.
struct CallCounts {
    PassCounts passes{};
    long draws = 0;
    long vertices = 0;
};

/// Counts the passes of what is drawn through the table that count() returns.
///
/// A pass is a run of draws of one kind with no state call between them. Kinds are told apart by the calls
/// alone: four vertices of the caller's memory that cover the whole viewport are a rectangle, a copy to a
/// texture is a copy, faces in one constant colour that leave the depth buffer alone are volumes, and all
/// else is the scene. A scissor's place goes with the geometry: another one within a run does not end it.
class Counter {
  public:
    /// The entry points of @p next, counted.
    GlTable count(GlTable next);

    const CallCounts& counts() const { return *m_counts; }
    /// Begins anew: nothing counted, as if the caller had set no state yet.
    void reset();

  private:
    enum class Kind { None, Scene, Volume, Rectangle, Copy };
    struct State {
        Kind run = Kind::None;  ///< kind of the run that goes on; None after a state call
        bool depthWrite = true;
        bool colours = false, coordinates = false;  ///< arrays of these give fragments their colours
        GLint size = 4;
        bool inBuffer = false;            ///< pointers are offsets into a buffer
        const void* positions = nullptr;  ///< in the caller's memory, or unknown
    };
    std::shared_ptr<CallCounts> m_counts = std::make_shared<CallCounts>();
    std::shared_ptr<State> m_state = std::make_shared<State>();
};

}  // namespace gnomon
