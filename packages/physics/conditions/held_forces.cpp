#include "physics/conditions/held_forces.hpp"

namespace mudline {

void HeldForces::declare(StateStore& store, const std::string& name, const Space& space, int field,
                         const std::string& set, Transfer rule) {
  space_ = &space;
  store_ = &store;
  field_ = field;
  std::vector<StateVariable> force;
  for (int i = 0; i < space.mesh().dimension(); ++i)
    force.push_back({std::string("held force ") + axis_names[i], 1, "N", rule});
  ArrayInfo info = ArrayInfo::at_nodes(name, force, space.mesh(), set).not_shown();
  nodes_ = info.nodes;
  array_ = store.declare(std::move(info));
}

void HeldForces::take(const NodalView& unbalanced) {
  for (std::size_t row = 0; row < nodes_.size(); ++row)
    for (int i = 0; i < space_->mesh().dimension(); ++i) {
      double& taken = unbalanced(dof_of(row, i));
      store_->committed().arrays[array_](row, i) = -taken;
      taken = 0;
    }
}

void HeldForces::add(const StepView& view, const ResidualView& f) const {
  for (std::size_t row = 0; row < nodes_.size(); ++row)
    for (int i = 0; i < space_->mesh().dimension(); ++i)
      f.add(dof_of(row, i), view.committed->arrays[array_](row, i), 0);
}

}  // namespace mudline
