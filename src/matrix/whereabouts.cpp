#include "matrix/whereabouts.h"

#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace gnomon {

Whereabouts::Whereabouts() {
    void* memory = mmap(nullptr, kRoom, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
    m_text = static_cast<char*>(memory);
}

Whereabouts::~Whereabouts() {
    munmap(m_text, kRoom);
}

void Whereabouts::tell(std::string_view line) {
    const std::size_t size = std::min(line.size(), kRoom - 1);
    std::memcpy(m_text, line.data(), size);
    m_text[size] = 0;
}

std::string Whereabouts::text() const {
    // A process that was killed in tell() may have left no end.
    return {m_text, strnlen(m_text, kRoom)};
}

}  // namespace gnomon
