#include "core/time_dependence.hpp"

namespace mudline {

std::string time_in(const Function& function) {
  if (function.steady()) return "";
  return "'" + function.text() + "' depends on the time; this number may depend on the place only";
}

}  // namespace mudline
