#include "integrator/newton.hpp"

#include <Teuchos_oblackholestream.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "core/errors.hpp"
#include "core/log.hpp"
#include "integrator/guarded_step.hpp"
#include "integrator/nox_interface.hpp"

namespace mudline {

namespace {

/// The convergence test per field of newton_solve(); also fails if a residual is not finite.
class FieldTest : public NOX::StatusTest::Generic {
 public:
  FieldTest(NonlinearProblem& problem, NewtonReport& report, const NewtonOptions& options)
      : problem_(problem),
        report_(report),
        least_(options.least_iterations),
        maximum_(options.maximum_iterations),
        gives_up_(options.may_be_retried() && options.largest_growth == 0) {}

  NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic& solver, NOX::StatusTest::CheckType) override {
    const auto& group = solver.getSolutionGroup();
    const int iteration = solver.getNumIterations();
    report_.iterations = iteration;
    const std::vector<double> f = problem_.residual_ratios(NoxVector::of(group.getF()));
    const double worst = largest(f);
    if (static_cast<int>(report_.history.size()) <= iteration) {
      report_.history.push_back(f);
      problem_.observe(worst);
      at_rounding_ = problem_.at_rounding() ? at_rounding_ + 1 : 0;
      worsts_.push_back(worst);
    }
    log_iteration(iteration, f, NoxVector::of(group.getF()));
    if (!std::isfinite(worst)) return finish(NOX::StatusTest::Failed, "the residual could not be evaluated");
    double worst_update = 0;
    if (iteration > 0) {
      Vector dx(NoxVector::of(group.getX()), Teuchos::Copy);
      dx.update(-1.0, NoxVector::of(solver.getPreviousSolutionGroup().getX()), 1.0);
      worst_update = largest(problem_.update_ratios(dx, NoxVector::of(group.getX())));
    }
    constexpr int idle = 4;  // iterates at rounding after which the solve has converged
    const bool deep = worst <= 1e-2 || at_rounding_ >= idle;
    if (iteration >= least_ && (deep || (iteration > 0 && worst <= 1 && worst_update <= 1)))
      return finish(NOX::StatusTest::Converged, "");
    if (gives_up_ && alternates())
      return finish(NOX::StatusTest::Failed, "the iterates go to and fro (residual " + short_number(worst) +
                                                 " of its tolerance) after " + std::to_string(iteration) +
                                                 " iterations");
    if (iteration >= maximum_) {
      const std::string text = worst > 1 ? "residual " + short_number(worst) : "update " + short_number(worst_update);
      const std::string place = worst > 1 ? problem_.place_of_largest(NoxVector::of(group.getF())) : "";
      return finish(NOX::StatusTest::Failed, "no convergence in " + std::to_string(iteration) + " iterations (" + text +
                                                 " of its tolerance" + (place.empty() ? "" : ", " + place) + ")");
    }
    return status_ = NOX::StatusTest::Unconverged;
  }
  NOX::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& out, int) const override { return out; }

 private:
  static double largest(const std::vector<double>& v) {
    double m = 0;
    for (double x : v) m = std::isfinite(x) ? std::max(m, x) : std::numeric_limits<double>::quiet_NaN();
    for (double x : v)
      if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
    return m;
  }
  static std::string short_number(double x) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.2g times", x);
    return buffer;
  }
  /// Whether the last two residuals repeat those of two iterations before while they are large: full steps then
  /// alternate between two states of contact or yielding.
  bool alternates() const {
    constexpr double same = 0.01, large = 100;
    const std::size_t n = worsts_.size();
    if (n < 4) return false;
    for (std::size_t k = n - 2; k < n; ++k)
      if (!(worsts_[k] > large) || !(std::abs(worsts_[k] - worsts_[k - 2]) <= same * worsts_[k])) return false;
    return true;
  }
  void log_iteration(int iteration, const std::vector<double>& f, const Vector& residual) const {
    if (log::level() < log::Level::debug) return;
    std::string line = "    newton " + std::to_string(iteration) + ":";
    for (double r : f) {
      char buffer[32];
      std::snprintf(buffer, sizeof buffer, " %.3e", r);
      line += buffer;
    }
    const std::string place = problem_.place_of_largest(residual);
    log::detail(line + (place.empty() ? "" : "  " + place));
  }
  NOX::StatusTest::StatusType finish(NOX::StatusTest::StatusType status, const std::string& reason) {
    report_.converged = status == NOX::StatusTest::Converged;
    report_.reason = reason;
    return status_ = status;
  }
  NonlinearProblem& problem_;
  NewtonReport& report_;
  int least_, maximum_, at_rounding_ = 0;
  bool gives_up_;               // whether full steps that alternate stop early, because another way may follow
  std::vector<double> worsts_;  // largest residual ratio of every iterate
  NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
};

}  // namespace

