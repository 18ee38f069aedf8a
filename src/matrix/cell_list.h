#pragma once

#include <vector>

#include "matrix/run.h"

namespace gnomon {

/// All cells of one scene, size and frame: they share truth and geometry, so one worker draws them.
struct CellGroup {
    const Scene* scene = nullptr;
    Size size{};
    int frame = 0;
};

/// What is asked of a cell besides its scene, size and frame.
struct CellChoice {
    const FidelityChoice& fidelity;
    const Axes& axes;
    const Profile& profile;
};

/// The cells of a request in their order: scenes, sizes, frames, and in such a group fidelities, methods,
/// profiles. A cell's place is its index; it is the same in every shard.
class CellList {
  public:
    /// @p request must outlive it.
    explicit CellList(const MatrixRequest& request);

    const MatrixRequest& request() const { return *m_request; }
    const std::vector<CellGroup>& groups() const { return m_groups; }
    std::size_t perGroup() const { return m_perGroup; }
    std::size_t count() const { return m_groups.size() * m_perGroup; }

    const CellGroup& groupOf(std::size_t place) const { return m_groups[place / m_perGroup]; }
    CellChoice choiceOf(std::size_t place) const;
    std::size_t profileOf(std::size_t place) const { return place % m_request->profiles.size(); }

    /// What a cell has before it is drawn.
    Cell blank(std::size_t place) const;

  private:
    const MatrixRequest* m_request;
    std::vector<CellGroup> m_groups{};
    std::size_t m_perGroup = 0;
};

}  // namespace gnomon
