#pragma once

#include <string>
#include <vector>

#include "core/deck.hpp"
#include "core/parameters.hpp"

namespace mudline {

/// An entry of the deck's section "branches": another run, which goes on from the end of a stage of the deck's own run.
/// Its deck is the whole deck with the entries of the branch laid over it.
class Branch {
 public:
  /// Takes the section out of the deck. The decks of the branches are those of `deck` as it is now. InputError.
  static std::vector<Branch> take(Deck& deck);
  static void document(Parameters& p);

  const std::string& name() const { return name_; }
  const std::string& from() const { return from_; }
  const Deck& deck() const { return deck_; }

  /// Name of its results where those of the deck's run are called `main`: "anchor_after_a_year".
  std::string result_name(const std::string& main) const;
  /// Compares the deck of the run with that of the branch, both with their formulas worked out. InputError where the
  /// branch has another model, other stages up to its start, or none after it.
  void check(const Deck& main, const Deck& branch) const;

 private:
  [[noreturn]] void fail(const std::string& message, const std::string& path = "") const;

  std::string name_, from_;
  Deck given_;  // its own entries alone
  Deck deck_;
};

}  // namespace mudline