namespace {

/// Fractions of Newton's step: (0, 1].
Range share() { return {0, 1, true, false}; }

}  // namespace

NewtonOptions NewtonOptions::from_balance() const {
  NewtonOptions result = *this;
  result.guess_on_trial = false;
  return result;
}

NewtonOptions NewtonOptions::with_growth(double largest) const {
  NewtonOptions result = from_balance();
  result.largest_growth = largest;
  return result;
}

std::vector<NewtonOptions> NewtonOptions::ways() const {
  constexpr double damped = 1.2, full = 0;
  if (!may_be_retried()) return {*this};
  return {*this, with_growth(largest_growth > 0 ? full : damped), creeping()};
}

NewtonOptions NewtonOptions::creeping() const {
  constexpr int patience = 7;
  NewtonOptions result = with_growth(0);
  result.elastic_share = true;
  result.reuse_jacobian = false;
  result.maximum_iterations = patience * maximum_iterations;
  return result;
}

void NewtonOptions::parameters(Parameters& p) {
  p.add("maximum iterations", maximum_iterations, "-", closed(1, 1000),
        "Newton iterations of a try before the step is cut; seven times as many with elastic stiffness, see 'damped "
        "retry'");
  p.add("halvings", halvings, "-", closed(0, 20),
        "largest number of times that an iteration's step is halved where the residual cannot be evaluated or grows "
        "too much; not with a line search of NOX");
  p.add("largest growth", largest_growth, "-", non_negative(),
        "of the residual in one iteration, before its step is halved; 0: any, full steps are tried first");
  p.add("damped retry", damped_retry,
        "Where full steps do not converge, solve the time step once more with a 'largest growth' of 1.2 (with full "
        "steps where a 'largest growth' is given), then with elastic stiffness mixed into the tangents of the soil, "
        "before it is cut");
  p.add("reuse Jacobian", reuse_jacobian,
        "Go on with an earlier Jacobian, also of the step before, while the residual falls so fast that a new one "
        "would not pay");
  p.add("largest forcing", largest_forcing, "-", Range{0, 1, false, true},
        "share of a Newton iterate's residual that an iterative linear solver may leave; it falls with the residual "
        "(Eisenstat and Walker); 0: always solved to 'linear tolerance'");
  p.choice(
      "first guess", first_guess, {{"committed", FirstGuess::committed}, {"extrapolated", FirstGuess::extrapolated}},
      "of a step: the state it starts from; extrapolated: moved on with the rates of that state where that, or without "
      "inertia one iteration from there, leaves less out of balance, because what moves goes on moving and soil that "
      "yields goes on yielding");
  p.section("nox", nox, "a line search of NOX instead of the guarded full steps, with NOX's names");
  guarded = p.documenting() || !p.deck().has_section("nox");
  for (const char* entry : {"halvings", "largest growth", "damped retry"})
    if (!guarded && p.given(entry)) p.deck().fail("has no effect beside a line search of NOX (section 'nox')", entry);
}

void NoxLineSearch::FullStep::parameters(Parameters& p) {
  p.add("Full Step", length, "-", share(), "share of Newton's step that is taken");
}

