#pragma once

#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/section.hpp"

namespace mudline {

/// The last line of `text` with something in it: long messages of libraries end with what happened.
std::string last_line(const std::string& text);

/// What was thrown, in one line, inside a catch block: the last line of a std::exception's text, or that it is none.
std::string what_was_thrown();

/// The same of code that may be a plugin's, but for exhausted memory: that is no fault of what was called, and is
/// thrown on to the end of the program, which has a line of its own for it.
std::string fault_thrown();

/// The result of `action`, code that may be a plugin's. Whatever it throws becomes an InputError at `entry` of the
/// section, "<what it was to do>: <what was thrown>"; an InputError and exhausted memory stay as they are.
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
