#include "contact/conjugate_position.hpp"

namespace mudline {

ConstCoordinateView moved_ahead(const Space& space, const ConstCoordinateView& x, const ConstNodalView& ahead) {
  if (ahead.extent(0) == 0) return x;
  const auto& dof = space.node_dof(space.find("displacement"));
  const CoordinateView moved("conjugate position", x.extent(0), x.extent(1));
  for (std::size_t node = 0; node < x.extent(0); ++node)
    for (std::size_t i = 0; i < x.extent(1); ++i)
      moved(node, i) = x(node, i) + (dof(node) >= 0 ? ahead(dof(node) + i) : 0.0);
  return moved;
}

BodyPlacement moved_ahead(const RigidBody& body, const State& state, const ConstNodalView& ahead, double lead) {
  if (ahead.extent(0) == 0) return body.placement(state);
  if (body.unknowns().count > 0) return body.placement(state, ahead);
  BodyPlacement result = body.placement(state);
  const BodyState now = body.state_of(state);
  result.centre += lead * now.velocity;
  result.turn = Rotation::by(lead * now.spin) * result.turn;
  return result;
}

}  // namespace mudline
