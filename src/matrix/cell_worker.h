#pragma once

#include <memory>
#include <string>
#include <vector>

#include "matrix/cell_list.h"
#include "matrix/lab.h"
#include "matrix/workers.h"

namespace gnomon {

/// Cells of one group that are to be drawn.
struct CellTask {
    std::size_t group = 0;              ///< of CellList::groups()
    std::vector<std::size_t> places{};  ///< of CellList, ascending
};

/// Draws cells in a worker's process: a step is a cell of its task. Groups of one scene that come one after
/// the other share a Lab. Results are the cells as JSON.
class CellWorker : public StepWorker {
  public:
    /// All arguments must outlive it.
    CellWorker(const CellList& list, const std::vector<CellTask>& tasks, Whereabouts& whereabouts);
    void avoid(const std::string& where) override { m_avoided = where; }
    void begin(std::size_t task) override;
    std::string step(std::size_t task, std::size_t step) override;

  private:
    void enter(const std::string& stage);

    const CellList& m_list;
    const MatrixRequest& m_request;
    const std::vector<CellTask>& m_tasks;
    Whereabouts& m_whereabouts;
    std::unique_ptr<Lab> m_lab{};
    const Scene* m_scene = nullptr;       ///< of the Lab
    std::vector<std::string> m_chosen{};  ///< by profile, of the group: Cell::chosen
    std::string m_avoided{};              ///< StepWorker::avoid()
    std::string m_cell{};                 ///< id of the one that is drawn
};

}  // namespace gnomon
