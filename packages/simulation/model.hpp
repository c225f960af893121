#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ale/ale.hpp"
#include "bodies/body_terms.hpp"
#include "discretisation/mesh_topology.hpp"
#include "framework/closed_sides.hpp"
#include "integrator/stepper.hpp"
#include "simulation/registries.hpp"
#include "simulation/stage.hpp"

namespace mudline {

/// Where a model's mesh comes from, where it is not made by its deck.
struct MeshOrigin {
  std::string parts_file = {};                           // file of `mudline split`
  std::shared_ptr<const RenewedMesh> renewed = nullptr;  // made on the way, and the state comes from elsewhere, too
};

/// The deck turned into objects: mesh, fields, terms, conditions, bodies, contacts, stages, solver; ready to step.
class Model {
 public:
  /// Builds and validates everything; on a renewed mesh what can be validated there, and the initial state is left
  /// out. InputError on every rank alike. Collective.
  Model(RCP<const Comm> comm, const Section& deck, const Registries& registries, const MeshOrigin& origin = {});

  const Mesh& mesh() const { return *mesh_; }
  /// The mesh as it was made on the way; null: it is the deck's.
  const RenewedMesh* renewed() const { return renewed_.get(); }
  const Space& space() const { return *space_; }
  StateStore& store() { return *store_; }
  const StateStore& store() const { return *store_; }
  Stepper& stepper() { return *stepper_; }
  const std::shared_ptr<Soil>& soil() const { return soil_; }
  const std::vector<Conserved>& conserved() const { return conserved_; }
  const std::vector<std::unique_ptr<Stage>>& stages() const { return stages_; }
  const std::map<std::string, std::shared_ptr<RigidBody>>& bodies() const { return bodies_; }
  const std::vector<std::pair<std::string, std::unique_ptr<Contact>>>& contacts() const { return contacts_; }
  const std::vector<std::unique_ptr<Condition>>& conditions() const { return conditions_; }
  /// Every term of the model, active or not, in a fixed order.
  std::vector<const Term*> all_terms() const;
  /// Mesh motion; null: the mesh goes with the soil.
  const Ale* ale() const { return ale_.get(); }
  const StepTolerances& tolerances() const { return tolerances_; }
  const NewtonOptions& newton() const { return newton_; }

  /// Terms, conditions and bodies of a stage become the active ones. `fresh`: the stage starts (not a restart within
  /// it): newly active absorbing boundaries take over the present reactions.
  void activate(const Stage& stage, bool fresh);
  /// When a stage starts, after its initial rates: velocities and accelerations of the bodies whose motion changes.
  /// Collective.
  void start_bodies(const Stage& stage);
  /// Unknowns (by overlap dof) of bodies which the stage before left free.
  const std::vector<int>& released_before() const { return released_before_; }
  /// Drained constrained modulus of an element of soil [Pa], the mean over its points in the committed state.
  double constrained_modulus(int block, int element) const;
  /// The motion of a body in a stage; null: it rests.
  std::shared_ptr<const BodyMotion> motion_in(const Stage& stage, const std::string& body) const;
  /// Prescribed unknowns of a stage.
  void prescribe(const Stage& stage, double t_old, double t_end, const State& committed, Constraints& to) const;

 private:
  void read_mesh(RCP<const Comm> comm, const Section& deck, const Registries& registries, const MeshOrigin& origin);
  void check_start(const Section& deck);
  void read_materials(const Section& deck, const Registries& registries);
  void read_physics(const Section& deck, const Registries& registries);
  void read_conditions(const Section& deck, const Registries& registries);
  void read_bodies(const Section& deck, const Registries& registries);
  void read_contacts(const Section& deck, const Registries& registries);
  void read_mesh_motion(const Section& deck, const Registries& registries);
  void read_stages(const Section& deck, const Registries& registries);
  void read_solver(const Section& deck, const Registries& registries);
  void check_contradictions(const Section& deck) const;
  void check_motions(const Section& deck) const;
  void check_supports(const Section& deck, const MeshParts& parts);
  /// Conditions and contacts that no stage lists, bodies that nothing uses.
  void check_unused(const Section& deck) const;
  /// Every part of a mesh in several parts has a condition or a contact that could hold it, in whatever stage.
  void check_parts(const Section& deck, const MeshParts& parts) const;
  /// Of the physics, with what contacts press.
  BlockData block_data(const StepView& view) const;

  std::shared_ptr<const RenewedMesh> renewed_;
  std::unique_ptr<Mesh> mesh_;
  std::unique_ptr<Space> space_;
  Materials materials_;
  std::vector<std::unique_ptr<Physics>> physics_;
  std::vector<Conserved> conserved_;
  Shared shared_;  // what the physics offer
  std::shared_ptr<Soil> soil_;
  std::function<BlockData(const StepView&)> block_data_;
  std::vector<std::unique_ptr<Term>> terms_;  // of the physics
  std::vector<std::unique_ptr<Condition>> conditions_;
  std::vector<HoldsOnOpenSides*> on_open_sides_;  // of the conditions
  std::map<std::string, std::shared_ptr<RigidBody>> bodies_;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const BodyMotion>> stage_motions_;  // by stage and body
  std::set<std::string> moved_anew_;  // bodies whose motion in this stage is another than before
  std::vector<int> released_before_;
  std::vector<std::pair<std::string, std::unique_ptr<Contact>>> contacts_;
  std::vector<std::pair<std::string, const ClosesSides*>> sealing_;  // of the contacts
  std::unique_ptr<Ale> ale_;
  std::vector<std::unique_ptr<Stage>> stages_;
  std::unique_ptr<LinearSolver> solver_;
  std::unique_ptr<StateStore> store_;
  std::unique_ptr<Stepper> stepper_;
  StepTolerances tolerances_;
  NewtonOptions newton_;
  std::set<std::string> active_conditions_;  // of the stage before
};

/// How the deck's mesh is made. InputError on whatever rank the entries are wrong.
MeshRecipe mesh_recipe(const Section& deck, const Registries& registries);

/// The deck's top-level sections.
const std::vector<std::string>& deck_sections();

}  // namespace mudline
