#pragma once

#include <string>
#include <vector>

namespace mudline {

/// What is wrong with a text that should be a number: an unknown unit, a decimal comma, or a character that looks like
/// one of a number, such as a long minus sign; "" where none of these is found.
std::string why_no_number(const std::string& text);

/// The names of all units that measure what `declared` measures; none where that is no unit but words.
std::vector<std::string> units_like(const std::string& declared);

}  // namespace mudline
