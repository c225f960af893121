#pragma once

#include <memory>
#include <string>

#include "core/deck.hpp"
#include "simulation/excess_pressure.hpp"

namespace mudline {

/// The state of another run at the end of one of its stages, in a model of that run's deck.
class ResultState {
 public:
  /// Reads a checkpoint, and loads the plugins of its deck. InputError on every rank alike. Collective.
  ResultState(const std::string& checkpoint, const RCP<const Comm>& comm);
  ResultState(const ResultState&) = delete;
  ResultState& operator=(const ResultState&) = delete;

  const Deck& deck() const { return deck_; }
  const Model& model() const { return *model_; }
  const State& state() const { return model_->store().committed(); }
  const ExcessPressure& pressure() const { return *pressure_; }

 private:
  Deck deck_;
  Registries registries_;
  std::unique_ptr<Section> root_;
  std::unique_ptr<Model> model_;
  std::unique_ptr<ExcessPressure> pressure_;
};

}  // namespace mudline
