#include "integrator/levels.hpp"

#include "integrator/overlap.hpp"

namespace mudline {

namespace {

/// Computes the levels of one unknown from its change over the step.
struct LevelOfDof {
  enum class Order { second, second_at_mean_rate, first, first_over_step };
  Order order;
  TimeScheme t;
  double dt, lead, bend;
  NodalView value_old, rate_old, acceleration_old;  // committed
  NodalView value_end, rate_end, acceleration_end;  // trial
  NodalView value, rate, velocity, acceleration, ahead_old, ahead_end;

  KOKKOS_FUNCTION void operator()(int i) const {
    const double change = value_end(i) - value_old(i), mean = change / dt;
    switch (order) {
      case Order::second:
        newmark(i, change, mean);
        break;
      case Order::second_at_mean_rate:
        rate_end(i) = velocity(i) = rate(i) = t.flow ? mean : 0.0;
        acceleration_end(i) = acceleration(i) = ahead_old(i) = ahead_end(i) = 0;
        value(i) = value_end(i);
        break;
      case Order::first_over_step:
        rate_end(i) = rate(i) = velocity(i) = t.flow ? mean : 0.0;
        value(i) = value_old(i) + t.theta * change;
        break;
      case Order::first:
        rate_end(i) = mean / t.theta - (1 - t.theta) / t.theta * rate_old(i);
        rate(i) = velocity(i) = rate_old(i) + t.flow_alpha_m * (rate_end(i) - rate_old(i));
        value(i) = value_old(i) + t.flow_alpha_f * change;
        break;
    }
  }
  KOKKOS_FUNCTION void newmark(int i, double change, double mean) const {
    acceleration_end(i) = (mean - rate_old(i)) / (t.beta * dt) - (0.5 / t.beta - 1) * acceleration_old(i);
    rate_end(i) = rate_old(i) + dt * ((1 - t.gamma) * acceleration_old(i) + t.gamma * acceleration_end(i));
    acceleration(i) = (1 - t.alpha_m) * acceleration_end(i) + t.alpha_m * acceleration_old(i);
    velocity(i) = (1 - t.alpha_f) * rate_end(i) + t.alpha_f * rate_old(i);
    value(i) = value_old(i) + (1 - t.alpha_f) * change;
    rate(i) = t.incremental ? mean : velocity(i);
    ahead_old(i) = lead * rate_old(i) - bend * acceleration_old(i);
    ahead_end(i) = lead * rate_end(i) - bend * acceleration_end(i);
  }
};

LevelOfDof::Order order_of(const Field& field, const TimeScheme& scheme) {
  if (field.time_order == 2) return scheme.inertia ? LevelOfDof::Order::second : LevelOfDof::Order::second_at_mean_rate;
  return scheme.incremental ? LevelOfDof::Order::first_over_step : LevelOfDof::Order::first;
}

/// Coordinates of the nodes at the end of the step and at the levels of momentum and of balances.
struct Configurations {
  Kokkos::View<int*> dof;  // by node: its first displacement; -1: the node does not move
  ConstNodalView value_old, value_end;
  ConstCoordinateView x_old;
  CoordinateView x_end, x_momentum, x_balance;
  double momentum, balance;  // weights of the step's displacement at the levels

