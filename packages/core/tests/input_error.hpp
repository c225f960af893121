#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/errors.hpp"

namespace mudline {

/// The message of the InputError that `action` throws; "" and a test failure when it throws none.
template <class Action>
std::string input_error(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError was thrown";
  return "";
}

}  // namespace mudline
