// Newton's method on one unknown: the guarded step, and the line searches of NOX, read from a deck.
#include <gtest/gtest.h>
#include <Tpetra_Core.hpp>

#include <cmath>

#include "core/deck.hpp"
#include "core/tests/input_error.hpp"
#include "integrator/newton.hpp"

namespace mudline {
namespace {

/// F(x) = 0 on rank 0; F may be NaN where it cannot be evaluated.
class Scalar : public NonlinearProblem {
 public:
  Scalar(double (*f)(double), double (*slope)(double))
      : map_(Teuchos::rcp(new Map(1, 1, 0, Tpetra::getDefaultComm()))), f_(f), slope_(slope) {}
  RCP<const Map> map() const override { return map_; }
  bool residual(const Vector& x, Vector& f) override {
    visited.push_back(value(x));
    f.putScalar(f_(value(x)));
    return std::isfinite(value(f));
  }
  bool jacobian(const Vector& x) override {
    tangent_ = slope_(value(x));
    return true;
  }
  void apply_jacobian(const Vector& v, Vector& jv) override { jv.update(tangent_, v, 0.0); }
  bool solve(const Vector& f, Vector& dx) override {
    dx.update(1 / tangent_, f, 0.0);
    return true;
  }
  std::vector<double> residual_ratios(const Vector& f) override { return {std::abs(value(f)) / 1e-6}; }
  std::vector<double> update_ratios(const Vector& dx, const Vector&) override { return {std::abs(value(dx)) / 1e-3}; }
  static double value(const Vector& x) { return x.getData()[0]; }

  std::vector<double> visited;

 private:
  RCP<const Map> map_;
  double (*f_)(double);
  double (*slope_)(double);
  double tangent_ = 0;
};

NewtonOptions read(const std::string& body) {
  Deck deck;
  deck.overlay("<ParameterList>" + body + "</ParameterList>", "deck.xml");
  Parameters p(deck.root());
  NewtonOptions options;
  options.parameters(p);
  p.finish();
  return options;
}

std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}

std::string nox(const std::string& body) {
  return "<ParameterList name=\"nox\"><ParameterList name=\"Line Search\">" + body + "</ParameterList></ParameterList>";
}

std::string list(const std::string& name, const std::string& body) {
  return "<ParameterList name=\"" + name + "\">" + body + "</ParameterList>";
}

NewtonReport solve(Scalar& problem, const std::string& options, double start) {
  Vector x(problem.map());
  x.putScalar(start);
  return newton_solve(problem, read(options), x);
}

double logarithm(double x) { return x > 0 ? std::log(x) : std::nan(""); }
double inverse(double x) { return 1 / x; }
double arctangent(double x) { return std::atan(x); }
double arctangent_slope(double x) { return 1 / (1 + x * x); }
double itself(double x) { return x; }
double one(double) { return 1; }

/// Its residual is below the tolerance from the start, but its updates never get small.
class Restless : public Scalar {
 public:
  explicit Restless(bool at_rounding) : Scalar(itself, one), at_rounding_(at_rounding) {}
  std::vector<double> residual_ratios(const Vector&) override { return {0.5}; }
  std::vector<double> update_ratios(const Vector&, const Vector&) override { return {1e3}; }
  bool at_rounding() const override { return at_rounding_; }

 private:
  bool at_rounding_;
};

TEST(Newton, UpdatesMeanNothingWhereTheResidualIsRounding) {
  Restless busy(false), resting(true);
  EXPECT_FALSE(solve(busy, "", 3).converged);
  EXPECT_TRUE(solve(resting, "", 3).converged);
}

TEST(Newton, HalvesAStepWhoseResidualCannotBeEvaluated) {
  // the first step from 3 goes to 3 - 3 ln 3 < 0, half of it to 1.35
  Scalar problem(logarithm, inverse);
  EXPECT_TRUE(solve(problem, "", 3).converged);
  EXPECT_LT(problem.visited[1], 0);
  EXPECT_NEAR(problem.visited[2], 3 - 1.5 * std::log(3.0), 1e-12);
  Scalar again(logarithm, inverse);
  EXPECT_FALSE(solve(again, parameter("halvings", "int", "0"), 3).converged);
  EXPECT_EQ(again.visited.size(), 2u);
}

double growth(double x) { return std::exp(x) - 1; }
double growth_slope(double x) { return std::exp(x); }
double root(double x) { return std::copysign(std::sqrt(std::abs(x)), x); }
double root_slope(double x) { return 0.5 / std::sqrt(std::abs(x)); }

double jump(double x) { return x > 0 ? 1 : -1; }
double half(double) { return 0.5; }

TEST(Newton, HalfAStepLeadsBetweenTwoStates) {
  // full steps alternate between x and -x
  Scalar problem(root, root_slope);
  const NewtonReport report = solve(problem, "", 3);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_EQ(report.iterations, 3);
  EXPECT_NEAR(problem.visited.back(), 0, 1e-15);
}

/// A spring: the work of its force is known.
class Spring : public Scalar {
 public:
  using Scalar::Scalar;
  double work(const Vector& f, const Vector& dx) override { return value(f) * value(dx); }
};

TEST(Newton, AStepEndsWhereNoWorkIsDone) {
  // full steps from 1.4 go farther each time; after four of them a secant finds the way back
  Spring problem(arctangent, arctangent_slope);
  const NewtonReport report = solve(problem, "", 1.4);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_NEAR(problem.visited[4], 1.8471, 1e-4);
  EXPECT_LT(std::abs(problem.visited.back()), 1e-6);
  Scalar unknown(arctangent, arctangent_slope);
  EXPECT_FALSE(solve(unknown, parameter("damped retry", "bool", "false"), 1.4).converged);
}

TEST(Newton, WhatGoesToAndFroIsGivenUp) {
  // the state between the two is not better
  Scalar problem(jump, half);
  const NewtonReport report = solve(problem, "", 3);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 3);
  EXPECT_EQ(report.reason.find("the iterates go to and fro"), 0u) << report.reason;
  // without a damped retry all iterations are used
  for (const std::string& alone :
       {parameter("damped retry", "bool", "false"), parameter("largest growth", "double", "1.2")}) {
    Scalar again(jump, half);
    EXPECT_EQ(solve(again, alone, 3).iterations, 15) << alone;
  }
}

