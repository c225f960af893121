#pragma once

#include <memory>

#include "core/deck.hpp"
#include "discretisation/mesh.hpp"
#include "simulation/result_state.hpp"
#include "simulation/run_start.hpp"

namespace mudline {

/// The initial state "from result" of a model in space: the state in which an axisymmetric run ended a stage, turned
/// about the z axis. Bodies stand where they stood then. The soil gets its stresses, pore pressures, void ratios and
/// the states of its laws, without velocities; its displacements count from here.
class ResultStart {
 public:
  /// Looks for such an initial state in the deck's physics. InputError where its result is wrongly named.
  explicit ResultStart(const Section& deck);
  bool given() const { return section_ != nullptr; }
  /// Whether the result is there.
  bool exists() const { return start_.exists(); }
  /// Reads the result, before the model is made. Gives bodies of the deck without a position that of their namesake in
  /// the result. `geometry`: of the deck's mesh. InputError, on every rank alike, where the result is missing, or where
  /// a body stands elsewhere. Collective.
  void read(const RCP<const Comm>& comm, Geometry geometry, const Section& deck);
  /// Gives bodies of a deck without a position that of the deck which it goes on from, whose result may be gone.
  static void keep_places(const Section& before, const Section& deck);
  /// Sets the committed state of the model. Returns the pore pressures from which the result counts its excess
  /// pressures [Pa], by overlap dof. InputError, on every rank alike, where the result does not fit the model.
  /// Collective.
  NodalView apply(Model& model, const Deck& deck) const;

 private:
  /// What the two models must have in common.
  void compare(const ResultState& result, const Model& model) const;
  /// Places one of the deck's bodies as the result's body of its name.
  void place(const RigidBody& old, const Section& body) const;
  /// Contacts of the same name start with the tractions of the result, and their points have slid as far.
  void take_contacts(const ResultState& result, Model& model) const;
  void warn_of_materials(const Deck& was, const Deck& now) const;

  std::unique_ptr<const Section> section_;  // null: none
  RunStart start_;
  std::unique_ptr<const ResultState> result_;
};

}  // namespace mudline
