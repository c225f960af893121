#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/parameters.hpp"
#include "materials/skeleton.hpp"

namespace mudline {

/// A user subroutine UMAT of the usual Fortran interface (Abaqus/Standard), loaded from a shared library: all arguments
/// by reference, tension positive, order 11 22 33 12 13 23, engineering shear, column-major DDSDDE. Runs on the host,
/// one point after the other, since such code often keeps data of its own.
///
///   STRESS, STATEV  old values in, new ones out; the stress, the strains and the tensors of STATEV ("tensor state")
///                   have been rotated into the new configuration by mudline
///   STRAN, DSTRAN   objective strain so far (kept as a state variable) and of the step
///   DDSDDE          must be the Jacobian of the stress update; it may be unsymmetric
///   TIME, DTIME     time of the run at the start of the step, and the step; DTIME is 0 in a geostatic stage
///   PROPS, NTENS    from the deck; NTENS = 4 (plane strain, axisymmetric) fails where there is out-of-plane shear
///   PNEWDT          below 1: the point has failed and the step is cut
///   DROT            the identity where "tensor state" names the tensors of STATEV, which mudline turns
///   TEMP, DTEMP     "temperature" and 0
///   the others      SSE, SPD, SCD, RPL, their derivatives: 0; NOEL, NPT, LAYER, KSPT, KSTEP, KINC: 1; DFGRD0, DFGRD1,
///                   COORDS, CELENT, PREDEF, DPRED, another DROT: not a number, so that a law that uses it fails
///
/// Writing outside of the arrays ends the program with the law's name.
class Umat : public Skeleton {
 public:
  void parameters(Parameters& p);
  /// Loads the library. InputError.
  void check(const Section& section);

  const std::vector<StateVariable>& state_variables() const override { return variables_; }
  std::string initialise(const InitialPoint& point, double* state) const override;
  int evaluate(const SkeletonWorkset& workset) const override;
  ElasticModuli moduli(const double*, double, const double*) const override { return {bulk_, shear_}; }
  double k0(double) const override { return k0_; }

 private:
  class Arguments;
  bool update(const SkeletonWorkset& workset, int point) const;
  void make_variables();

  std::string library_, symbol_ = "umat_", name_ = "UMAT";
  int components_ = 6, state_count_ = 0;
  std::vector<double> properties_, initial_state_, tensor_state_;
  std::vector<int> tensors_;         // first components, from 0
  double bulk_ = 0.0, shear_ = 0.0;  // [Pa]
  double k0_ = -1.0;
  double temperature_ = 0.0;  // [degC]
  std::vector<StateVariable> variables_;
  std::vector<int> source_;  // component of the state (behind the strain) -> index in STATEV
  void* routine_ = nullptr;
  std::shared_ptr<Arguments> arguments_;
};

}  // namespace mudline