TEST(Newton, IsTriedAgainInOtherWays) {
  const NewtonOptions usual = read("");
  const std::vector<NewtonOptions> ways = usual.ways(),
                                   of_damped = read(parameter("largest growth", "double", "1.5")).ways();
  ASSERT_EQ(ways.size(), 3u);
  ASSERT_EQ(of_damped.size(), 3u);
  const double growths[] = {0, 1.2, 0}, growths_of_damped[] = {1.5, 0, 0};
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(ways[k].largest_growth, growths[k]);
    EXPECT_EQ(of_damped[k].largest_growth, growths_of_damped[k]);
    EXPECT_EQ(ways[k].elastic_share, k == 2);
    EXPECT_EQ(ways[k].guess_on_trial, k == 0);
  }
  EXPECT_EQ(read(nox("")).ways().size(), 1u);
  EXPECT_EQ(read(parameter("damped retry", "bool", "false")).ways().size(), 1u);
  // the first full step goes from -4 to 50, and fifty more iterations are needed to return
  Scalar full(growth, growth_slope), damped(growth, growth_slope);
  Vector x(full.map());
  x.putScalar(-4);
  EXPECT_FALSE(newton_solve(full, usual, x).converged);
  x.putScalar(-4);
  EXPECT_TRUE(newton_solve(damped, ways[1], x).converged);
}

TEST(Newton, FullStepOfNoxTakesItsShare) {
  Scalar problem(itself, one);
  const auto report = solve(
      problem,
      nox(parameter("Method", "string", "Full Step") + list("Full Step", parameter("Full Step", "double", "0.25"))) +
          parameter("maximum iterations", "int", "3"),
      1);
  EXPECT_FALSE(report.converged);
  ASSERT_EQ(report.history.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(report.history[i][0], 1e6 * std::pow(0.75, i), 1e-3);
}

TEST(Newton, BacktrackOfNoxShortensTheStep) {
  Scalar full(arctangent, arctangent_slope);
  EXPECT_FALSE(solve(full, nox(parameter("Method", "string", "Full Step")), 3).converged);  // the iteration diverges
  Scalar searched(arctangent, arctangent_slope);
  const std::string method = parameter("Method", "string", "Backtrack");
  EXPECT_TRUE(
      solve(searched, nox(method + list("Backtrack", parameter("Reduction Factor", "double", "0.25"))), 3).converged);
  const double step = -10 * std::atan(3.0);
  EXPECT_NEAR(searched.visited[1], 3 + step, 1e-12);
  EXPECT_NEAR(searched.visited[2], 3 + 0.25 * step, 1e-12);
}

TEST(Newton, BacktrackOfNoxFailsAsTheDeckSays) {
  Scalar problem(arctangent, arctangent_slope);
  const auto report = solve(
      problem,
      nox(parameter("Method", "string", "Backtrack") +
          list("Backtrack", parameter("Default Step", "double", "0.9") + parameter("Minimum Step", "double", "0.8") +
                                parameter("Max Iters", "int", "7") + parameter("Recovery Step", "double", "0.1"))),
      3);
  // 0.45 of the step is below the smallest: the recovery step is taken, and ends the solve
  const double step = -10 * std::atan(3.0);
  EXPECT_NEAR(problem.visited[1], 3 + 0.9 * step, 1e-12);
  EXPECT_NEAR(problem.visited[2], 3 + 0.1 * step, 1e-12);
  EXPECT_GE(report.evaluations, 3);
}

TEST(Newton, WhatDoesNotFitNoxIsRefused) {
  EXPECT_EQ(input_error([] { read(nox(parameter("Method", "string", "More'-Thuente"))); }),
            "deck.xml:1: nox/Line Search/Method: 'More'-Thuente' is not a choice; allowed: Full Step, Backtrack");
  EXPECT_EQ(input_error([] { read(nox(list("Backtrack", ""))); }),
            "deck.xml:1: nox/Line Search/Backtrack: has no effect with another 'Method'");
  EXPECT_EQ(input_error([] { read(nox("") + parameter("largest growth", "double", "1.2")); }),
            "deck.xml:1: largest growth: has no effect beside a line search of NOX (section 'nox')");
  EXPECT_EQ(input_error([] { read(nox("") + parameter("damped retry", "bool", "true")); }),
            "deck.xml:1: damped retry: has no effect beside a line search of NOX (section 'nox')");
}

}  // namespace
}  // namespace mudline
