#pragma once

#include <array>
#include <string>
#include <vector>

#include "discretisation/mesh_topology.hpp"
#include "simulation/model.hpp"

namespace mudline {

/// Finds what nothing holds: rigid motions of the connected parts of the mesh and of the released bodies that no
/// prescribed displacement, no contact and no spring resists. In a stage without inertia they make the equations
/// singular.
///
/// A motion has one amplitude per part (or body) and direction: along every axis, then about z in the plane and about
/// x, y and z in space; y in axisymmetry. Every support is a row, the displacement that it resists as a linear function
/// of the amplitudes; what is free is the null space of all rows. A prescribed unknown gives one row. A contact resists
/// the relative displacement along the normal of its surface, with friction also the tangential one. Where it may have
/// been pressed in (a stage before this one took time), or where its body is released, it counts as holding both, so
/// that nothing that could be held is called free. Absorbing boundaries hold nothing at rest.
class Supports {
 public:
  /// Collective.
  Supports(Model& model, const MeshParts& parts);
  /// Text on what is free to move in the stage that begins at `time` [s], such as "body 'anchor' is free to move in x";
  /// "": nothing. `pressed_in`: contacts may have been pressed in. Collective, the same answer on every rank.
  std::string missing(const Stage& stage, double time, bool pressed_in) const;

 private:
  /// A connected part of the mesh or a released body, which moves as a whole. It turns about its centre; a rotation of
  /// 1 moves a point at the distance `size` by 1.
  struct Mover {
    std::string name;
    const RigidBody* body = nullptr;
    Point centre{};
    double size = 1;
  };
  struct Motion {
    int mover;
    int direction;  // translations first
  };
  using Row = std::vector<double>;  // by motion
  class Gram;                       // sum of the rows' products
  class Collector;

  void find_parts();
  std::vector<Mover> movers(const Stage& stage) const;
  std::vector<Motion> motions(const Stage& stage, const std::vector<Mover>& movers) const;
  /// The part of a side set's node that is nearest to a point; on a rank that has all nodes of the set.
  int nearest_part(const std::string& set, const Point& at) const;
  int dimension() const { return model_.mesh().dimension(); }
  int directions() const { return dimension() == 3 ? 6 : 3; }

  Model& model_;
  const MeshParts& mesh_parts_;
  std::vector<Mover> parts_;
};

}  // namespace mudline
