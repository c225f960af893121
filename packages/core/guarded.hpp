#pragma once

#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/section.hpp"

namespace mudline {

/// The last line of `text` that is not blank: long messages of libraries end with the cause.
std::string last_line(const std::string& text);

/// Describes the current exception in one line, inside a catch block: the last line of a std::exception's text, or that
/// it is none.
std::string what_was_thrown();

/// Describes the current exception of code that may be a plugin's. Exhausted memory is rethrown: it is no fault of the
/// called code, and the program reports it at its end.
std::string fault_thrown();

/// Returns the result of `action`, code that may be a plugin's. An exception in it becomes the InputError "<failure>:
/// <what was thrown>" at `entry` of the section; an InputError and exhausted memory stay as they are.
template <class Action>
auto guarded(const Section& section, const std::string& entry, const std::string& failure, Action&& action)
    -> decltype(action()) {
  try {
    return action();
  } catch (const InputError&) {
    throw;
  } catch (...) {
    section.fail(failure + ": " + fault_thrown(), entry);
  }
}

}  // namespace mudline
