#pragma once

#include <cstdint>
#include <vector>

#include "matrix/cell_list.h"
#include "matrix/run_maker.h"

namespace gnomon {

/// Digests of all that the results of cells depend on: the program and its driver, the scene with the frame's
/// camera, the profile's facts, and what is asked. The passes follow from these. A cell whose key is that of
/// one before it comes out the same.
class ContentKeys {
  public:
    /// @p list must outlive it.
    ContentKeys(const CellList& list, const RunMaker& maker);

    std::uint64_t of(std::size_t place) const;

  private:
    const CellList& m_list;
    std::vector<std::uint64_t> m_groups{}, m_profiles{};
    std::vector<std::uint64_t> m_questions{};  ///< by fidelity and method
};

}  // namespace gnomon
