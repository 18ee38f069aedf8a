#pragma once

#include <memory>
#include <string>
#include <vector>

#include "matrix/lab.h"
#include "matrix/run.h"
#include "matrix/workers.h"

namespace gnomon {

/// All cells of one scene, size and frame: they share truth and geometry, so one worker draws them.
struct CellGroup {
    const Scene* scene = nullptr;
    Size size{};
    int frame = 0;
};

/// One of the cells of a group, which come fidelity by fidelity, method by method, profile by profile.
struct CellChoice {
    const FidelityChoice& fidelity;
    const Axes& axes;
    const Profile& profile;
};

/// Cells of each group of @p request.
std::size_t cellsPerGroup(const MatrixRequest& request);
CellChoice cellOf(const MatrixRequest& request, std::size_t index);

/// What a cell has before it is drawn.
Cell blankCell(const MatrixRequest& request, const CellGroup& group, std::size_t index);

/// Draws the cells of a run in a worker's process: a task is a group, a step is a cell. Groups of one scene
/// that come one after the other share a Lab. Results are the cells as JSON.
class CellWorker : public StepWorker {
  public:
    /// All arguments must outlive it.
    CellWorker(const MatrixRequest& request, const std::vector<CellGroup>& groups, Whereabouts& whereabouts);
    void begin(std::size_t task) override;
    std::string step(std::size_t task, std::size_t step) override;

  private:
    void enter(const std::string& stage);

    const MatrixRequest& m_request;
    const std::vector<CellGroup>& m_groups;
    Whereabouts& m_whereabouts;
    std::unique_ptr<Lab> m_lab{};
    const Scene* m_scene = nullptr;       ///< of the Lab
    std::vector<std::string> m_chosen{};  ///< by profile, of the group: Cell::chosen
    std::string m_cell{};                 ///< id of the one that is drawn
};

}  // namespace gnomon
