#pragma once

#include <string>
#include <vector>

#include "algebra/assembler.hpp"
#include "framework/state.hpp"

namespace mudline {

/// How the quantities that a term reads depend on the unknown x (the value at n+1) of one field.
struct Sensitivity {
  double value = 1;         // d value_alpha / dx
  double rate = 0;          // d rate_alpha / dx        (balance equations)
  double velocity = 0;      // d velocity_alpha / dx    (damping)
  double acceleration = 0;  // d acceleration_alpha / dx
};

/// Instant and configuration at which a group of terms is evaluated.
struct Level {
  double time;             // [s]
  ConstCoordinateView x;   // (node, dimension) [m]
  double geometry_weight;  // d x / d u_{n+1}
};

/// What forces of impact need of a step. The position that is conjugate to forces at the momentum level is ahead of the
/// value of a field of second order: over its change, not over that of the value, such a force does the work that the
/// integrator's kinetic energy takes up. Without inertia it is the value.
struct ImpactView {
  ConstNodalView ahead_old, ahead_end;  // by overlap dof [m]: conjugate position less value; empty: 0
  double conjugate = 1;                 // [-] d (value_end + ahead_end) / d value_end
  double damping = 0;  // [-] by which a force weighs the end of the step above 1/2 to damp what is not resolved
  double lead = 0;     // [s] time by which the conjugate position is ahead, for what moves steadily
};

/// One linearisation point of one step, seen by the terms. They never see beta, gamma or alpha.
/// All nodal views are by overlap dof. "end": t_{n+1}, where state variables live. The others are at the alpha level
/// that the integrator chose: `momentum` for inertia, gravity and mechanical loads, `balance` for mass (and heat)
/// balances.
struct StepView {
  /// What is asked for: a step; the committed state as it is, at rest, no time passing; or the accelerations and rates
  /// with which a stage starts from it.
  enum class Kind { step, rest, initial_rates };
  Kind kind = Kind::step;
  double time_old, time_end, dt;  // [s]; dt of what is no step: 1 s
  Increment increment;
  double end_weight = 1;  // by which the integrator weighs forces of the end of the step; 1 less that: the start
  ConstNodalView value_old, value_end;
  ConstNodalView value, rate, velocity, acceleration;  // at the alpha level
  ConstCoordinateView x_old, x_end;                    // [m]
  Level momentum, balance;
  ImpactView impact;
  std::vector<Sensitivity> sensitivity;   // by field
  int linearisation = 0;                  // how often the step has been linearised before
  bool inertia;                           // false in quasi-static and geostatic stages
  bool flow;                              // false in a geostatic stage: storage and rates are off
  Kokkos::View<const char*> constrained;  // prescribed unknowns of the step, by overlap dof
  const State* committed;
  State* trial;  // history terms write their part, completely
};

/// Receives the contributions of a term to the residual, by overlap dof; exported (summed) over ranks by the caller.
/// Beside their sum it keeps their sizes before they cancel, against which the integrator measures convergence:
/// `acting`, what acts in the step (rates, inertia, contact, and of what stands for longer, stresses and loads, the
/// change over the step), and `whole`, everything, whose rounding no iteration can remove.
struct ResidualView {
  NodalView sum, acting, whole;

  ResidualView() = default;
  /// Sums only.
  ResidualView(const NodalView& to) : sum(to) {}
  ResidualView(const NodalView& to, const NodalView& acts, const NodalView& all) : sum(to), acting(acts), whole(all) {}

  /// A contribution that acts in the step as a whole. From one thread only, as all of these; loops use a VectorScatter.
  KOKKOS_INLINE_FUNCTION void add(int dof, double value) const { add(dof, value, value); }
  /// One of which `change`, of either sign, acts in the step.
  KOKKOS_INLINE_FUNCTION void add(int dof, double value, double change) const {
    add(dof, value, change < 0 ? -change : change, value < 0 ? -value : value);
  }
  /// A sum with both of its sizes.
  KOKKOS_INLINE_FUNCTION void add(int dof, double value, double acts, double all) const {
    sum(dof) += value;
    if (acting.extent(0) == 0) return;
    acting(dof) += acts;
    cancelled(dof, all);
  }
  /// The size [of the residual] of what cancelled before a contribution was formed: a gap is the difference of two
  /// positions, so a spring of stiffness k at the position x leaves rounding of k |x|.
  KOKKOS_INLINE_FUNCTION void cancelled(int dof, double size) const {
    if (whole.extent(0) > 0) whole(dof) += size;
  }
};

/// What a term is in the balances of the history file.
enum class Role {
  force,     // acts on displacements: stresses, weights, loads
  inertia,   // the force that the others leave, of soil and bodies
  contact,   // forces between a surface and a body or another surface, and what scalars pass there
  balance,   // of a scalar field inside: storage and flow; acts on no displacement
  exchange,  // brings a scalar in through the boundary, or takes it out
  none
};

/// A part of the equations: its residual and its matrix. What only some terms have is in term_faces.hpp.
class Term {
 public:
  virtual ~Term() = default;
  /// "stress divergence", "inertia", "contact/cone": used in balances and messages.
  virtual std::string name() const = 0;
  virtual Role role() const { return Role::force; }
  virtual void declare_state(StateStore&) {}
  /// Registers the element groups that jacobian() scatters to, one per element block, before the graph is built.
  virtual void sparsity(Assembler&) {}
  /// Once per step, after the predictor: search, freeze what stays fixed during Newton.
  virtual void begin(const StepView&) {}
  /// Adds to `f`. Pure in (committed, x). Returns the number of points on this rank where it failed.
  virtual int residual(const StepView&, const ResidualView& f) = 0;
  /// Adds weight * dR/dx at the linearisation point of the last residual call.
  virtual void jacobian(const StepView&, Assembler&, double weight) = 0;
};

}  // namespace mudline
