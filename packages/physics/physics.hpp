#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "algebra/linear_solver.hpp"
#include "core/registry.hpp"
#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// What a physics gets to build itself, and where it leaves what others need.
struct PhysicsContext {
  const Space& space;
  const std::vector<std::shared_ptr<SoilMaterial>>& materials;
  const Section& materials_section;           // for messages
  std::vector<std::unique_ptr<Term>>& terms;  // add yours
  std::shared_ptr<Soil>& soil;                // set by a physics with soil; null otherwise
  /// Data of the block preconditioner; set by physics it can treat.
  std::function<BlockData(const StepView&)>& block_data;
};

/// A set of balance equations: names its fields, then adds its terms. Several physics of one deck share fields by name
/// and are solved as one monolithic system.
class Physics {
 public:
  virtual ~Physics() = default;
  /// Fields of this physics; a field that several name must be declared alike.
  virtual std::vector<Field> fields() const = 0;
  /// Checks that the mesh suits the discretisation (stable pairs). InputError through section.
  virtual void check_mesh(const Mesh& mesh, const Section& section) const {}
  /// Creates the terms. InputError through section. Collective.
  virtual void build(PhysicsContext& context, const Section& section) = 0;
  /// Sets the initial stresses and pressures of the committed state. InputError through section. Collective.
  virtual void initialise(StateStore& store, const Section& section) {}
};

/// "biot" and "solid"; a plain list.
void register_physics(Registry<Physics>& registry);

}  // namespace mudline
