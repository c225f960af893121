#include "contact/node_contact.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>

#include "contact/two_surfaces.hpp"

namespace mudline {

namespace column = node_column;

void NodeParameters::parameters(Parameters& p) {
  p.required("slave", slave, "Side set whose nodes look for the other surface: the finer or the softer one");
  p.required("master", master, "Side set that they look for");
  p.choice("master surface", drawing, {{"hermite", Drawing::hermite}, {"bezier", Drawing::bezier}, {"linear", Drawing::linear}, {"sides", Drawing::sides}},
           "How the master is drawn over its nodes: hermite: smooth (C1) through them; bezier: smooth, from the middle between two nodes to the "
           "next, with the node as control point; linear: straight from node to node; sides: the elements' own sides, straight or parabolic");
  p.add("corner angle [deg]", corner_angle, "deg", Range{0, 180, true, false},
        "Where straight lines between the master's nodes turn by more than this at the start, it has a corner, which stays one");
  p.add("overhang", overhang, "-", non_negative(), "An open end of the master goes on for this fraction of its last piece");
  p.add("two-pass", two_pass, "The master's nodes look for the slave too, and each pass has half of the forces; with 'enforcement' = penalty");
  p.add("penalty", penalty, "Pa/m", non_negative(), "Pressure per penetration; 0: penalty factor times the slave's stiffness over element size");
  p.add("penalty factor", penalty_factor, "-", positive(), "Automatic penalty: multiple of constrained modulus over element height");
  p.choice("enforcement", enforcement, {{"penalty", Enforcement::penalty}, {"augmented Lagrangian", Enforcement::augmented_lagrangian}},
           "penalty: pressure = penalty times penetration; augmented Lagrangian: a multiplier at each node carries the pressure, found by repeated "
           "solves of a step (Uzawa) until the gap tolerance is met");
  p.add("gap tolerance", gap_tolerance, "m", non_negative(),
        "Augmented Lagrangian: largest gap of the nodes that press, and stretch of those that stick; 0: a millionth of the slave's shortest side");
  p.add("most augmentations", most_augmentations, "-", closed(1, 10000),
        "Augmented Lagrangian: solves of a step after the first; where these do not meet the gap tolerance, the step is cut");
  p.choice("impact", impact, {{"conserving", Impact::conserving}, {"interpolated", Impact::interpolated}},
           "Dynamic steps, 'enforcement' = penalty: a node that touches or leaves within the step exerts the share of its force that does the work of "
           "the penalty spring (no impact adds energy), or what the integrator interpolates");
  p.add("capture distance", capture_distance, "m", non_negative(),
        "Nodes that are farther from the other surface, or deeper in it, do not see it; 0: the slave's longest side");
  p.add("reach", reach, "m", non_negative(),
        "Nodes and pieces that are farther apart than this at the start never meet: keeps the matrix sparse where surfaces slide little; "
        "0: any two may meet");
  p.add("advance limit", advance_limit, "-", positive(),
        "Largest approach of the surfaces in one step, as a fraction of the slave's shortest side; while they are far apart, half their distance");
}

namespace {
void friction_section(Parameters& p) {
  p.passes_on("friction", "Friction along the surface; 'type' names a friction law; absent: smooth surfaces");
}
}  // namespace

void NodeContact::document(Parameters& p) {
  NodeParameters().parameters(p);
  friction_section(p);
}

void NodeContact::parameters(Parameters& p) {
  deck_.parameters(p);
  friction_section(p);
}

void NodeContact::check(const Section& section) {
  name_ = section.name();
  const Mesh& mesh = context_.space.mesh();
  displacement_ = context_.space.find("displacement");
  if (displacement_ < 0) section.fail("contact needs a model with the field 'displacement'", "type");
  check_two_sets(mesh, section, deck_.slave, deck_.master);
  deck_.check(section);
  if (deck_.two_pass && deck_.augmented())
    section.fail("two passes have more multipliers than the surfaces have freedom; allowed with 'two-pass': penalty", "enforcement");
  if (deck_.augmented() && section.has_parameter("impact"))
    section.fail("has a meaning only with 'enforcement' = penalty: its shares are those of the penalty spring's energy", "impact");
  if ((deck_.drawing == Drawing::linear || deck_.drawing == Drawing::sides) && section.has_parameter("corner angle [deg]"))
    section.fail("has a meaning only with a smooth 'master surface'; allowed with it: hermite, bezier", "corner angle [deg]");
  friction_ = friction_of_two(context_, section);
  passes_.push_back(std::make_unique<NodePass>(NodePassSettings{&context_, &deck_, friction_.get(), deck_.two_pass ? 0.5 : 1.0, name() + "/"},
                                               deck_.slave, deck_.master));
  if (deck_.two_pass)
    passes_.push_back(std::make_unique<NodePass>(NodePassSettings{&context_, &deck_, friction_.get(), 0.5, name() + "/second "}, deck_.master,
                                                 deck_.slave));
  const ContactSurface& slave = passes_[0]->slave();
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * slave.shortest(mesh.coordinates());
  check_overlap_of_two(slave, section, deck_.slave, passes_[0]->least_gap(4 * slave.longest(mesh.coordinates()), mesh.coordinates()));
}

void NodeContact::declare_state(StateStore& store) {
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

double NodeContact::magnitude_squared(int field) const {
  double sum = 0;
  for (const auto& pass : passes_) sum += field == displacement_ ? pass->magnitude_squared() : 0.0;
  return sum;
}

void NodeContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  for (auto& pass : passes_) pass->jacobian(view, assembler, weight);
}

Augmentation NodeContact::augment(const StepView& view, int count) {
  if (!deck_.augmented()) return {};
  const State& trial = *view.trial;
  const auto end = end_of_augmentation(name_, deck_, gap_tolerance_, passes_[0]->misfit(trial), count, *context_.space.mesh().comm());
  if (end) return *end;
  passes_[0]->augment(trial);
  return {true, ""};
}

std::string NodeContact::hint(const StepView&) const {
  const int here = beyond_reach_ ? 1 : 0;
  int any = 0;
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_MAX, here, Teuchos::outArg(any));
  return any == 0 ? "" : "surfaces of contact '" + name_ + "' met that were farther apart at the start than its 'reach': raise it";
}

