#pragma once

#include <vector>

#include "framework/space.hpp"
#include "framework/state.hpp"

namespace mudline {

class Parameters;

/// Tolerances of one step.
struct StepTolerances {
  double residual = 1e-6;  // relative to the size of what acts in the step, before cancellation, per field
  double update = 1e-4;    // relative to the increment of the step, per field
  double linear = 1e-8;
  void parameters(Parameters& p);
};

/// Measures how far an iterate of a step is from a solution, field by field. The residual is compared with the size of
/// what acts, before it cancels, and with its rounding; the update with the increment of the step. The sizes of the
/// steps before are the state array "step measures", with a row per field. All that takes a vector is collective.
class Convergence {
 public:
  /// Both must outlive it.
  Convergence(const Space& space, StateStore& store);
  void declare_state();

  /// Forgets what acted in the stage before.
  void begin_stage();
  void begin_step(const StepTolerances& tolerances);
  /// Takes the sizes of an evaluation, by overlap dof: of what acts, and of all contributions, for their rounding.
  void measure(const NodalView& acting, const NodalView& whole);
  /// Takes the rounding of the residual that the rounding of the unknowns x causes through the matrix.
  void measure_rounding(const CrsMatrix& matrix, const Vector& x);
  /// Norms of a residual over those allowed, by field: at most 1 where it has converged.
  std::vector<double> residual_ratios(const Vector& f);
  /// Where the residual f of the last residual_ratios() is largest, in the field that is farthest from its tolerance:
  /// "most of it in 'displacement' at (0.2, -1.44)". Collective.
  std::string place_of_largest(const Vector& f) const;
  /// Norms of the update dx that led to x over those allowed, by field.
  std::vector<double> update_ratios(const Vector& dx, const Vector& x) const;
  /// Whether the last residual is at its rounding.
  bool at_rounding() const;
  /// The largest ratio of the residual observed before, by what is allowed now, so that the contraction does not depend
  /// on a reference that has grown meanwhile; 0 if there is none. The last residual is the observed one from now on.
  double observe();
  /// Takes the sizes of a step that has converged to x.
  void accept(const Vector& x);

  /// Size of what acted at the last evaluation, by field.
  const std::vector<double>& acting() const { return acting_; }
  /// Allowed norms of the last residual, by field.
  const std::vector<double>& limits() const { return limits_; }
  double linear_tolerance() const { return tolerances_.linear; }
  /// Largest norm of each field so far, the last attempt among them.
  std::vector<double> largest_norms() const;

 private:
  enum Column {
    most_acting,  // largest size of what acted in a step of the stage so far, or of its rounding: gives the floor
    value,        // largest norm of the field so far, for its rounding
    matrix        // size of the last matrix of the stage; 0: none yet
  };
  double& of(const State& state, int field, Column column) const { return state.arrays[array_](field, column); }
  /// Norms allowed, by field, where what acts is at least `least`.
  std::vector<double> allowed(const std::vector<double>& least) const;
  double limit_matrix(int field) const;

  const Space& space_;
  StateStore& store_;
  int array_ = -1;
  StepTolerances tolerances_;
  double coordinate_norm_ = 0;
  // By field: rounding of the residual, its part through the matrix, size of the matrix; norms of the first, of the
  // last and of the previously observed residual.
  std::vector<double> acting_, rounding_, matrix_rounding_, matrix_sizes_, first_norms_, norms_, limits_,
      observed_norms_;
};

}  // namespace mudline
