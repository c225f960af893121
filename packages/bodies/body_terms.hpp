#pragma once

#include <memory>
#include <vector>

#include "bodies/body_level.hpp"
#include "framework/term_faces.hpp"

namespace mudline {

using Bodies = std::vector<std::shared_ptr<RigidBody>>;

/// What the terms of bodies with unknowns share: one element per body, on the rank that owns it.
class BodyTerm : public Term, public Reports {
 public:
  explicit BodyTerm(Bodies bodies) : bodies_(std::move(bodies)) {}
  void sparsity(Assembler& assembler) override;

 protected:
  /// Adds what `forces` gives by unknown, for the bodies of this rank for which it gives something.
  template <class Forces>
  void add_slopes(const MatrixScatter& to, double weight, const Forces& forces) const;
  Bodies bodies_;
  int group_ = -1;
};

/// Moves all bodies over a step, before the other terms look at them: what is prescribed, and the clocks. No force.
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

/// R = m a, with the water that moves along; in a prescribed direction, whose rates are those of the motion, the
/// momentum that this takes in the step. In space J dw/dt + w x J w along the body's axes, which with spectral radius 1
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

/// Acceleration of a released body at the start of a stage, in the committed state, and where it is `anew` released its
/// initial velocity. `unbalanced`: the residual of that state at rest by overlap dof, what touches the body included.
void set_free(const RigidBody& body, State& committed, const NodalView& unbalanced, bool anew);

}  // namespace mudline
