#include "framework/state.hpp"

#include <stdexcept>

namespace mudline {

namespace {

State make_state(const Space& space) {
  const int n = space.dofs()->num_overlap_dofs();
  State state;
  state.value = NodalView("value", n);
  state.rate = NodalView("rate", n);
  state.acceleration = NodalView("acceleration", n);
  state.predictor = NodalView("predictor", n);
  state.coordinates = CoordinateView("coordinates", space.mesh().num_nodes(), space.mesh().dimension());
  Kokkos::deep_copy(state.coordinates, space.mesh().coordinates());
  return state;
}

void copy(const State& from, State& to) {
  to.time = from.time;
  to.increment = from.increment;
  Kokkos::deep_copy(to.value, from.value);
  Kokkos::deep_copy(to.rate, from.rate);
  Kokkos::deep_copy(to.acceleration, from.acceleration);
  Kokkos::deep_copy(to.predictor, from.predictor);
  for (std::size_t i = 0; i < from.history_forces.size(); ++i)
    Kokkos::deep_copy(to.history_forces[i], from.history_forces[i]);
  Kokkos::deep_copy(to.coordinates, from.coordinates);
  for (std::size_t i = 0; i < from.arrays.size(); ++i) Kokkos::deep_copy(to.arrays[i], from.arrays[i]);
}

/// A state of the same sizes, with undefined content.
State room_for(const State& like) {
  State state;
  state.value = NodalView("value", like.value.extent(0));
  state.rate = NodalView("rate", like.rate.extent(0));
  state.acceleration = NodalView("acceleration", like.acceleration.extent(0));
  state.predictor = NodalView("predictor", like.predictor.extent(0));
  for (const NodalView& force : like.history_forces)
    state.history_forces.emplace_back("history force", force.extent(0));
  state.coordinates = CoordinateView("coordinates", like.coordinates.extent(0), like.coordinates.extent(1));
  for (const PointView& array : like.arrays) state.arrays.emplace_back("kept", array.extent(0), array.extent(1));
  return state;
}

}  // namespace

StateStore::StateStore(const Space& space) : committed_(make_state(space)), trial_(make_state(space)) {}

int StateStore::declare(ArrayInfo info) {
  if (find(info.name) >= 0) throw std::logic_error("state array '" + info.name + "' is declared twice");
  if (const std::string problem = info.problem(); !problem.empty())
    throw std::logic_error("state array '" + info.name + "': " + problem);
  committed_.arrays.emplace_back(info.name, info.rows, info.columns());
  trial_.arrays.emplace_back(info.name, info.rows, info.columns());
  info_.push_back(std::move(info));
  return num_arrays() - 1;
}

int StateStore::find(const std::string& name) const {
  for (int i = 0; i < num_arrays(); ++i)
    if (info_[i].name == name) return i;
  return -1;
}

void StateStore::allocate_history(int terms) {
  for (State* state : {&committed_, &trial_}) {
    state->history_forces.clear();
    for (int i = 0; i < terms; ++i) state->history_forces.emplace_back("history force", state->value.extent(0));
  }
}

void StateStore::begin() { copy(committed_, trial_); }

void StateStore::keep() {
  if (kept_.value.extent(0) != committed_.value.extent(0)) kept_ = room_for(committed_);
  copy(committed_, kept_);
}

void StateStore::restore() { copy(kept_, committed_); }

void StateStore::take_evaluated() {
  for (int handle = 0; handle < num_arrays(); ++handle)
    if (info_[handle].evaluated) Kokkos::deep_copy(committed_.arrays[handle], trial_.arrays[handle]);
}

void StateStore::accept() { std::swap(committed_, trial_); }

}  // namespace mudline