void NodeContact::histories(const StepView& view, std::map<std::string, double>& values) {
  const State& state = *view.committed;
  constexpr int sums = 4;
  double local[sums] = {0, 0, 0, 0}, sum[sums], deepest = 0, everywhere = 0;
  for (std::size_t k = 0; k < passes_.size(); ++k) {
    const NodePass& pass = *passes_[k];
    const double sign = k == 0 ? 1 : -1;  // the second pass reports what the master gets
    local[0] += sign * pass.sum(state, column::force_x);
    local[1] += sign * pass.sum(state, column::force_y);
    local[2] += pass.sum(state, column::area);
    local[3] += pass.sum(state, column::heat);
    deepest = std::max(deepest, pass.deepest(state));
  }
  const Teuchos::Comm<int>& comm = *context_.space.mesh().comm();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, sums, local, sum);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, deepest, Teuchos::outArg(everywhere));
  values[name() + "/force on slave x [N]"] = sum[0];
  values[name() + "/force on slave y [N]"] = sum[1];
  values[name() + "/contact area [m2]"] = sum[2];
  values[name() + "/maximum penetration [m]"] = everywhere;
  if (deck_.augmented()) {
    const auto [gap, stretch] = passes_[0]->misfit(state).largest(comm);
    values[name() + "/weighted gap [m]"] = gap;
    if (friction_) values[name() + "/stretch [m]"] = stretch;
  }
  if (friction_) values[name() + "/friction heat [J]"] = sum[3];
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
  return friction_ ? nodal_sum(state, column::shear) : std::vector<double>();
}

}  // namespace mudline
