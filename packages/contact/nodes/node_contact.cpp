#include "contact/nodes/node_contact.hpp"

#include <algorithm>

#include "contact/two_surfaces.hpp"

namespace mudline {

namespace column = node_column;

void NodeParameters::parameters(Parameters& p) {
  TwoSurfaceParameters::parameters(p);
  p.choice("master surface", drawing,
           {{"hermite", Drawing::hermite},
            {"bezier", Drawing::bezier},
            {"linear", Drawing::linear},
            {"sides", Drawing::sides}},
           "How the master is drawn over its nodes: hermite: smooth (C1) through them; bezier: smooth, from the middle "
           "between two nodes to the "
           "next, with the node as control point; linear: straight from node to node; sides: the elements' own sides, "
           "straight or parabolic");
  declare_corner_angle(p, corner_angle);
  p.add("overhang", overhang, "-", non_negative(),
        "An open end of the master goes on for this fraction of its last piece");
  active_set.parameters(p);
  p.add(
      "two-pass", two_pass,
      "The master's nodes look for the slave too, and each pass has half of the forces; with 'enforcement' = penalty");
  declare_impact(p, impact);
}

void NodeContact::check(const Section& section) {
  const Mesh& mesh = context_.space.mesh();
  check_surfaces(section, 2);
  deck_.check(section, deck_.active_set.outer());
  deck_.active_set.check(section);
  if (deck_.active_set.outer() && section.has_parameter("impact") && deck_.impact == PairImpact::conserving)
    section.fail(
        "conserving is for 'active set' = in newton: a node in tension has no share; allowed with outer loop: "
        "interpolated",
        "impact");
  if (deck_.active_set.outer() && deck_.two_pass)
    section.fail("the two passes would not know of each other's sets; allowed with 'two-pass': in newton",
                 "active set");
  if (deck_.two_pass && deck_.augmented())
    section.fail("two passes have more multipliers than the surfaces have freedom; allowed with 'two-pass': penalty",
                 "enforcement");
  if (deck_.augmented() && section.has_parameter("impact"))
    section.fail("has a meaning only with 'enforcement' = penalty: its shares are those of the penalty spring's energy",
                 "impact");
  if ((deck_.drawing == Drawing::linear || deck_.drawing == Drawing::sides) &&
      section.has_parameter("corner angle [deg]"))
    section.fail("has a meaning only with a smooth 'master surface'; allowed with it: hermite, bezier",
                 "corner angle [deg]");
  read_laws_of_two(context_, section, laws_);
  laws_.check_linear(section, deck_.augmented() || deck_.active_set.outer(), deck_.impact == PairImpact::conserving);
  passes_.push_back(
      std::make_unique<NodePass>(NodePassSettings{&context_, &deck_, &laws_, deck_.two_pass ? 0.5 : 1.0, name() + "/"},
                                 deck_.slave, deck_.master));
  if (deck_.two_pass)
    passes_.push_back(std::make_unique<NodePass>(NodePassSettings{&context_, &deck_, &laws_, 0.5, name() + "/second "},
                                                 deck_.master, deck_.slave));
  const ContactSurface& slave = passes_[0]->slave();
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * slave.shortest(mesh.coordinates());
  check_overlap_of_two(slave, section, deck_.slave,
                       passes_[0]->least_gap(4 * slave.longest(mesh.coordinates()), mesh.coordinates()));
}

void NodeContact::declare_state(StateStore& store) {
  laws_.declare_state(store);
  for (auto& pass : passes_) pass->declare_state(store);
}

void NodeContact::sparsity(Assembler& assembler) {
  for (auto& pass : passes_) pass->sparsity(assembler);
}

void NodeContact::begin(const StepView& view) {
  for (auto& pass : passes_) pass->begin(view);
}

void NodeContact::predicting(bool on) {
  for (auto& pass : passes_) pass->predicting(on);
}

int NodeContact::residual(const StepView& view, const ResidualView& f) {
  int failures = 0;
  for (auto& pass : passes_) failures += pass->residual(view, f);
  beyond_reach_ = failures > 0;
  return failures;
}

void NodeContact::correction(const StepView&, const ResidualView& f) {
  for (auto& pass : passes_) pass->correction(f);
}

void NodeContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  for (auto& pass : passes_) pass->jacobian(view, assembler, weight);
}

Augmentation NodeContact::augment(const StepView& view, int count) {
  const State& trial = *view.trial;
  if (passes_[0]->active_set().used()) {
    if (const auto next = passes_[0]->update_active_set(trial, name_, gap_tolerance_)) return *next;
    count -= passes_[0]->active_set().updates(trial);
  }
  if (!deck_.augmented()) return {};
  const auto end = end_of_augmentation(name_, deck_, gap_tolerance_, passes_[0]->misfit(trial), count,
                                       *context_.space.mesh().comm());
  if (end) return *end;
  passes_[0]->augment(trial);
  return {true, ""};
}

void NodeContact::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  SlaveSums here;
  for (std::size_t k = 0; k < passes_.size(); ++k) {
    const NodePass& pass = *passes_[k];
    const double sign = k == 0 ? 1 : -1;  // the second pass reports what the master gets
    here.force[0] += sign * pass.sum(state, column::force_x);
    here.force[1] += sign * pass.sum(state, column::force_y);
    here.area += pass.sum(state, column::area);
    here.heat += pass.sum(state, column::heat);
    here.damped += pass.damping_heat(state);
    here.deepest = std::max(here.deepest, pass.deepest(state));
  }
  const Comm& comm = *context_.space.mesh().comm();
  const SlaveSums all = report_slave(comm, 2, name(), deck_, here, values);
  if (deck_.augmented()) {
    const auto [gap, stretch, spring] = passes_[0]->misfit(state).largest(comm);
    values[name() + "/weighted gap"] = {"m", gap};
    if (laws_.friction()) values[name() + "/stretch"] = {"m", stretch};
  }
  if (laws_.friction()) values[name() + "/friction heat"] = {"J", all.heat};
}

double NodeContact::step_limit(const State& committed, double) const {
  return closing_limit(context_.space, passes_[0]->slave(), passes_[0]->master(), deck_.advance_limit, committed);
}

void NodeContact::relocate(const ConstCoordinateView& x_old, State& committed) {
  for (auto& pass : passes_) pass->relocate(x_old, committed);
}

void NodeContact::adopt(const State& evaluated, State& committed) {
  for (auto& pass : passes_) pass->adopt(evaluated, committed);
}

std::vector<double> NodeContact::nodal_sum(const State& state, int c) const {
  std::vector<double> result(context_.space.mesh().num_nodes(), 0.0);
  for (const auto& pass : passes_) {
    const std::vector<double> part = pass->nodal_mean(state, c);
    for (std::size_t node = 0; node < part.size(); ++node) result[node] += part[node];
  }
  return result;
}

std::vector<double> NodeContact::nodal_pressure(const State& state) const { return nodal_sum(state, column::pressure); }

std::vector<double> NodeContact::nodal_shear(const State& state) const {
  return laws_.friction() ? nodal_sum(state, column::shear) : std::vector<double>();
}

}  // namespace mudline
