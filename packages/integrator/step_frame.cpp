#include "integrator/step_frame.hpp"

#include "integrator/overlap.hpp"

namespace mudline {

namespace {

/// Prescribes the unknowns [begin, end) at their present values.
void hold(const Constraints& constraints, const NodalView& values, int begin, int end) {
  const Constraints to = constraints;
  const NodalView from = values;
  Kokkos::parallel_for(
      "hold", Kokkos::RangePolicy<>(begin, end), KOKKOS_LAMBDA(int i) { to.prescribe(i, from(i)); });
}

}  // namespace

StepRequest standing_still(bool inertia) {
  StepRequest request;
  request.dt = 1;  // no rate is evaluated with it
  request.scheme.inertia = inertia;
  request.scheme.flow = inertia;
  request.scheme.incremental = !inertia;
  request.prescribe = [](double, double, const State&, Constraints&) {};
  return request;
}

StepFrame::StepFrame(const Space& space, StateStore& store)
    : space_(space),
      store_(store),
      constraints_(space.dofs()->num_overlap_dofs()),
      outside_("pressure outside", space.dofs()->num_overlap_dofs()),
      levels_(space) {
  view_.constrained = constraints_.mask;
  view_.open = constraints_.open;
  view_.outside = outside_;
  view_.sensitivity.resize(space.num_fields());
}

void StepFrame::prepare(const StepRequest& request, StepView::Kind kind) {
  store_.begin();
  scheme_ = request.scheme;
  const State& old = store_.committed();
  State& trial = store_.trial();
  const double passing = kind == StepView::Kind::step ? request.dt : 0.0;
  trial.time = old.time + passing;
  view_.kind = kind;
  view_.time_old = old.time;
  view_.time_end = trial.time;
  view_.dt = request.dt;
  view_.increment = old.increment;
  view_.value_old = old.value;
  view_.value_end = trial.value;
  const double conjugate = 1 + (scheme_.lead() * scheme_.gamma - scheme_.bend()) / scheme_.beta;
  view_.impact = {{}, {}, conjugate, scheme_.damping(), scheme_.lead() * request.dt};
  view_.x_old = old.coordinates;
  view_.x_end = trial.coordinates;
  const double momentum = view_.end_weight = 1 - scheme_.alpha_f;
  // A balance over the whole step sees the midpoint geometry, on which div(Delta u) is the volume change to second
  // order.
  const double balance = scheme_.incremental ? 0.5 : momentum;
  const double balance_time = scheme_.incremental ? scheme_.theta : momentum;
  view_.momentum = {old.time + momentum * passing, {}, momentum};
  view_.balance = {old.time + balance_time * passing, {}, balance};
  levels_.show(view_);
  view_.inertia = scheme_.inertia;
  view_.flow = scheme_.flow;
  view_.linearisation = 0;
  view_.elastic_share = 0;
  view_.committed = &old;
  view_.trial = &trial;
  set_sensitivities();
}

void StepFrame::set_sensitivities() {
  const double dt = view_.dt, af = scheme_.alpha_f;
  for (int f = 0; f < space_.num_fields(); ++f) {
    Sensitivity& s = view_.sensitivity[f];
    if (space_.field(f).time_order == 2) {
      s.value = 1 - af;
      s.velocity = scheme_.inertia ? (1 - af) * scheme_.gamma / (scheme_.beta * dt) : 1 / dt;
      s.rate = scheme_.incremental ? 1 / dt : s.velocity;
      s.acceleration = scheme_.inertia ? (1 - scheme_.alpha_m) / (scheme_.beta * dt * dt) : 0.0;
    } else {
      s.value = scheme_.incremental ? scheme_.theta : scheme_.flow_alpha_f;
      s.rate = scheme_.incremental ? 1 / dt : scheme_.flow_alpha_m / (scheme_.theta * dt);
      s.velocity = s.rate;
      s.acceleration = 0;
    }
  }
}

void StepFrame::constrain(const StepRequest& request) {
  Kokkos::deep_copy(constraints_.mask, char(0));
  Kokkos::deep_copy(constraints_.moves, char(0));
  Kokkos::deep_copy(constraints_.open, char(0));
  Kokkos::deep_copy(constraints_.value, store_.committed().value);
  request.prescribe(view_.time_old, view_.time_end, store_.committed(), constraints_);
  if (!scheme_.flow)  // geostatic: fields of first order stay as they are
    for (int f = 0; f < space_.num_fields(); ++f)
      if (space_.field(f).time_order == 1)
        for (const auto& [begin, end] : overlap_ranges(*space_.dofs(), f))
          hold(constraints_, store_.committed().value, begin, end);
  find_outside(request);
}

void StepFrame::find_outside(const StepRequest& request) {
  int open = 0;
  for (std::size_t i = 0; i < outside_.extent(0); ++i) {
    if (constraints_.mask(i)) constraints_.open(i) = 0;
    open += constraints_.open(i);
    outside_(i) = constraints_.value(i);
  }
  const double weight = scheme_.incremental ? scheme_.theta : scheme_.flow_alpha_f;  // of the end at the balance level
  if (weight == 1 || sum_over_ranks(*space_.dofs()->comm(), open) == 0) return;
  Constraints before(static_cast<int>(outside_.extent(0)));
  request.prescribe(view_.time_old, view_.time_old, store_.committed(), before);
  for (std::size_t i = 0; i < outside_.extent(0); ++i)
    if (constraints_.open(i) && before.open(i)) outside_(i) += (1 - weight) * (before.value(i) - constraints_.value(i));
}

Vector StepFrame::start() const {
  Vector x(space_.dofs()->owned());
  const auto data = entries(x, Tpetra::Access::OverwriteAll);
  const Constraints given = constraints_;
  const NodalView otherwise = store_.committed().value;
  Kokkos::parallel_for(
      "start values", Kokkos::RangePolicy<>(0, data.extent(0)),
      KOKKOS_LAMBDA(int i) { data(i) = given.mask(i) ? given.value(i) : otherwise(i); });
  return x;
}

void StepFrame::move_to(const Vector& x) {
  const State& old = store_.committed();
  const State& trial = store_.trial();
  import_owned(*space_.dofs(), x, trial.value);
  levels_.of_step(scheme_, view_, old, trial);
  if (view_.kind == StepView::Kind::step) levels_.given_rates(constraints_, scheme_, view_.dt, old, trial);
}

void StepFrame::rest() {
  levels_.at_rest(store_.committed(), store_.trial());
  for (int f = 0; f < space_.num_fields(); ++f) {
    const bool second = space_.field(f).time_order == 2;
    view_.sensitivity[f] = {0, second ? 0.0 : 1.0, 0, second ? 1.0 : 0.0};
  }
  view_.momentum.geometry_weight = view_.balance.geometry_weight = 0;
}

std::vector<double> StepFrame::matrix_key() const {
  const TimeScheme& t = scheme_;
  std::vector<double> key{view_.dt, t.inertia ? 1.0 : 0.0,     t.flow ? 1.0 : 0.0, t.alpha_m,      t.alpha_f, t.beta,
                          t.gamma,  t.incremental ? 1.0 : 0.0, t.flow_alpha_m,     t.flow_alpha_f, t.theta};
  key.insert(key.end(), constraints_.mask.data(), constraints_.mask.data() + constraints_.mask.extent(0));
  key.insert(key.end(), constraints_.open.data(), constraints_.open.data() + constraints_.open.extent(0));
  return key;
}

}  // namespace mudline
