#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "algebra/linear_solver.hpp"
#include "core/registry.hpp"
#include "framework/conserved.hpp"
#include "framework/material.hpp"
#include "framework/shared.hpp"
#include "framework/term.hpp"

namespace mudline {

/// Input for building a physics, and the lists to which it adds what others need.
struct PhysicsContext {
  const Space& space;
  const Materials& materials;
  const Section& materials_section;           // for messages
  std::vector<std::unique_ptr<Term>>& terms;  // the physics adds its terms here
  Shared& shared;                             // the physics offers objects to others here: a physics with soil its Soil
  std::vector<Conserved>& conserved;          // the physics adds the conserved quantities of its scalar fields here
  /// Data of the block preconditioner; set by a physics that supports it.
  std::function<BlockData(const StepView&)>& block_data;
};

/// A set of balance equations: names its fields, then adds its terms. Several physics of one deck share fields by name
/// and are solved as one monolithic system.
class Physics {
 public:
  virtual ~Physics() = default;
  /// Fields of this physics; all physics that name the same field must declare it alike.
  virtual std::vector<Field> fields() const = 0;
  /// Checks that the mesh suits the discretisation (stable pairs). InputError through section.
  virtual void check_mesh(const Mesh& mesh, const Section& section) const {}
  /// Creates the terms. InputError through section. Collective.
  virtual void build(PhysicsContext& context, const Section& section) = 0;
  /// Sets the initial stresses and pressures of the committed state. InputError through section. Collective.
  virtual void initialise(StateStore& store, const Section& section) {}
};

}  // namespace mudline
