#pragma once

#include <Teuchos_ParameterList.hpp>

#include <functional>
#include <string>
#include <vector>

#include "algebra/types.hpp"
#include "core/parameters.hpp"

namespace mudline {

/// A square nonlinear system F(x) = 0 for Newton's method; x and F have the same map.
class NonlinearProblem {
 public:
  virtual ~NonlinearProblem() = default;
  virtual RCP<const Map> map() const = 0;
  /// Pure in x. Returns false where F cannot be evaluated (a failed point on any rank); F is then undefined.
  /// Collective.
  virtual bool residual(const Vector& x, Vector& f) = 0;
  /// Linearises at x.
  virtual bool jacobian(const Vector& x) = 0;
  virtual void apply_jacobian(const Vector& v, Vector& jv) = 0;
  /// Solves J dx = f with the current linearisation.
  virtual bool solve(const Vector& f, Vector& dx) = 0;
  /// Norms per field, divided by their tolerances: converged when all are <= 1.
  virtual std::vector<double> residual_ratios(const Vector& f) = 0;
  virtual std::vector<double> update_ratios(const Vector& dx, const Vector& x) = 0;
  /// Whether the residual of the last residual_ratios() call is at the level of rounding errors.
  virtual bool at_rounding() const { return false; }
  /// In words, where the residual f is largest; "": not known. Collective.
  virtual std::string place_of_largest(const Vector& f) const { return ""; }
  /// Work [J] of the residual's forces, those of f, on the motion of dx: negative where the motion follows what is out
  /// of balance. 0: not known, or something else than forces is farther from its balance. Collective.
  virtual double work(const Vector& f, const Vector& dx) { return 0; }
  /// Called once per iterate with the largest of its residual ratios.
  virtual void observe(double worst) {}
};

/// A line search of NOX instead of the guarded step, with NOX's names. Line searches that need a slope are not offered:
/// the merit function here weighs the fields by their tolerances, and NOX's slope does not.
struct NoxLineSearch {
  enum class Method { full_step, backtrack };
  struct FullStep {
    double length = 1;
    void parameters(Parameters& p);
  };
  struct Backtrack {
    double first = 1, smallest = 1e-12, recovery = 1, reduction = 0.5;  // [-] fractions of the Newton step
    int evaluations = 100;
    void parameters(Parameters& p);
  };
  Method method = Method::full_step;
  FullStep full_step;
  Backtrack backtrack;
  void parameters(Parameters& p);
  /// The parameter list for NOX.
  Teuchos::ParameterList list() const;
};

/// Options passed on to NOX.
struct NoxOptions {
  NoxLineSearch line_search;
  void parameters(Parameters& p) { p.section("Line Search", line_search, "how far to go along Newton's direction"); }
};

/// Options of Newton's method.
struct NewtonOptions {
  enum class FirstGuess { committed, extrapolated };
  int maximum_iterations = 15;
  int least_iterations = 0;  // required even if the first guess has no residual; not a parameter
  int halvings = 4;
  double largest_growth = 0;   // [-] of the residual in one iteration; 0: no limit
  bool damped_retry = true;    // whether to solve once more in other ways where this one does not converge
  bool elastic_share = false;  // mix elastic stiffness into the tangents of soil laws; not a parameter
  bool reuse_jacobian = true;
  double largest_forcing = 0.1;  // fraction of the residual that a linear solve may leave; 0: forcing is off
  FirstGuess first_guess = FirstGuess::extrapolated;
  bool guess_on_trial = true;  // a guess that is more out of balance may get an iteration; not a parameter
  bool guarded = true;         // the deck names no line search of NOX
  NoxOptions nox;
  void parameters(Parameters& p);
  /// Whether a solve that does not converge may be repeated in the other ways.
  bool may_be_retried() const { return guarded && damped_retry; }
  /// The ways in which a step is solved, one after another until one converges: these options; the other steps, damped
  /// where these are full, and full where these are damped; elastic stiffness in the soil's tangents.
  std::vector<NewtonOptions> ways() const;
  /// The same options without a guess on trial.
  NewtonOptions from_balance() const;
  /// Those, with another `largest_growth`.
  NewtonOptions with_growth(double largest) const;
  /// Those of from_balance() with full steps and a share of elastic stiffness in the soil's tangents, see ElasticShare.
  NewtonOptions creeping() const;
};

/// Outcome of a Newton solve.
struct NewtonReport {
  bool converged = false;
  int iterations = 0;
  int evaluations = 0;
  std::string reason;                        // why it did not converge
  std::vector<std::vector<double>> history;  // residual ratios of every iteration, by field
};

/// Newton's method by NOX with a convergence test per field: the residual and (after the first update) the update are
/// below their tolerances, or the residual is below 1e-2 of its tolerance, or it has been at rounding for some
/// iterations, where updates mean nothing.
NewtonReport newton_solve(NonlinearProblem& problem, const NewtonOptions& options, Vector& x);

}  // namespace mudline
