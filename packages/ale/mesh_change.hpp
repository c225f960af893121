#pragma once

#include "ale/nodal_remap.hpp"
#include "ale/recovery.hpp"

namespace mudline {

class Ale;

/// A mesh and another one of the same regions, with the same paths in the same order. Both are whole on every rank as
/// long as this lives, for where their parts lie on each other nobody knows; every rank makes what is its own.
class MeshChange {
 public:
  /// Collective.
  MeshChange(const Ale& from, const State& before, const Ale& to, const State& after);
  MeshChange(const MeshChange&) = delete;
  MeshChange& operator=(const MeshChange&) = delete;

  const GhostedMesh& from() const { return from_; }
  const GhostedMesh& to() const { return to_; }
  const Positions& x_from() const { return x_from_; }
  const Positions& x_to() const { return x_to_; }
  /// A field: see NodalRemap. Collective.
  void carry(const Space& old_space, int old_field, const ConstNodalView& old, const Space& space, int field,
             const NodalView& now, bool limited = false) const;

 private:
  const GhostedMesh from_, to_;
  const Positions x_from_, x_to_;
  const NodalRemap nodal_;
};

}  // namespace mudline
