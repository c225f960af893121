#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ale/ale.hpp"
#include "bodies/body_terms.hpp"
#include "framework/closed_sides.hpp"
#include "integrator/step_system.hpp"
#include "simulation/registries.hpp"
#include "simulation/stage.hpp"

namespace mudline {

/// The source of a model's mesh where that is not the deck's section "mesh".
struct MeshOrigin {
  std::string parts_file = {};                             // file of `mudline split`
  std::shared_ptr<const RemeshedMesh> remeshed = nullptr;  // mesh of a remeshing, whose state is transferred or read
};

/// The deck turned into objects: mesh, fields, terms, conditions, bodies, contacts, stages, solver; ready to step.
class Model {
 public:
  /// Builds everything and validates what it reads; on a remeshed mesh there is no initial state. What contradicts each
  /// other is refused by check_deck() of the package checks. InputError on every rank alike. Collective.
  Model(RCP<const Comm> comm, const Section& deck, const Registries& registries, const MeshOrigin& origin = {});

  const Mesh& mesh() const { return *mesh_; }
  /// The mesh of the last remeshing; null: the mesh is the deck's.
  const RemeshedMesh* remeshed() const { return remeshed_.get(); }
  const Space& space() const { return *space_; }
  StateStore& store() { return *store_; }
  const StateStore& store() const { return *store_; }
  StepSystem& system() { return *system_; }
  const StepSystem& system() const { return *system_; }
  const Materials& materials() const { return materials_; }
  const std::shared_ptr<Soil>& soil() const { return soil_; }
  const std::vector<Conserved>& conserved() const { return conserved_; }
  const std::vector<std::unique_ptr<Stage>>& stages() const { return stages_; }
  /// The index of one of these stages.
  std::size_t index_of(const Stage& stage) const;
  const std::map<std::string, std::shared_ptr<RigidBody>>& bodies() const { return bodies_; }
  /// The body of this name, which an entry of the section gives. InputError there where there is none.
  RigidBody& body(const std::string& name, const Section& section, const std::string& entry) const;
  const std::vector<std::pair<std::string, std::unique_ptr<Contact>>>& contacts() const { return contacts_; }
  const std::vector<std::unique_ptr<Condition>>& conditions() const { return conditions_; }
  /// Every term of the model, active or not, in a fixed order.
  std::vector<const Term*> all_terms() const;
  /// These with names of their own: "#1" follows at the second term of a name.
  std::vector<std::pair<const Term*, std::string>> named_terms() const;
  /// Mesh motion; null: the mesh moves with the soil.
  const Ale* ale() const { return ale_.get(); }
  const StepTolerances& tolerances() const { return tolerances_; }
  const NewtonOptions& newton() const { return newton_; }

  /// Makes the terms, conditions and bodies of a stage the active ones. `fresh`: the stage starts (not a restart within
  /// it); newly active absorbing boundaries then hold the present reactions.
  void activate(const Stage& stage, bool fresh);
  /// Sets velocities and accelerations of the bodies whose motion changes; to be called when a stage starts, after its
  /// initial rates. Collective.
  void start_bodies(const Stage& stage);
  /// Overlap dofs of the bodies' unknowns that were released in the stage before.
  const std::vector<int>& released_before() const { return released_before_; }
  /// Drained constrained modulus of an element of soil [Pa], the mean over its points in the committed state.
  double constrained_modulus(int block, int element) const;
  /// The motion of a body in a stage; null: it rests.
  std::shared_ptr<const BodyMotion> motion_in(const Stage& stage, const std::string& body) const;
  /// Adds the prescribed unknowns of a stage for a step from `t_old` to `t_end` [s].
  void prescribe(const Stage& stage, double t_old, double t_end, const State& committed, Constraints& to) const;

 private:
  void read_mesh(RCP<const Comm> comm, const Section& deck, const Registries& registries, const MeshOrigin& origin);
  /// Sets the state at the start of a run.
  void initialise(const Section& deck);
  void read_materials(const Section& deck, const Registries& registries);
  void read_physics(const Section& deck, const Registries& registries);
  void read_conditions(const Section& deck, const Registries& registries);
  void read_bodies(const Section& deck, const Registries& registries);
  void read_contacts(const Section& deck, const Registries& registries);
  void read_mesh_motion(const Section& deck, const Registries& registries);
  void read_stages(const Section& deck, const Registries& registries);
  /// Checks that the soil has strengths to reduce. InputError in `section`.
  void check_strengths(const Section& section) const;
  void read_solver(const Section& deck, const Registries& registries);
  /// Gives conditions of a stage the residual of the terms `acting`. Collective.
  void activate_conditions(const Stage& stage, const std::vector<Condition*>& conditions,
                           const std::vector<Term*>& acting);
  /// Data of the physics for the linear solver, with the nodes at which contacts press.
  BlockData block_data(const StepView& view) const;

  std::shared_ptr<const RemeshedMesh> remeshed_;
  std::unique_ptr<Mesh> mesh_;
  std::unique_ptr<Space> space_;
  Materials materials_;
  std::vector<std::unique_ptr<Physics>> physics_;
  std::vector<Conserved> conserved_;
  Shared shared_;  // objects that the physics share
  std::shared_ptr<Soil> soil_;
  std::function<BlockData(const StepView&)> block_data_;
  std::vector<std::unique_ptr<Term>> terms_;  // of the physics
  std::vector<std::unique_ptr<Condition>> conditions_;
  std::vector<HoldsOnOpenSides*> on_open_sides_;  // of the conditions
  std::map<std::string, std::shared_ptr<RigidBody>> bodies_;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const BodyMotion>> stage_motions_;  // by stage and body
  std::set<std::string> changed_motions_;  // bodies whose motion changes in this stage
  std::vector<int> released_before_;
  std::vector<std::pair<std::string, std::unique_ptr<Contact>>> contacts_;
  std::vector<std::pair<std::string, const ClosesSides*>> sealing_;  // of the contacts
  std::unique_ptr<Ale> ale_;
  std::vector<std::unique_ptr<Stage>> stages_;
  std::unique_ptr<LinearSolver> solver_;
  std::unique_ptr<StateStore> store_;
  std::unique_ptr<StepSystem> system_;
  StepTolerances tolerances_;
  NewtonOptions newton_;
  std::set<std::string> active_conditions_;  // of the stage before
};

/// The recipe of the deck's mesh. InputError on any rank where the entries are wrong.
MeshRecipe mesh_recipe(const Section& deck, const Registries& registries);

/// The deck's top-level sections.
const std::vector<std::string>& deck_sections();

}  // namespace mudline
