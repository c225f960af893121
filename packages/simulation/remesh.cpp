// Remeshing: the run goes on with a model on a new mesh, or with the old one where that fails.
#include <utility>

#include "core/log.hpp"
#include "core/run_error.hpp"
#include "core/stopwatch.hpp"
#include "core/text.hpp"
#include "simulation/model_remeshing.hpp"
#include "simulation/run.hpp"

namespace mudline {

bool Run::remeshing_due() {
  if (!moves_mesh(stage())) return false;
  const Ale& ale = *model_->ale();
  if (ale.remeshing_due(progress_.step, progress_.remesh_tried, model_->store().committed())) return true;
  return ale.looks_at_error(progress_.step, progress_.remesh_tried) && ale.too_coarse(wanted_sizes().get());
}

std::unique_ptr<const WantedSizes> Run::wanted_sizes() {
  return model_->ale()->wanted_sizes(error_estimate_->wanted_sizes(view()), model_->store().committed());
}

void Run::remesh() {
  const Stopwatch watch(mesh_time_);
  const int tried_before = progress_.remesh_tried;
  progress_.remesh_tried = progress_.step;
  const State& state = model_->store().committed();
  std::unique_ptr<const WantedSizes> sizes;
  if (model_->ale()->remeshing()->adaptive()) sizes = wanted_sizes();
  const Remeshing made = model_->ale()->remesh(progress_.step, state, sizes.get());
  if (!made.lost.empty()) {
    progress_.remesh_tried = tried_before;  // a restart tries again
    save_checkpoint();
    throw RunError("remeshing after step " + std::to_string(progress_.step) + ": " + made.lost +
                   "; the run ends here with its state saved, and --restart tries again");
  }
  std::string veto = made.veto;
  if (veto.empty()) {
    try {
      veto = transfer_to(make_model_(made.mesh));
    } catch (const InputError& error) {  // on every rank alike
      veto = std::string("there is no model on the new mesh: ") + error.what();
    }
  }
  if (!veto.empty())
    log::warn("no remeshing after step " + std::to_string(progress_.step) + ": " + veto +
              "; the run goes on with the mesh as it is");
}

std::string Run::transfer_to(std::unique_ptr<Model> next) {
  auto balances = std::make_unique<Balances>(*next);
  auto pressures = std::make_unique<ExcessPressure>(*next);
  tell([&](Observer& observer) { observer.declare_state(*next); });
  const std::vector<double> conserved = balances_->conserved();
  const auto [receipt, between] = transfer_from(*model_, stage(), *next);
  if (!receipt.moved) return receipt.veto;
  balances->add_remap(receipt);
  balances->add_remap_of_conserved(conserved);
  const int pressure = model_->space().find("pore pressure");
  const NodalView reference("reference pressure", next->store().committed().value.extent(0));
  if (pressure >= 0) between->transfer_field(pressure, pressure_->reference(), reference);
  const long long elements = model_->mesh().num_global_elements();
  const std::unique_ptr<Model> old =
      std::exchange(model_, std::move(next));  // observers refer to it until they are told
  model_->system().continue_times(old->system().times());
  balances_ = std::move(balances);
  pressure_ = std::move(pressures);
  pressure_->take_reference(reference);
  tell(&Observer::remeshed);
  transfers_.tell(*model_, receipt,
                  "  remeshed: " + std::to_string(elements) + " -> " +
                      std::to_string(model_->mesh().num_global_elements()) + " elements, ",
                  log::info);
  return "";
}

}  // namespace mudline
