#pragma once

#include <Teuchos_ParameterList.hpp>

#include <string>
#include <vector>

namespace mudline {

/// A parameter that differs between two decks, or that only one of them gives.
struct DeckChange {
  std::string path;      // "materials/clay/skeleton/Young's modulus"
  std::string was, now;  // the values as in XML; "" where it is not given

  /// "materials/clay/void ratio: 0.9, was 1.2"
  std::string text() const;
  /// "0.9, was 1.2"
  std::string values() const;
};

/// Every parameter in which `now` differs from `was`, by path in the order of `was`, then those that are new. Numbers
/// are compared as numbers: 1e3 is 1000.
std::vector<DeckChange> deck_changes(const Teuchos::ParameterList& was, const Teuchos::ParameterList& now);

/// The texts of some changes in one line.
std::string one_line(const std::vector<DeckChange>& changes);

/// Whether the path lies in the section: "stages/push/duration" in "stages", or in "stages/push".
bool lies_in(const std::string& path, const std::string& section);

}  // namespace mudline
