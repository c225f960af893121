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

/// What a physics gets to build itself, and where it leaves what others need.
struct PhysicsContext {
  const Space& space;
  const Materials& materials;
  const Section& materials_section;           // for messages
  std::vector<std::unique_ptr<Term>>& terms;  // add yours
  Shared& shared;                             // what others may use: a physics with soil offers its Soil
  std::vector<Conserved>& conserved;          // add what your scalar fields conserve
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

}  // namespace mudline
