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

/// Data of a step for impact forces. The position that is conjugate to a force at the momentum level runs ahead of the
/// value of a second-order field: the work of the force over the change of this position equals the change of the
/// integrator's kinetic energy. Without inertia the conjugate position is the value.
struct ImpactView {
  ConstNodalView ahead_old, ahead_end;  // by overlap dof [m]: conjugate position minus value; empty: 0
  double conjugate = 1;                 // [-] d (value_end + ahead_end) / d value_end
  double damping = 0;  // [-] weight of the end of the step above 1/2 in a force, which damps unresolved oscillations
  double lead = 0;     // [s] time by which the conjugate position runs ahead in a steady motion
};

/// One linearisation point of one step, seen by the terms. They never see beta, gamma or alpha.
/// All nodal views are by overlap dof. "end": t_{n+1}, where state variables live. The others are at the alpha level
/// that the integrator chose: `momentum` for inertia, gravity and mechanical loads, `balance` for mass (and heat)
/// balances.
struct StepView {
  /// Purpose of the evaluation: a step; the committed state at rest, without time passing; or the accelerations and
  /// rates at the start of a stage.
  enum class Kind { step, rest, initial_rates };
  Kind kind = Kind::step;
  double time_old, time_end, dt;  // [s]; dt is 1 s where the evaluation is no step
  Increment increment;
  double end_weight = 1;  // the integrator's weight of forces at the end of the step; the start has 1 - end_weight
  ConstNodalView value_old, value_end;
  ConstNodalView value, rate, velocity, acceleration;  // at the alpha level
  ConstCoordinateView x_old, x_end;                    // [m]
  Level momentum, balance;
  ImpactView impact;
  std::vector<Sensitivity> sensitivity;   // by field
  int linearisation = 0;                  // how often the step has been linearised before
  double elastic_share = 0;               // of elastic stiffness in the tangents of soil laws, in [0, 1)
  bool inertia;                           // false in quasi-static and geostatic stages
  bool flow;                              // false in a geostatic stage: storage and rates are off
  Kokkos::View<const char*> constrained;  // prescribed unknowns of the step, by overlap dof
  /// Pore pressures at a boundary that is open to water, by overlap dof, and the pressure of that water at the balance
  /// level [Pa].
  Kokkos::View<const char*> open;
  ConstNodalView outside;
  const State* committed;
  State* trial;  // history terms write their part, completely
};

/// Receives the contributions of a term to the residual, by overlap dof; exported (summed) over ranks by the caller.
/// Beside their sum it keeps their sizes before they cancel, against which the integrator measures convergence:
/// `acting` holds what acts in the step (rates, inertia, contact, and the change over the step of lasting stresses and
/// loads), and `whole` holds everything, whose rounding no iteration can remove. `passing` is the flow that passes
/// through open unknowns.
struct ResidualView {
  NodalView sum, acting, whole, passing;

  ResidualView() = default;
  /// Keeps the sums only.
  ResidualView(const NodalView& to) : sum(to) {}
  ResidualView(const NodalView& to, const NodalView& acts, const NodalView& all, const NodalView& passes = {})
      : sum(to), acting(acts), whole(all), passing(passes) {}

  /// Adds a contribution all of which acts in the step. All add() are for one thread only; loops use a VectorScatter.
  KOKKOS_INLINE_FUNCTION void add(int dof, double value) const { add(dof, value, value); }
  /// Adds a contribution of which only `change`, of either sign, acts in the step.
  KOKKOS_INLINE_FUNCTION void add(int dof, double value, double change) const {
    add(dof, value, change < 0 ? -change : change, value < 0 ? -value : value);
  }
  /// Adds a sum with both of its sizes.
  KOKKOS_INLINE_FUNCTION void add(int dof, double value, double acts, double all) const {
    sum(dof) += value;
    if (acting.extent(0) == 0) return;
    acting(dof) += acts;
    cancelled(dof, all);
  }
  /// Adds a flow out of the inside that passes through an open unknown.
  KOKKOS_INLINE_FUNCTION void pass(int dof, double flow) const {
    if (passing.extent(0) > 0) passing(dof) += flow;
  }
  /// Adds the size, in units of the residual, of numbers that cancelled before a contribution was formed. Example: a
  /// gap is the difference of two positions, so a spring of stiffness k at the position x has a rounding error of the
  /// order of k |x|.
  KOKKOS_INLINE_FUNCTION void cancelled(int dof, double size) const {
    if (whole.extent(0) > 0) whole(dof) += size;
  }
};

/// Category of a term in the balances of the history file.
enum class Role {
  force,     // acts on displacements: stresses, weights, loads
  inertia,   // mass times acceleration, of soil and bodies
  contact,   // forces between a surface and a body or another surface, and the scalar fluxes there
  balance,   // storage and flow of a scalar field in the interior; no force on displacements
  exchange,  // flow of a scalar through the boundary
  none
};

/// A part of the equations: its residual and its matrix. Optional abilities of terms are in term_faces.hpp.
class Term {
 public:
  virtual ~Term() = default;
  /// "stress divergence", "inertia", "contact/cone": used in balances and messages.
  virtual std::string name() const = 0;
  virtual Role role() const { return Role::force; }
  virtual void declare_state(StateStore&) {}
  /// Registers the element groups that jacobian() scatters to, one per element block, before the graph is built.
  virtual void sparsity(Assembler&) {}
  /// Called once per step after the predictor: does the contact search and computes what stays constant during the
  /// Newton iterations.
  virtual void begin(const StepView&) {}
  /// Adds to `f`. Pure in (committed, x). Returns the number of points on this rank where it failed.
  virtual int residual(const StepView&, const ResidualView& f) = 0;
  /// Adds weight * dR/dx at the linearisation point of the last residual call.
  virtual void jacobian(const StepView&, Assembler&, double weight) = 0;
};

/// Whether a term exchanges scalar fluxes at the boundary.
inline bool exchanges(const Term& term) { return term.role() == Role::exchange || term.role() == Role::contact; }

}  // namespace mudline
