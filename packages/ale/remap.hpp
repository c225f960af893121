#pragma once

#include <memory>
#include <vector>

#include "ale/recovery.hpp"
#include "core/registry.hpp"

namespace mudline {

/// Transfer of one block's point data to another mesh of the same region, or to the same mesh after it moved.
struct PointTransfer {
  BlockPoints before, after;
  const RecoveryPatches& patches;               // of the mesh before
  const std::vector<StateVariable>& variables;  // variables that the columns hold, with their rules and bounds
  int columns;
  const std::vector<double>& old;  // (row of gather_points, column) before
  std::vector<double>& now;        // table after the transfer; on entry, where the mesh moved, a copy of old
  /// Whether it is the same mesh, moved.
  bool moved() const { return &before.mesh == &after.mesh; }
};

/// Lowest and highest values of columns.
struct ColumnBounds {
  std::vector<double> low, high;
  explicit ColumnBounds(const std::vector<StateVariable>& variables);
};

/// Transfers the state of quadrature points to the moved mesh: type of "remap" in the deck's "mesh motion".
class Remap {
 public:
  virtual ~Remap() = default;
  /// Transfers the points of this rank's own elements. Collective. Tensors are transferred by component in the world
  /// frame. All values stay within the bounds that their variable declares.
  virtual void transfer(const PointTransfer& transfer) const = 0;
};

/// The convection formula f + (x_new - x_old) . grad f with the gradient of the recovered field f*, integrated along
/// the point's motion: f_new = f + f*(x_new) - f*(x_old). Upwind: the further a point moves, in half element sizes, the
/// more of f* itself and the less of the point's own deviation from it is taken. In simplices a deviation of more than
/// half the range of f* over the element counts as scatter: the excess is gone after a hundredth of that distance.
/// Limited: no new extremum relative to the elements that the point leaves and enters. Exact for linear fields.
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

/// Takes the recovered field itself, for another mesh of the same region, within the range of the element that a point
/// lies in. PointTransfer::before must have the elements where this rank's points of the new mesh are.
class RecoveryRemap : public Remap {
 public:
  void transfer(const PointTransfer& transfer) const override;
};

void register_remaps(Registry<Remap>& registry);

}  // namespace mudline
