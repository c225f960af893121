#include "simulation/discretisation_error.hpp"

#include <algorithm>
#include <cmath>

#include "integrator/overlap.hpp"
#include "simulation/output/collective.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Share of a motion's largest speed in the stage below which it gives no new error: the rest is vibration.
constexpr double slow = 0.01;

Point reaction_of(const std::string& column, const Report& terms) {
  Point force{};
  for (std::size_t i = 0; i < axis_names.size(); ++i) {
    const auto found = terms.find(column + " " + axis_names[i]);
    if (found != terms.end()) force[i] = found->second.value;
  }
  return force;
}

}  // namespace

DiscretisationError::DiscretisationError(Model& model, double target)
    : model_(model), target_(target), estimator_(*model.soil(), model.store()) {
  for (const auto& [name, body] : model.bodies()) {
    Motion motion{"body/" + name, body.get(), nullptr, {}};
    for (const auto& [contact_name, contact] : model.contacts())
      if (contact->partners().body == body.get()) motion.reactions.push_back("contact/" + contact_name + "/reaction");
    if (!motion.reactions.empty()) motions_.push_back(std::move(motion));
  }
  for (const auto& condition : model.conditions())
    if (condition->drives())
      motions_.push_back({"condition/" + condition->name, nullptr, condition.get(), {"reaction/" + condition->name}});
  std::vector<long long> ids;
  for (const Motion& motion : motions_)
    for (const char* row : {" share", " fastest"}) ids.push_back(id_of(motion.name + row));
  ArrayInfo info = ArrayInfo::of_model("discretisation error", {{"value", 1, "SI"}}, std::move(ids));
  handle_ = model.store().declare(std::move(info).not_shown());
}

void DiscretisationError::start() { estimator_.start(model_.store().committed()); }

void DiscretisationError::begin_stage() {
  const PointView values = model_.store().committed().arrays[handle_];
  for (std::size_t m = 0; m < motions_.size(); ++m) values(m * rows + fastest, 0) = 0;
}

void DiscretisationError::evaluate(const NodalView& excess) {
  estimate_ = estimator_.estimate(model_.store().committed(), excess, target_);
}

std::vector<OutputField> DiscretisationError::fields() const {
  std::vector<OutputField> result{{"error/stress", "Pa", 1, estimate_.stress},
                                  {"error/wanted size", "m", 1, estimate_.wanted}};
  if (!estimate_.pressure.empty() || model_.soil()->pressure >= 0)
    result.push_back({"error/pore pressure", "Pa", 1, estimate_.pressure});
  return result;
}

DiscretisationError::Resisted DiscretisationError::resisted(const Motion& motion, const Report& terms) const {
  const State& state = model_.store().committed();
  Resisted result;
  if (motion.body != nullptr) {
    const Point velocity = motion.body->velocity(state);
    for (const std::string& column : motion.reactions) result.power += dot(reaction_of(column, terms), velocity);
    return {std::abs(result.power), length(velocity)};
  }
  // reaction times rate, summed over nodes as the condition sums its reactions
  const NodalView& reaction = model_.system().terms().reaction();
  NodalView power("power", reaction.extent(0));
  for (std::size_t i = 0; i < power.extent(0); ++i) power(i) = reaction(i) * state.rate(i);
  Report shares;
  motion.condition->reactions(power, shares);
  for (const auto& [name, part] : shares) result.power += sum_over_ranks(*model_.mesh().comm(), part.value);
  const double force = length(reaction_of(motion.reactions.front(), terms));
  return {std::abs(result.power), force > 0 ? std::abs(result.power) / force : 0.0};
}

std::vector<HistoryValue> DiscretisationError::values(const Report& terms) {
  std::vector<HistoryValue> result{{"mesh/stress error", "-", estimate_.stress_share}};
  if (model_.soil()->pressure >= 0) result.push_back({"mesh/flow error", "-", estimate_.flow_share});
  const PointView kept = model_.store().committed().arrays[handle_];
  for (std::size_t m = 0; m < motions_.size(); ++m) {
    double &of_force = kept(m * rows + share, 0), &most = kept(m * rows + fastest, 0);
    const Resisted now = resisted(motions_[m], terms);
    most = std::max(most, now.speed);
    // an error as large as the resistance means that the resistance is unknown
    if (now.speed > 0 && now.speed >= slow * most && now.power > 0)
      of_force = std::min(1.0, estimate_.power / now.power);
    for (const std::string& column : motions_[m].reactions)
      for (int i = 0; i < model_.mesh().dimension(); ++i) {
        const std::string name = column + " " + axis_names[i];
        const auto found = terms.find(name);
        const double force = found != terms.end() ? std::abs(found->second.value) : 0.0;
        result.push_back({name + " error", "N", of_force * force});
      }
  }
  return result;
}

}  // namespace mudline
