#pragma once

#include <map>
#include <vector>

#include "contact/contact_surface.hpp"
#include "core/function.hpp"
#include "framework/side_block.hpp"
#include "framework/term.hpp"

namespace mudline {

/// Water that leaves through a surface under a permeable body: R_p += int Np q ds, q = conductance (p - outside) [m/s],
/// with the pore pressure at the level of the mass balance and the sides' lengths at the start of the step.
class LeakySurface {
 public:
  /// conductance [m/(Pa s)]; outside [Pa], a function of time and place.
  LeakySurface(const Space& space, const ContactSurface& surface, double conductance, const Function& outside);

  void sparsity(Assembler& assembler);
  /// Sets which sides leak in the coming step: nonzero flags, by side.
  void open(const std::vector<char>& flags);
  /// Adds the flow of the leaking sides to the residual, by overlap dof.
  void add(const StepView& view, const ResidualView& f) const;
  void jacobian(const StepView& view, Assembler& assembler) const;

 private:
  /// The sides of one shape, by their row in the surface's dof table.
  struct Part {
    SideBlock block;
    PointView outside;  // [Pa] at the points
    Kokkos::View<char*> open;
  };
  template <class F>
  void for_each_part(const StepView& view, F&& f) const;

  const Space& space_;
  const ContactSurface& surface_;
  double conductance_;
  const Function& outside_;
  std::map<CellShape, Part> parts_;
};

}  // namespace mudline
