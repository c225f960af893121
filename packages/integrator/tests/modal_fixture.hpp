#pragma once

#include <Tpetra_Core.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "algebra/mumps_solver.hpp"
#include "integrator/consistent_rates.hpp"
#include "integrator/stepper.hpp"
#include "integrator/time_error.hpp"

namespace mudline::testing {

/// m d2u + c du + k u - l p = load(t), l du + s dp + h p = source(t), d is the time derivative. The equations are
/// coupled as in soil: spring forces at n+1 are a history term, the other terms are evaluated at the integrator's
/// levels.
struct Mode {
  double m = 1, c = 0, k = 1, l = 0, s = 0, h = 0;
  std::function<double(double)> load = [](double) { return 0.0; }, source = [](double) { return 0.0; };
  double tangent = 0;  // stiffness used in the Jacobian instead of k; 0: k
};

/// The term k u - l p at n+1.
class Spring : public Term, public History {
 public:
  Spring(const Space& space, Mode& mode)
      : mode_(mode), dofs_(space.element_dofs(0, fields(space))), coupled_(space.num_fields() > 1) {}
  static std::vector<int> fields(const Space& space) {
    return space.num_fields() > 1 ? std::vector<int>{0, 1} : std::vector<int>{0};
  }
  std::string name() const override { return "spring"; }
  void sparsity(Assembler& assembler) override { group_ = assembler.add_group(dofs_); }
  int residual(const StepView& view, const ResidualView& f) override {
    ++evaluations;
    for (int i = 0; i < 3; ++i) {
      const int u = dofs_(0, i), p = dofs_(0, 3 * coupled_ + i);
      f.add(u, mode_.k * view.value_end(u), mode_.k * (view.value_end(u) - view.value_old(u)));
      if (coupled_) f.add(u, -mode_.l * view.value_end(p), mode_.l * (view.value_old(p) - view.value_end(p)));
    }
    return 0;
  }
  void jacobian(const StepView& view, Assembler& assembler, double weight) override {
    const MatrixScatter to = assembler.scatter(group_);
    for (int i = 0; i < 3; ++i) {
      to.add(0, i, i, weight * (mode_.tangent > 0 ? mode_.tangent : mode_.k));
      if (coupled_) to.add(0, i, 3 + i, -weight * mode_.l);
    }
  }
  int evaluations = 0;

 private:
  Mode& mode_;
  ElementDofs dofs_;
  bool coupled_;
  int group_ = -1;
};

/// Mass, damper and load at the momentum level; the balance of p at the balance level.
class Rest : public Term {
 public:
  Rest(const Space& space, Mode& mode)
      : mode_(mode), dofs_(space.element_dofs(0, Spring::fields(space))), coupled_(space.num_fields() > 1) {}
  std::string name() const override { return "mass, damper, load"; }
  void sparsity(Assembler& assembler) override { group_ = assembler.add_group(dofs_); }
  int residual(const StepView& view, const ResidualView& f) override {
    for (int i = 0; i < 3; ++i) {
      const int u = dofs_(0, i);
      if (view.inertia) f.add(u, mode_.m * view.acceleration(u));
      f.add(u, mode_.c * view.velocity(u));
      const double load = mode_.load(view.momentum.time);
      f.add(u, -load, mode_.load(view.time_old) - load);
      if (!coupled_) continue;
      const int p = dofs_(0, 3 + i);
      for (const double part :
           {mode_.l * view.rate(u), mode_.s * view.rate(p), mode_.h * view.value(p), -mode_.source(view.balance.time)})
        f.add(p, part);
    }
    return 0;
  }
  void jacobian(const StepView& view, Assembler& assembler, double weight) override {
    const MatrixScatter to = assembler.scatter(group_);
    const Sensitivity& u = view.sensitivity[0];
    for (int i = 0; i < 3; ++i) {
      to.add(0, i, i, weight * ((view.inertia ? mode_.m * u.acceleration : 0.0) + mode_.c * u.velocity));
      if (!coupled_) continue;
      const Sensitivity& p = view.sensitivity[1];
      to.add(0, 3 + i, i, weight * mode_.l * u.rate);
      to.add(0, 3 + i, 3 + i, weight * (mode_.s * p.rate + mode_.h * p.value));
    }
  }

