#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gnomon {

/// Where a worker is in its work, in memory that it shares with its parent: what it told last outlives it.
class Whereabouts {
  public:
    Whereabouts();
    ~Whereabouts();
    Whereabouts(const Whereabouts&) = delete;
    Whereabouts& operator=(const Whereabouts&) = delete;

    /// Copies a line, cut to what there is room for. No system call.
    void tell(std::string_view line);

    /// What was told last; "" if nothing was.
    std::string text() const;

  private:
    static constexpr std::size_t kRoom = 256;
    char* m_text = nullptr;
};

}  // namespace gnomon
