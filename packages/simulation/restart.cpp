// The checkpoint of a run: the committed state, whole, and where the run stands.
#include <filesystem>

#include "core/log.hpp"
#include "discretisation/agree.hpp"
#include "simulation/output/checkpoint_file.hpp"
#include "simulation/run.hpp"

namespace mudline {

namespace {

std::vector<double> copy_out(const NodalView& v) { return std::vector<double>(v.data(), v.data() + v.extent(0)); }
template <class View2>
std::vector<double> copy_out_2d(const View2& v) { return std::vector<double>(v.data(), v.data() + v.extent(0) * v.extent(1)); }

void copy_in(const CheckpointData& from, const std::string& name, double* to, std::size_t size) {
  const auto found = from.arrays.find(name);
  if (found == from.arrays.end() || found->second.size() != size)
    throw InputError("the checkpoint does not fit this deck: its array '" + name + "' is missing or of another size");
  std::copy(found->second.begin(), found->second.end(), to);
}

double scalar(const CheckpointData& from, const std::string& name) {
  const auto found = from.scalars.find(name);
  if (found == from.scalars.end()) throw InputError("the checkpoint lacks the value '" + name + "'");
  return found->second;
}

}  // namespace

void Run::save_checkpoint() {
  const State& state = model_.store().committed();
  CheckpointData data;
  data.arrays["nodal/value"] = copy_out(state.value);
  data.arrays["nodal/rate"] = copy_out(state.rate);
  data.arrays["nodal/acceleration"] = copy_out(state.acceleration);
  data.arrays["nodal/coordinates"] = copy_out_2d(state.coordinates);
  data.arrays["nodal/initial pressure"] = copy_out(results_->initial_pressure());
  for (std::size_t i = 0; i < state.history_forces.size(); ++i)
    data.arrays["history force/" + std::to_string(i)] = copy_out(state.history_forces[i]);
  for (int i = 0; i < model_.store().num_arrays(); ++i) data.arrays["array/" + model_.store().info(i).name] = copy_out_2d(state.arrays[i]);
  data.arrays["linear solver"] = model_.stepper().solver_memory();
  data.scalars["time"] = state.time;
  data.scalars["stage"] = progress_.stage;
  data.scalars["step in stage"] = progress_.step_in_stage;
  data.scalars["step"] = progress_.step;
  data.scalars["stage start"] = progress_.stage_start;
  data.scalars["next dt"] = progress_.next_dt;
  data.scalars["next field time"] = progress_.next_field_time;
  data.scalars["stage open"] = progress_.stage_open;
  const auto& floor = model_.stepper().reference_floor();
  for (std::size_t f = 0; f < floor.size(); ++f) {
    data.scalars["reference floor " + std::to_string(f)] = floor[f];
    data.scalars["size floor " + std::to_string(f)] = model_.stepper().size_floor()[f];
  }
  CheckpointWriter(model_.mesh().comm(), signature_of(model_.mesh())).write(checkpoint_path(), data);
}

void Run::load_checkpoint() {
  agree(*model_.mesh().comm(), [&] {
    if (!std::filesystem::exists(checkpoint_path()))
      throw InputError(checkpoint_path() + ": there is no such checkpoint; --restart continues a run of the same deck that left one");
  });
  checkpoint_ = CheckpointReader(model_.mesh().comm(), signature_of(model_.mesh())).read(checkpoint_path());
  agree(*model_.mesh().comm(), [&] {
    try {
      restore_state();
    } catch (const InputError& error) {
      throw InputError(checkpoint_path() + ": " + error.what());
    }
  });
  log::info("restart at t = " + std::to_string(model_.store().committed().time) + " s, step " + std::to_string(progress_.step) + ", stage '" +
            model_.stages()[progress_.stage]->name + "'");
}

void Run::restore_state() {
  const CheckpointData& data = checkpoint_;
  State& state = model_.store().committed();
  copy_in(data, "nodal/value", state.value.data(), state.value.extent(0));
  copy_in(data, "nodal/rate", state.rate.data(), state.rate.extent(0));
  copy_in(data, "nodal/acceleration", state.acceleration.data(), state.acceleration.extent(0));
  copy_in(data, "nodal/coordinates", state.coordinates.data(), state.coordinates.size());
  for (std::size_t i = 0; i < state.history_forces.size(); ++i)
    copy_in(data, "history force/" + std::to_string(i), state.history_forces[i].data(), state.history_forces[i].extent(0));
  for (int i = 0; i < model_.store().num_arrays(); ++i)
    copy_in(data, "array/" + model_.store().info(i).name, state.arrays[i].data(), state.arrays[i].size());
  state.time = scalar(data, "time");
  progress_.stage = static_cast<int>(scalar(data, "stage"));
  progress_.step_in_stage = static_cast<int>(scalar(data, "step in stage"));
  progress_.step = static_cast<int>(scalar(data, "step"));
  progress_.stage_start = scalar(data, "stage start");
  progress_.next_dt = scalar(data, "next dt");
  progress_.next_field_time = scalar(data, "next field time");
  progress_.stage_open = scalar(data, "stage open") != 0;
  auto& floor = model_.stepper().reference_floor();
  for (std::size_t f = 0; f < floor.size(); ++f) {
    floor[f] = scalar(data, "reference floor " + std::to_string(f));
    model_.stepper().size_floor()[f] = scalar(data, "size floor " + std::to_string(f));
  }
  if (progress_.stage >= static_cast<int>(model_.stages().size()))
    throw InputError("the checkpoint stands in stage " + std::to_string(progress_.stage + 1) + ", but the deck has " +
                     std::to_string(model_.stages().size()) + " stages");
}

void Run::restore_initial_pressure() {
  const NodalView view = results_->initial_pressure();
  copy_in(checkpoint_, "nodal/initial pressure", view.data(), view.extent(0));
}

void Run::restore_solver() {
  const auto found = checkpoint_.arrays.find("linear solver");
  if (found != checkpoint_.arrays.end()) model_.stepper().restore_solver(found->second);
}

}  // namespace mudline
