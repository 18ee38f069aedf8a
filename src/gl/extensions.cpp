#include "gl/extensions.h"

#include <algorithm>

namespace gnomon {

bool listsName(std::string_view list, std::string_view name) {
    for (std::size_t at = 0; at < list.size();) {
        const std::size_t end = std::min(list.find(' ', at), list.size());
        if (list.substr(at, end - at) == name) return true;
        at = end + 1;
    }
    return false;
}

bool hasExtension(const GlTable& gl, std::string_view name) {
    const GLubyte* all = gl.GetString(GL_EXTENSIONS);
    return all && listsName(reinterpret_cast<const char*>(all), name);
}

}  // namespace gnomon
