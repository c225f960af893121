#pragma once

#include <memory>
#include <vector>

#include "ale/recovery.hpp"
#include "core/registry.hpp"

namespace mudline {

/// One point array of one block, on the way from the old mesh to the new one.
struct PointTransfer {
  const GhostedMesh& mesh;
  const SoilBlock& block;
  const RecoveryPatches& patches;
  const Positions &x_old, &x_new;
  const std::vector<StateVariable>& variables;  // split of the columns: rules and bounds
  int columns;
  const std::vector<double>& old;  // (row of gather_points, column)
  std::vector<double>& now;        // in: a copy of old; out
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
/// itself and the less of the point's own deviation from it is taken. Limited: no new extremum over the elements the
/// point leaves and enters. Exact for linear fields.
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

void register_remaps(Registry<Remap>& registry);

}  // namespace mudline
