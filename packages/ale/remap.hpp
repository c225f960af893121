#pragma once

#include <memory>
#include <vector>

#include "ale/recovery.hpp"
#include "core/registry.hpp"

namespace mudline {

/// Point data of one block on the way from one mesh to another one of the same region, or to the same one moved.
struct PointTransfer {
  BlockPoints before, after;
  const RecoveryPatches& patches;               // of the mesh before
  const std::vector<StateVariable>& variables;  // split of the columns: rules and bounds
  int columns;
  const std::vector<double>& old;  // (row of gather_points, column) before
  std::vector<double>& now;        // the same after; in: where the mesh moved, a copy of old
  /// Whether it is the same mesh, moved.
  bool moved() const { return &before.mesh == &after.mesh; }
};

/// Lowest and highest values of columns.
struct ColumnBounds {
  std::vector<double> low, high;
  explicit ColumnBounds(const std::vector<StateVariable>& variables);
};

/// Carries the state of quadrature points over to the moved mesh: type of "remap" in the deck's "mesh motion".
class Remap {
 public:
  virtual ~Remap() = default;
  /// Of this rank's own elements. Collective. Variables by value, tensors by component in the fixed frame. Nothing
  /// leaves the bounds that a variable declares.
  virtual void transfer(const PointTransfer& transfer) const = 0;
};

/// The convection formula f + (x_new - x_old) . grad f with the gradient of the recovered field f*, taken along the
/// way: f_new = f + f*(x_new) - f*(x_old). Upwind: the further a point moves, in half element sizes, the more of f*
/// itself and the less of the point's own deviation from it is taken. In simplices a deviation of more than half of
/// what f* changes over the element is no field but scatter: what is beyond goes with a hundredth of that way.
/// Limited: no new extremum over the elements the point leaves and enters. Exact for linear fields.
class ConvectionRemap : public Remap {
 public:
  enum class Scheme { upwind, incremental };
  ConvectionRemap() = default;
  ConvectionRemap(Scheme scheme, bool limited) : scheme_(scheme), limited_(limited) {}
  void parameters(Parameters& p);
  void transfer(const PointTransfer& transfer) const override;

 private:
  Scheme scheme_ = Scheme::upwind;
  bool limited_ = true;
};

/// The recovered field itself, for another mesh of the same region: no farther than the range of the element that a
/// point lies in reaches. `before`: has what lies where this rank's points of the other one are.
class RecoveryRemap : public Remap {
 public:
  void transfer(const PointTransfer& transfer) const override;
};

void register_remaps(Registry<Remap>& registry);

}  // namespace mudline
