#include "core/guarded.hpp"

#include <new>

#include "core/text.hpp"

namespace mudline {

std::string last_line(const std::string& text) {
  const std::string kept = trim(text);
  return kept.substr(kept.find_last_of('\n') + 1);
}

std::string what_was_thrown() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "not enough memory for this model";
  } catch (const std::exception& error) {
    const std::string line = last_line(error.what());
    return line.empty() ? "an exception without a message" : line;
  } catch (...) {
    return "something that is no std::exception";
  }
}

}  // namespace mudline
