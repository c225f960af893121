#include "simulation/step_report.hpp"

#include <algorithm>

#include "integrator/overlap.hpp"

namespace mudline {

Report report_of_step(Model& model) {
  Report report;
  const StepView& view = model.system().view();
  for (Reports* term : model.system().terms().reports()) term->histories(view, report);
  const auto& active = model.system().terms().active();
  for (const auto& [name, contact] : model.contacts()) {
    if (std::find(active.begin(), active.end(), contact.get()) != active.end()) continue;
    Report own;
    contact->histories(view, own);
    for (const auto& [key, quantity] : own)
      report[key] = {quantity.unit, quantity.lasting ? quantity.value : 0.0, quantity.lasting};
  }
  Report shares;
  for (const auto& condition : model.conditions()) condition->reactions(model.system().terms().reaction(), shares);
  for (const auto& [name, body] : model.bodies()) {
    const BodyUnknowns& unknowns = body->unknowns();
    const int axes = body->dimension();
    for (int k = 0; k < unknowns.count; ++k) {
      const int direction = unknowns.direction[k];
      const bool turns = direction >= axes;
      const std::string axis = turns && axes == 2 ? "" : " " + std::string(axis_names[direction % axes]);
      shares["body/" + name + (turns ? "/driving moment" : "/driving force") + axis] = {
          turns ? "N m" : "N", model.system().terms().reaction()(unknowns.dof[k]) / unknowns.scale[k]};
    }
  }
  for (const auto& [name, share] : shares)
    report[name] = {share.unit, sum_over_ranks(*model.mesh().comm(), share.value)};
  return report;
}

Report report_of_contacts(const Model& model) {
  Report report;
  StepView view = model.system().view();  // after a restart it belongs to no step yet
  view.committed = &model.store().committed();
  for (const auto& [name, contact] : model.contacts()) contact->histories(view, report);
  return report;
}

}  // namespace mudline
