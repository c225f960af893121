// The run goes on with a model on a mesh made anew: a restart on another mesh, and a transaction.
#include <cstdio>

#include "core/log.hpp"
#include "core/text.hpp"
#include "simulation/model_renewal.hpp"
#include "simulation/run.hpp"

namespace mudline {

bool Run::remeshing_due() {
  if (!moves_mesh(stage())) return false;
  const Ale& ale = *model_->ale();
  if (ale.renewal_due(progress_.step, progress_.remesh_tried, model_->store().committed())) return true;
  return ale.looks_at_error(progress_.step, progress_.remesh_tried) && ale.too_coarse(wanted_sizes());
}

WantedSizes Run::wanted_sizes() {
  results_->estimate_error();
  return model_->ale()->wanted_sizes(error_estimate_->wanted_sizes(), model_->store().committed());
}

void Run::remesh() {
  progress_.remesh_tried = progress_.step;
  const State& state = model_->store().committed();
  std::optional<WantedSizes> sizes;
  if (model_->ale()->renewal()->adaptive()) sizes.emplace(wanted_sizes());
  const Renewal made = model_->ale()->renew(progress_.step, state, sizes ? &*sizes : nullptr);
  std::string veto = made.veto;
  if (veto.empty()) {
    try {
      veto = hand_over(make_model_(*made.mesh));
    } catch (const InputError& error) {  // on every rank alike
      veto = std::string("there is no model on the new mesh: ") + error.what();
    }
  }
  if (!veto.empty())
    log::warn("no remeshing after step " + std::to_string(progress_.step) + ": " + veto +
              "; the run goes on with the mesh as it is");
}

std::string Run::hand_over(std::unique_ptr<Model> next) {
  auto balances = std::make_unique<Balances>(*next);
  auto error = make_error_estimate(*next);
  const std::vector<double> conserved = balances_->conserved();
  const MeshReceipt receipt = take_over(*model_, stage(), *next);
  if (!receipt.moved) return receipt.veto;
  balances->add_remap(receipt);
  balances->add_remap_of_conserved(conserved);
  const int pressure = model_->space().find("pore pressure");
  NodalView reference("reference pressure", next->store().committed().value.extent(0));
  if (pressure >= 0) reference = carried_over(*model_, *next, pressure, results_->reference_pressure());
  const double time = model_->store().committed().time;
  const ResultsRestart files{{results_->history_mark(), time, false}, {results_->field_steps(), time, false}};
  const long long elements = model_->mesh().num_global_elements();
  results_.reset();
  error_estimate_ = std::move(error);  // it looks at the old model
  model_ = std::move(next);
  balances_ = std::move(balances);
  results_ = std::make_unique<Results>(*model_, settings_, origin_, error_estimate_.get(), files);
  results_->take_reference_pressure(reference);
  look_at_mesh();
  const auto share = [](double before, double after) { return before != 0 ? after / before - 1 : 0.0; };
  char line[300];
  std::snprintf(line, sizeof line,
                "  remeshed: %lld -> %lld elements, quality %.2f -> %.2f, grains %+.1e, water %+.1e, restored %+.1e, "
                "kinetic energy %+.1e, yield drift %.1e",
                elements, model_->mesh().num_global_elements(), receipt.quality_before, receipt.quality,
                share(receipt.before.solid, receipt.after.solid), share(receipt.before.water, receipt.after.water),
                receipt.restored_solid, share(receipt.before.kinetic, receipt.after.kinetic), receipt.yield_drift);
  log::info(line);
  return "";
}

}  // namespace mudline