 private:
  Mode& mode_;
  ElementDofs dofs_;
  bool coupled_;
  int group_ = -1;
};

/// A mesh of one triangle.
inline GlobalMesh triangle() {
  GlobalMesh mesh;
  mesh.coordinates = {{0, 0}, {1, 0}, {0, 1}};
  mesh.blocks = {{"all", CellShape::tri3, {0, 1, 2}}};
  return mesh;
}

/// One mode on each node of a triangle, solved by the actual system of a step and linear solver.
class ModalSystem {
 public:
  explicit ModalSystem(bool coupled, const Mode& what)
      : mode(what),
        mesh_(Tpetra::getDefaultComm(), Geometry::plane_strain, triangle()),
        space_(mesh_, fields(coupled)),
        store_(space_),
        spring_(space_, mode),
        rest_(space_, mode) {
    if (!solver_.prepare(space_.dofs()).empty()) throw std::runtime_error("the solver refuses the modal system");
    system_ = std::make_unique<StepSystem>(space_, store_, std::vector<Term*>{&spring_, &rest_}, solver_,
                                           [](const StepView&) { return BlockData(); });
  }
  /// Sets the initial values; accelerations and rates of p follow from the equations.
  void start(double u, double v, double p = 0) {
    State& state = store_.committed();
    state.time = 0;
    for (int i = 0; i < 3; ++i) set(i, u, v, 0, p, 0);
    ASSERT_TRUE(give_consistent_rates(*system_, request(1, TimeScheme()), 1e-10));
    ASSERT_TRUE(system_->refresh_history());
  }
  void start_raw(double u, double v, double a) {
    store_.committed().time = 0;
    for (int i = 0; i < 3; ++i) set(i, u, v, a, 0, 0);
    ASSERT_TRUE(system_->refresh_history());
  }
  /// Options with the committed state as first guess, from which a linear problem takes one iteration at any step size.
  static NewtonOptions newton() {
    NewtonOptions options;
    options.first_guess = NewtonOptions::FirstGuess::committed;
    return options;
  }
  void step(double dt, const TimeScheme& scheme) {
    const StepReport report = Stepper(*system_).attempt(request(dt, scheme), StepTolerances(), newton());
    ASSERT_TRUE(report.converged) << report.reason;
    ASSERT_LE(report.newton_iterations, 1) << "the problem is linear";
    store_.accept();
  }
  /// Does a step and returns its time errors of displacement and pressure over `tolerance`; norms over the three nodes.
  static constexpr double tolerance = 1e-12;
  std::array<LocalError, 2> measured_step(double dt, double dt_old, int index, const TimeScheme& scheme) {
    const StepReport report = Stepper(*system_).attempt(request(dt, scheme), StepTolerances(), newton());
    EXPECT_TRUE(report.converged) << report.reason;
    const TimeError error(space_);
    const std::array<LocalError, 2> result{error.measure(system_->view(), scheme, dt_old, index, {1, 0}, tolerance),
                                           error.measure(system_->view(), scheme, dt_old, index, {0, 1}, tolerance)};
    store_.accept();
    return result;
  }
  StateStore& store() { return store_; }
  /// A step that need not take any iteration.
  StepReport attempt(double dt, const TimeScheme& scheme, const NewtonOptions& options = newton()) {
    return Stepper(*system_).attempt(request(dt, scheme), StepTolerances(), options);
  }
  int evaluations() const { return spring_.evaluations; }
  void run(double duration, int steps, const TimeScheme& scheme) {
    for (int i = 0; i < steps; ++i) step(duration / steps, scheme);
  }
  double u(int node = 0) const { return store_.committed().value(dof(0, node)); }
  double v(int node = 0) const { return store_.committed().rate(dof(0, node)); }
  double a(int node = 0) const { return store_.committed().acceleration(dof(0, node)); }
  double p(int node = 0) const { return store_.committed().value(dof(1, node)); }
  double p_rate(int node = 0) const { return store_.committed().rate(dof(1, node)); }
  Mode mode;

 private:
  static std::vector<Field> fields(bool coupled) {
    std::vector<Field> fields{{"modal displacement", "m", "N", 1, Support::all_nodes, 2}};
    if (coupled) fields.push_back({"modal pressure", "Pa", "m3/s", 1, Support::all_nodes, 1});
    return fields;
  }
  StepRequest request(double dt, const TimeScheme& scheme) const {
    return {dt, scheme, [](double, double, const State&, Constraints&) {}};
  }
  int dof(int field, int node) const { return space_.node_dof(field)(node); }
  void set(int node, double u, double v, double a, double p, double p_rate) {
    State& state = store_.committed();
    state.value(dof(0, node)) = u;
    state.rate(dof(0, node)) = v;
    state.acceleration(dof(0, node)) = a;
    if (space_.num_fields() == 1) return;
    state.value(dof(1, node)) = p;
    state.rate(dof(1, node)) = p_rate;
  }
  Mesh mesh_;
  Space space_;
  StateStore store_;
  Spring spring_;
  Rest rest_;
  MumpsSolver solver_;
  std::unique_ptr<StepSystem> system_;
};

}  // namespace mudline::testing
