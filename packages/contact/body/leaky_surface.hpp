#pragma once

#include <vector>

#include "contact/contact_surface.hpp"
#include "core/function.hpp"
#include "framework/term.hpp"

namespace mudline {

/// Water that leaves through a surface under a permeable body: R_p += int Np q ds, q = conductance (p - outside) [m/s],
/// with the pore pressure at the level of the mass balance and the sides' lengths at the start of the step.
class LeakySurface {
 public:
  /// conductance [m/(Pa s)]; outside [Pa], a function of time and place.
  LeakySurface(const Space& space, const ContactSurface& surface, double conductance, const Function& outside);

  void sparsity(Assembler& assembler);
  /// Which sides leak in the coming step: nonzero flags.
  void open(std::vector<char> flags) { flags_ = std::move(flags); }
  /// Adds to the residual, by overlap dof.
  void add(const StepView& view, const ResidualView& f) const;
  void jacobian(const StepView& view, Assembler& assembler) const;

 private:
  /// Matrix of one side: integral of the pressures' shapes [m2/(Pa s)], and the flux of the outside pressure [m3/s] by
  /// node.
  struct SideMatrix {
    double k[3][3], outside[3];
  };
  SideMatrix side_matrix(const SurfaceSide& side, const StepView& view) const;
  bool leaks(std::size_t side) const { return side < flags_.size() && flags_[side]; }

  const ContactSurface& surface_;
  double conductance_;
  const Function& outside_;
  bool axisymmetric_;
  int field_;
  ElementDofs dofs_[2];  // for sides of 2 and of 3 nodes
  int group_[2] = {-1, -1};
  std::vector<char> flags_;
};

}  // namespace mudline
