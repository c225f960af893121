#pragma once

#include "ale/nodal_remap.hpp"
#include "ale/recovery.hpp"

namespace mudline {

class Ale;

/// An old and a new mesh of the same regions, with the same paths in the same order. Besides its own elements of the
/// old mesh a rank has those that lie where it has elements of the new one.
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
  /// Transfers the nodal values of a field, by overlap dof, see NodalRemap. Collective.
  void transfer(int field, const ConstNodalView& old, const NodalView& now, bool limited = false) const;

 private:
  const Space &old_space_, &space_;
  const GhostedMesh& to_;
  const Positions x_to_;
  const GhostedMesh from_;
  const Positions x_from_;
  const NodalRemap nodal_;
};

}  // namespace mudline
