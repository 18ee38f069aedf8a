#pragma once

#include <string_view>

#include "gl/table.h"

namespace gnomon {

/// Whether a list of names, separated by spaces, holds @p name.
bool listsName(std::string_view list, std::string_view name);

/// Whether the driver lists an extension of OpenGL. @pre a compatibility context is current
bool hasExtension(const GlTable& gl, std::string_view name);

}  // namespace gnomon
