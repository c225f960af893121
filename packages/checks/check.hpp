#pragma once

#include <functional>
#include <string>

#include "checks/doubts.hpp"

namespace mudline {

/// Takes a value that a check found, the text that says what the value is, and the advice where it is unusual.
using Judge = std::function<void(double value, const std::string& what, const std::string& advice)>;

/// One check of whether entries of a deck may be mistaken: of a setup as a whole, of a body or of a contact. Its
/// quantity's name is that of the doubt.
template <class Subject>
struct Check {
  Usual quantity;
  /// Collective: it finds the same on every rank.
  std::function<void(const Subject& subject, const Judge& judge)> look;
};

/// Makes the checks of a group and keeps their doubts. Collective.
template <class Subject>
void look(const std::vector<Check<Subject>>& checks, const Subject& subject, Doubts& doubts) {
  for (const Check<Subject>& check : checks)
    check.look(subject, [&](double value, const std::string& what, const std::string& advice) {
      doubts.judge(check.quantity.name, value, what, advice);
    });
}

}  // namespace mudline
