#include "physics/state.hpp"

#include <stdexcept>

namespace mudline {

namespace {

State make_state(const Space& space) {
  const int n = space.dofs()->num_overlap_dofs();
  State state;
  state.value = NodalView("value", n);
  state.rate = NodalView("rate", n);
  state.acceleration = NodalView("acceleration", n);
  state.coordinates = CoordinateView("coordinates", space.mesh().num_nodes(), 2);
  Kokkos::deep_copy(state.coordinates, space.mesh().coordinates());
  return state;
}

}  // namespace

StateStore::StateStore(const Space& space) : committed_(make_state(space)), trial_(make_state(space)) {}

int StateStore::declare(ArrayInfo info, int rows) {
  if (find(info.name) >= 0) throw std::logic_error("state array '" + info.name + "' is declared twice");
  int columns = 0;
  for (const StateVariable& variable : info.variables) columns += variable.components;
  committed_.arrays.emplace_back(info.name, rows, columns);
  trial_.arrays.emplace_back(info.name, rows, columns);
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

void StateStore::begin() {
  trial_.time = committed_.time;
  Kokkos::deep_copy(trial_.value, committed_.value);
  Kokkos::deep_copy(trial_.rate, committed_.rate);
  Kokkos::deep_copy(trial_.acceleration, committed_.acceleration);
  for (std::size_t i = 0; i < committed_.history_forces.size(); ++i)
    Kokkos::deep_copy(trial_.history_forces[i], committed_.history_forces[i]);
  Kokkos::deep_copy(trial_.coordinates, committed_.coordinates);
  for (std::size_t i = 0; i < committed_.arrays.size(); ++i) Kokkos::deep_copy(trial_.arrays[i], committed_.arrays[i]);
}

void StateStore::accept() { std::swap(committed_, trial_); }

}  // namespace mudline
