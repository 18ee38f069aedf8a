#pragma once

#include <string>

#include "matrix/cell.h"

namespace gnomon {

/// @p text in the colour of @p verdict: exact green, edge yellow, wrong and failed red, refused dim. As it is
/// where @p colours is false. The sequences are ECMA-48's SGR, which all terminals with colours know.
std::string inColour(const std::string& text, Verdict verdict, bool colours);

}  // namespace gnomon
