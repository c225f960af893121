#include "simulation/result_state.hpp"

#include "simulation/checkpoint.hpp"
#include "simulation/plugin.hpp"

namespace mudline {

ResultState::ResultState(const std::string& path, const RCP<const Comm>& comm) {
  const Origin origin = Checkpoint::origin_of(path, comm);
  deck_.overlay(origin.deck, origin.deck_file);
  deck_.take_section("variables");  // its formulas are worked out
  root_ = std::make_unique<Section>(deck_.root());
  register_all(registries_);
  load_plugins(root_->section("plugins"), registries_);
  const auto make = [&](std::shared_ptr<const RemeshedMesh> mesh) {
    try {
      model_ = std::make_unique<Model>(comm, *root_, registries_, MeshOrigin{"", std::move(mesh)});
    } catch (const InputError& error) {
      throw InputError(path + ": its model cannot be made again: " + error.what());
    }
  };
  make(nullptr);
  Checkpoint checkpoint(path, Checkpoint::For::state, origin, false);
  if (const auto remeshed = checkpoint.open(model_->mesh())) make(remeshed);
  pressure_ = std::make_unique<ExcessPressure>(*model_);
  Progress progress;
  checkpoint.read(*model_, *pressure_, progress);
}

}  // namespace mudline