void NoxLineSearch::Backtrack::parameters(Parameters& p) {
  p.add("Default Step", first, "-", share(), "share of Newton's step that is tried first");
  p.add("Minimum Step", smallest, "-", share(), "the search fails below this share");
  p.add("Recovery Step", recovery, "-", share(), "share that is taken where the search fails");
  p.add("Max Iters", evaluations, "-", closed(1, 1000), "evaluations of the residual before the search fails");
  p.add("Reduction Factor", reduction, "-", open(0, 1), "from one trial to the next");
}

void NoxLineSearch::parameters(Parameters& p) {
  p.choice("Method", method, {{"Full Step", Method::full_step}, {"Backtrack", Method::backtrack}},
           "always the same share of Newton's step, or shorter ones until the residual falls");
  p.section("Full Step", full_step, "with this method");
  p.section("Backtrack", backtrack, "with this method");
  if (p.documenting()) return;
  const char* idle = method == Method::backtrack ? "Full Step" : "Backtrack";
  if (p.deck().has_section(idle)) p.deck().fail("has no effect with another 'Method'", idle);
}

Teuchos::ParameterList NoxLineSearch::list() const {
  Teuchos::ParameterList list("Line Search");
  list.set("Method", method == Method::backtrack ? "Backtrack" : "Full Step");
  if (method == Method::full_step) list.sublist("Full Step").set("Full Step", full_step.length);
  if (method != Method::backtrack) return list;
  Teuchos::ParameterList& search = list.sublist("Backtrack");
  search.set("Default Step", backtrack.first);
  search.set("Minimum Step", backtrack.smallest);
  search.set("Recovery Step", backtrack.recovery);
  search.set("Max Iters", backtrack.evaluations);
  search.set("Reduction Factor", backtrack.reduction);
  return list;
}

NewtonReport newton_solve(NonlinearProblem& problem, const NewtonOptions& options, Vector& x) {
  NewtonReport report;
  auto shared = std::make_shared<NoxGroup::Shared>();
  shared->problem = &problem;
  const RCP<NoxGroup> group = rcp(new NoxGroup(shared, x));
  const RCP<FieldTest> test = rcp(new FieldTest(problem, report, options));
  const RCP<Teuchos::ParameterList> list = rcp(new Teuchos::ParameterList("NOX"));
  list->set("Nonlinear Solver", "Line Search Based");
  // The tangents are consistent, so full steps converge fastest; contact and yielding raise the residual in between,
  // where a line search would take tiny steps (measured on the cone deck: no rejected step against 4 % with
  // backtracking).
  if (options.guarded) {
    const RCP<NOX::LineSearch::UserDefinedFactory> guarded =
        rcp(new GuardedStep::Factory(options.largest_growth, options.halvings));
    list->sublist("Line Search").set("Method", "User Defined").set("User Defined Line Search Factory", guarded);
  } else {
    list->sublist("Line Search") = options.nox.line_search.list();
  }
  list->sublist("Printing").set("Output Information", 0);
  // NOX reports a failed evaluation at any print level; the step's own message says more
  static const RCP<std::ostream> nowhere = rcp(new Teuchos::oblackholestream);
  list->sublist("Printing").set("Output Stream", nowhere);
  list->sublist("Printing").set("Error Stream", nowhere);
  list->sublist("Direction").sublist("Newton").set("Rescue Bad Newton Solve", false);
  try {
    const auto solver = NOX::Solver::buildSolver(group, test, list);
    solver->solve();
    Tpetra::deep_copy(x, NoxVector::of(solver->getSolutionGroup().getX()));
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    // NOX throws where a direction or line search cannot go on; for the step this is a failure like any other.
    report.converged = false;
    if (report.reason.empty()) report.reason = "the linear solver or line search failed";
    log::detail(std::string("nox: ") + error.what());
  } catch (const char* error) {
    report.converged = false;
    if (report.reason.empty()) report.reason = "the linear solver or line search failed";
    log::detail(std::string("nox: ") + error);
  }
  report.evaluations = shared->evaluations;
  return report;
}

}  // namespace mudline