  KOKKOS_INLINE_FUNCTION void operator()(int node) const {
    for (std::size_t i = 0; i < x_end.extent(1); ++i) {
      const int at = dof(node);
      const double change = at < 0 ? 0.0 : value_end(at + i) - value_old(at + i);
      x_end(node, i) = x_old(node, i) + change;
      x_momentum(node, i) = x_old(node, i) + momentum * change;
      x_balance(node, i) = x_old(node, i) + balance * change;
    }
  }
};

}  // namespace

Levels::Levels(const Space& space) : space_(space) {
  const int nodes = space.mesh().num_nodes(), dimension = space.mesh().dimension();
  for (NodalView* v : {&value_, &rate_, &velocity_, &acceleration_, &ahead_old_, &ahead_end_})
    *v = NodalView("level", space.dofs()->num_overlap_dofs());
  for (CoordinateView* x : {&x_momentum_, &x_balance_}) *x = CoordinateView("coordinates", nodes, dimension);
}

void Levels::show(StepView& view) const {
  view.value = value_;
  view.rate = rate_;
  view.velocity = velocity_;
  view.acceleration = acceleration_;
  Kokkos::deep_copy(ahead_old_, 0.0);
  Kokkos::deep_copy(ahead_end_, 0.0);
  view.impact.ahead_old = ahead_old_;
  view.impact.ahead_end = ahead_end_;
  view.momentum.x = x_momentum_;
  view.balance.x = x_balance_;
}

void Levels::of_step(const TimeScheme& t, const StepView& view, const State& old, const State& trial) const {
  const double dt = view.dt;
  for (int f = 0; f < space_.num_fields(); ++f) {
    const LevelOfDof level{order_of(space_.field(f), t),
                           t,
                           dt,
                           t.lead() * dt,
                           t.bend() * dt * dt,
                           old.value,
                           old.rate,
                           old.acceleration,
                           trial.value,
                           trial.rate,
                           trial.acceleration,
                           value_,
                           rate_,
                           velocity_,
                           acceleration_,
                           ahead_old_,
                           ahead_end_};
    for (const auto& [begin, end] : overlap_ranges(*space_.dofs(), f))
      Kokkos::parallel_for("levels", Kokkos::RangePolicy<>(begin, end), level);
  }
  configurations(view, old, trial);
}

void Levels::configurations(const StepView& view, const State& old, const State& trial) const {
  const int displacement = space_.find("displacement");
  if (displacement < 0) {
    for (const CoordinateView& x : {trial.coordinates, x_momentum_, x_balance_}) Kokkos::deep_copy(x, old.coordinates);
    return;
  }
  const Configurations at_levels{space_.node_dof(displacement),
                                 old.value,
                                 trial.value,
                                 old.coordinates,
                                 trial.coordinates,
                                 x_momentum_,
                                 x_balance_,
                                 view.momentum.geometry_weight,
                                 view.balance.geometry_weight};
  Kokkos::parallel_for("configurations", Kokkos::RangePolicy<>(0, x_momentum_.extent(0)), at_levels);
}

void Levels::given_rates(const Constraints& constraints, const TimeScheme& scheme, double dt, const State& old,
                         const State& trial) const {
  const bool inertia = scheme.inertia;
  const Constraints given = constraints;
  const NodalView rate_old = old.rate, rate_end = trial.rate, acceleration_end = trial.acceleration;
  const NodalView velocity = velocity_, acceleration = acceleration_;
  Kokkos::parallel_for(
      "given rates", Kokkos::RangePolicy<>(0, given.moves.extent(0)), KOKKOS_LAMBDA(int i) {
        if (!given.moves(i)) return;
        rate_end(i) = velocity(i) = given.rate(i);
        acceleration_end(i) = acceleration(i) = inertia ? (rate_end(i) - rate_old(i)) / dt : 0.0;
      });
}

void Levels::at_rest(const State& old, const State& trial) const {
  for (const NodalView& v : {trial.value, value_}) Kokkos::deep_copy(v, old.value);
  for (const NodalView& v : {rate_, velocity_}) Kokkos::deep_copy(v, old.rate);
  Kokkos::deep_copy(acceleration_, 0.0);
  for (int f = 0; f < space_.num_fields(); ++f)
    if (space_.field(f).time_order != 2)
      for (const auto& range : overlap_ranges(*space_.dofs(), f))
        for (const NodalView& v : {rate_, velocity_}) Kokkos::deep_copy(Kokkos::subview(v, range), 0.0);
  for (const CoordinateView& x : {trial.coordinates, x_momentum_, x_balance_}) Kokkos::deep_copy(x, old.coordinates);
}

}  // namespace mudline
