#pragma once

#include <memory>

#include "core/deck.hpp"
#include "simulation/result_state.hpp"
#include "simulation/run_start.hpp"

namespace mudline {

/// The initial state "from result" of a model in space: the state in which an axisymmetric run ended a stage, turned
/// about the z axis. The soil gets its stresses, pore pressures, void ratios and the states of its laws, without
/// velocities; its displacements count from here.
class ResultStart {
 public:
  /// Looks for such an initial state in the deck's physics. InputError where its result is wrongly named.
  explicit ResultStart(const Section& deck);
  bool given() const { return section_ != nullptr; }
  /// Whether the result is there.
  bool exists() const { return start_.exists(); }
  /// Sets the committed state of the model. Returns the pore pressures from which the result counts its excess
  /// pressures [Pa], by overlap dof. InputError, on every rank alike, where the result is missing or does not fit the
  /// model. Collective.
  NodalView apply(Model& model, const Deck& deck) const;

 private:
  /// What the two models must have in common.
  void compare(const ResultState& result, const Model& model) const;
  void compare_bodies(const ResultState& result, const Model& model) const;
  /// Contacts of the same name start with the tractions of the result, and their points have slid as far.
  void take_contacts(const ResultState& result, Model& model) const;
  void warn_of_materials(const Deck& was, const Deck& now) const;

  std::unique_ptr<const Section> section_;  // null: none
  RunStart start_;
};

}  // namespace mudline
