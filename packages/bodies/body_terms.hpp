#pragma once

#include <memory>
#include <vector>

#include "bodies/body_level.hpp"
#include "framework/term_faces.hpp"

namespace mudline {

using Bodies = std::vector<std::shared_ptr<RigidBody>>;

/// Base of the terms of bodies with unknowns: one element per body, on the rank that owns it.
class BodyTerm : public Term, public Reports {
 public:
  explicit BodyTerm(Bodies bodies) : bodies_(std::move(bodies)) {}
  void sparsity(Assembler& assembler) override;

 protected:
  /// Adds the derivatives of `forces` (by unknown) to the matrix, for the bodies of this rank for which it returns
  /// true.
  template <class Forces>
  void add_slopes(const MatrixScatter& to, double weight, const Forces& forces) const;
  Bodies bodies_;
  int group_ = -1;
};

/// Advances all bodies over a step, before the other terms use them: their prescribed motion and their clocks. No
/// force.
class BodyPaths : public Term {
 public:
  explicit BodyPaths(Bodies bodies) : bodies_(std::move(bodies)) {}
  std::string name() const override { return "body paths"; }
  Role role() const override { return Role::none; }
  void begin(const StepView& view) override;
  int residual(const StepView&, const ResidualView&) override { return 0; }
  void jacobian(const StepView&, Assembler&, double) override {}

 private:
  Bodies bodies_;
};

/// R = m a, with the water that moves with the body; in a prescribed direction, whose rates are those of the motion, R
/// is the force that this motion takes. In space J dw/dt + w x J w along the body's axes, which with spectral radius 1
/// keeps energy and angular momentum (Simo and Wong 1991).
class BodyInertia : public BodyTerm {
 public:
  using BodyTerm::BodyTerm;
  std::string name() const override { return "body inertia"; }
  Role role() const override { return Role::inertia; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  void histories(const StepView& view, Report& values) override;
};

/// Weight, buoyancy, drag and given forces, at the alpha level. R = -F.
class BodyLoads : public BodyTerm {
 public:
  using BodyTerm::BodyTerm;
  std::string name() const override { return "body loads"; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  void histories(const StepView& view, Report& values) override;
};

/// Sets the acceleration of a released body at the start of a stage, in the committed state; where its motion is `anew`
/// in this stage also its initial velocity. `unbalanced`: residual of that state at rest, by overlap dof, with the
/// forces of all that touches the body.
void set_free(const RigidBody& body, State& committed, const NodalView& unbalanced, bool anew);

}  // namespace mudline
