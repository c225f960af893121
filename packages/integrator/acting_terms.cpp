#include "integrator/acting_terms.hpp"

#include <KokkosBlas1_axpby.hpp>
#include <KokkosBlas1_update.hpp>

#include <algorithm>

#include "core/errors.hpp"
#include "core/foreign_library.hpp"
#include "core/guarded.hpp"
#include "discretisation/agree.hpp"

namespace mudline {

namespace {

bool finite(const NodalView& values) {
  double sum = 0;  // NaN where one is not finite
  Kokkos::parallel_reduce(
      "finite", Kokkos::RangePolicy<>(0, values.extent(0)),
      KOKKOS_LAMBDA(int i, double& part) { part += 0.0 * values(i); }, sum);
  return sum == 0.0;
}

/// What is exchanged at the boundary with an open unknown passes through it.
void pass_on(const Kokkos::View<const char*>& open, const NodalView& force, const NodalView& total,
             const NodalView& passing) {
  Kokkos::parallel_for(
      "pass on", Kokkos::RangePolicy<>(0, total.extent(0)), KOKKOS_LAMBDA(int i) {
        if (!open(i)) return;
        total(i) -= force(i);
        passing(i) += force(i);
      });
}

}  // namespace

ActingTerms::ActingTerms(const Space& space, StateStore& store, std::vector<Term*> terms)
    : space_(space), store_(store), terms_(std::move(terms)), assembler_(space.dofs()) {
  int slots = 0;
  for (Term* term : terms_) {
    term->declare_state(store_);
    term->sparsity(assembler_);
    history_slot_.push_back(face<History>(*term) ? slots++ : -1);
  }
  history_ = faces<History>(terms_);
  store_.allocate_history(slots);
  assembler_.finalise();
  for (NodalView* v : {&reaction_, &total_, &acting_, &whole_, &passing_})
    *v = NodalView("sum of forces", space.dofs()->num_overlap_dofs());
  activate(terms_);
}

void ActingTerms::activate(const std::vector<Term*>& active) {
  active_ = active;
  unilateral_ = faces<Unilateral>(active_);
  foresees_ = faces<Foresees>(active_);
  reports_ = faces<Reports>(active_);
  force_.clear();
  for (std::size_t k = 0; k < active_.size(); ++k) force_.emplace_back("term force", total_.extent(0));
}

int ActingTerms::history_slot(int k) const {
  return history_slot_[std::find(terms_.begin(), terms_.end(), active_[k]) - terms_.begin()];
}

void ActingTerms::begin(const StepView& view) {
  for (Term* term : active_) term->begin(view);
}

int ActingTerms::evaluate_term(Term& term, const StepView& view, const NodalView& force, const ResidualView& to) {
  std::string problem;
  int failed = 0;
  const OpenDescriptors before;
  try {
    failed = term.residual(view, to);
    check_foreign_code(&before);  // before the ranks wait for each other, by files that may be gone
    if (failed == 0 && !finite(force)) problem = ", which gives a force or flux that is not finite";
  } catch (const InputError& error) {
    problem = std::string(": ") + error.what();  // a number of the deck that is wrong at this time
  } catch (...) {
    problem = ", which throws: " + fault_thrown();
  }
  if (!problem.empty()) failed = 1;
  if (failed > 0 && failure_.empty()) failure_ = term.name() + problem;
  return failed;
}

int ActingTerms::evaluate(const StepView& view, double start_weight) {
  for (const NodalView& sizes : {total_, acting_, whole_, passing_}) Kokkos::deep_copy(sizes, 0.0);
  int failures = 0;
  failure_.clear();
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const NodalView force = force_[k];
    Kokkos::deep_copy(force, 0.0);
    const ResidualView to(force, acting_, whole_, passing_);
    failures += evaluate_term(*active_[k], view, force, to);
    const int slot = history_slot(static_cast<int>(k));
    if (slot >= 0) {
      const NodalView now = store_.trial().history_forces[slot], old = store_.committed().history_forces[slot];
      Kokkos::deep_copy(now, force);
      KokkosBlas::update(view.end_weight, now, start_weight, old, 0.0, force);
      history_[slot]->correction(view, to);
    }
    KokkosBlas::axpy(1.0, force, total_);
    if (exchanges(*active_[k])) pass_on(view.open, force, total_, passing_);
  }
  return failures;
}

void ActingTerms::split_reactions(const StepView& view) {
  const Kokkos::View<const char*> prescribed = view.constrained;
  const NodalView total = total_, reaction = reaction_, passing = passing_;
  Kokkos::parallel_for(
      "reactions", Kokkos::RangePolicy<>(0, total.extent(0)), KOKKOS_LAMBDA(int i) {
        reaction(i) = prescribed(i) ? total(i) : passing(i);
        if (prescribed(i)) total(i) = 0;
      });
}

int ActingTerms::refresh_history(const StepView& view) {
  int failures = 0;
  for (int k = 0; k < static_cast<int>(active_.size()); ++k) {
    const int slot = history_slot(k);
    if (slot < 0) continue;
    active_[k]->begin(view);
    const NodalView force = store_.committed().history_forces[slot];
    Kokkos::deep_copy(force, 0.0);
    failures += active_[k]->residual(view, force);
  }
  return failures;
}

int ActingTerms::complete(const StepView& view) {
  int failures = 0;
  for (std::size_t k = 0; k < active_.size(); ++k)
    if (auto* const term = face<Completes>(*active_[k]))
      failures += term->complete(view, store_.trial().history_forces[history_slot(static_cast<int>(k))]);
  return failures;
}

void ActingTerms::foresee_jacobian(bool likely) {
  for (Foresees* term : foresees_) term->foresee_jacobian(likely);
}

void ActingTerms::forget_foreseen() {
  for (Foresees* term : foresees_) term->forget_foreseen();
}

std::string ActingTerms::add_matrices(const StepView& view) {
  assembler_.begin(view.constrained);
  std::string problem;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    try {
      assembler_.leave_out(exchanges(*active_[k]) ? view.open : Kokkos::View<const char*>());
      active_[k]->jacobian(view, assembler_, history_slot(static_cast<int>(k)) >= 0 ? view.end_weight : 1.0);
    } catch (...) {
      if (problem.empty()) problem = "the Jacobian of " + active_[k]->name() + ": " + fault_thrown();
    }
  }
  assembler_.end();
  return broadcast(*space_.dofs()->comm(), problem);
}

void ActingTerms::add_rate_matrices(const StepView& view) {
  assembler_.begin(view.constrained);
  for (int k = 0; k < static_cast<int>(active_.size()); ++k)
    if (history_slot(k) < 0) active_[k]->jacobian(view, assembler_, 1.0);
  assembler_.end();
}

std::string ActingTerms::hints(const StepView& view) const {
  std::string all;
  for (const Reports* term : reports_)
    if (const std::string hint = term->hint(view); !hint.empty()) all += "; " + hint;
  return all;
}

double ActingTerms::step_limit(double dt) const {
  for (const Unilateral* term : unilateral_) dt = std::min(dt, term->step_limit(store_.committed(), dt));
  return dt;
}

}  // namespace mudline
