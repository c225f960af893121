#pragma once

#include <string>

#include "core/function.hpp"

namespace mudline {

/// What is wrong with a function that is worked out once, at the start: "" where it does not depend on the time.
std::string time_in(const Function& function);

}  // namespace mudline
