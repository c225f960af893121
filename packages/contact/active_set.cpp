#include "contact/active_set.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/log.hpp"

namespace mudline {

namespace column {
enum : int { member, changes, in_tension, penetrating, held };
}

void ActiveSetParameters::parameters(Parameters& p) {
  p.choice("active set", loop, {{"in newton", ActiveSetLoop::in_newton}, {"outer loop", ActiveSetLoop::outer}},
           "in newton: whether a point presses follows from its gap in every evaluation; outer loop: the set of "
           "pressing points is fixed while "
           "Newton's method solves the step, then points in tension leave and points that penetrate enter, and the "
           "step is solved again");
  p.add("most active set changes", most_changes, "-", closed(1, 100),
        "Outer loop: a point that has entered or left so often in a step keeps the state in which it violates its "
        "condition less");
  p.add("most active set updates", most_updates, "-", closed(1, 1000),
        "Outer loop: sets tried in a step after the first; where none stays, the step is cut");
}

void ActiveSetParameters::check(const Section& section) const {
  if (outer()) return;
  for (const char* entry : {"most active set changes", "most active set updates"})
    if (section.has_parameter(entry))
      section.fail("has a meaning only with 'active set' = outer loop; here it is in newton", entry);
}

void ActiveSet::declare_state(StateStore& store, const std::string& prefix, const std::vector<long long>& ids) {
  ArrayInfo info;
  info.ids = ids;
  info.ids.push_back(-1);  // the number of updates, the same on every rank
  info.name = prefix + "active set";
  info.variables = {
      {"member", 1, "-"}, {"changes", 1, "-"}, {"gap in tension", 1, "m"}, {"penetration", 1, "m"}, {"held", 1, "-"}};
  rows_ = static_cast<int>(ids.size());
  array_ = store.declare(std::move(info), rows_ + 1);
}

void ActiveSet::start(const State& trial, const std::function<bool(int row)>& presses) const {
  const PointView& rows = trial.arrays[array_];
  Kokkos::deep_copy(rows, 0.0);
  for (int row = 0; row < rows_; ++row) rows(row, column::member) = presses(row) ? 1 : 0;
}

std::optional<Augmentation> ActiveSet::update(const State& trial, const std::string& contact,
                                              const ActiveSetParameters& deck, double gap_tolerance, const Gap& gap_of,
                                              const Comm& comm) const {
  const PointView& rows = trial.arrays[array_];
  const double rounding = 1e-3 * gap_tolerance;  // of gaps that a solve leaves at 0
  int here[4] = {0, 0, 0, 0}, all[4];            // entered, left, held, held beyond the tolerance
  double worst = 0, worst_of_all = 0;
  for (int row = 0; row < rows_; ++row) {
    const bool member = rows(row, column::member) > 0;
    const double gap = gap_of(row), violation = member ? gap : -gap;
    rows(row, member ? column::in_tension : column::penetrating) = std::max(0.0, violation);
    bool changes = violation > rounding && rows(row, column::held) == 0;
    if (changes && rows(row, column::changes) >= deck.most_changes) {
      rows(row, column::held) = 1;
      changes = rows(row, member ? column::penetrating : column::in_tension) < violation;
    }
    if (changes) {
      rows(row, column::member) = member ? 0 : 1;
      rows(row, column::changes) += 1;
      here[member ? 1 : 0] += 1;
    }
    if (rows(row, column::held) == 0) continue;
    here[2] += 1;
    if (changes || violation <= gap_tolerance) continue;
    here[3] += 1;
    worst = std::max(worst, violation);
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 4, here, all);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, worst, Teuchos::outArg(worst_of_all));
  const bool stays = all[0] + all[1] == 0;
  if (stays && all[2] == 0) return std::nullopt;
  char text[300];
  const int updates = static_cast<int>(rows(rows_, 0)) + (stays ? 0 : 1);
  rows(rows_, 0) = updates;
  std::snprintf(text, sizeof text,
                "    contact/%s: active set update %d: %d enter, %d leave, %d held by the chatter guard",
                contact.c_str(), updates, all[0], all[1], all[2]);
  log::detail(text);
  if (stays && all[3] == 0) return std::nullopt;
  if (!stays && updates <= deck.most_updates) return Augmentation{true, ""};
  if (stays)
    std::snprintf(text, sizeof text,
                  "the active set of contact '%s' chatters: %d points that changed more than %d times violate their "
                  "condition by up to %.3g m (gap "
                  "tolerance %.3g m)",
                  contact.c_str(), all[3], deck.most_changes, worst_of_all, gap_tolerance);
  else
    std::snprintf(text, sizeof text, "the active set of contact '%s' does not settle in %d updates", contact.c_str(),
                  deck.most_updates);
  return Augmentation{false, text};
}

}  // namespace mudline
