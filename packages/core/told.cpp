#include "core/told.hpp"

#include <cstdio>

namespace mudline {

std::string told(double value, const char* pattern) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, pattern, value);
  return buffer;
}

}  // namespace mudline
