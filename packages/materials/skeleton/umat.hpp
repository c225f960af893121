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
///   DFGRD0, DFGRD1  deformation gradient at the start and at the end of the step, since the start of the run (kept as
///                   state variables; on a mesh that moves against the soil they are transferred like these)
///   DDSDDE          must be the Jacobian of the stress update; it may be unsymmetric
///   COORDS          position of the point at the end of the step [m]; not a number in a point test, which has none
///   TIME, DTIME     time of the stage and of the run at the start of the step, and the step; DTIME is 0 in a geostatic
///                   stage
///   KSTEP, KINC     number of the stage, 1 in a point test, and of the step within it, from 1
///   NOEL, NPT       number of the element and of the point in it, from 1, the same on any number of ranks
///   CELENT          root of the element's area, or cube root of its volume, over its order [m]; not a number in a
///                   point test
///   PROPS, NTENS    from the deck; NTENS = 4 (plane strain, axisymmetric) fails where there is out-of-plane shear
///   PNEWDT          below 1: the point has failed and the step is cut
///   DROT            rotation of the step; the identity where "tensor state" names the tensors of STATEV, which mudline
///                   rotates
///   TEMP, DTEMP     of the model's temperature; without one "temperature" and 0
///   the others      SSE, SPD, SCD, RPL, their derivatives: 0; LAYER, KSPT: 1; PREDEF, DPRED: not a number, so that a
///                   law that uses them fails
///
/// STRESS and DDSDDE are in the "stress unit". A SDVINI of the library sets STATEV at the start, a SIGINI the stress of
/// a start of the type "by law". The utility routines of umat_utilities are there where the library has none of its
/// own. Writing outside of the arrays ends the program with the law's name.
class Umat : public Skeleton {
 public:
  void parameters(Parameters& p);
  /// Loads the library. InputError.
  void check(const Section& section);

  const std::vector<StateVariable>& state_variables() const override { return variables_; }
  bool gives_stress() const override { return sigini_ != nullptr; }
  /// By SIGINI.
  std::string find_stress(InitialPoint& point) const override;
  std::string initialise(const InitialPoint& point, double* state) const override;
  bool wants_surroundings() const override { return true; }
  int evaluate(const SkeletonWorkset& workset) const override;
  ElasticModuli moduli(const double*, double, const double*) const override { return {bulk_, shear_}; }
  double k0(const InitialPoint&) const override { return k0_; }

 private:
  class Arguments;
  /// Fills the arguments beside stress, strain and state. False where the deformation gradient is not finite.
  bool tell_surroundings(const SkeletonWorkset& workset, int point, Arguments& to) const;
  bool update(const SkeletonWorkset& workset, int point) const;
  void make_variables();
  /// Ends the program where the subroutine has written outside of its arrays.
  void check_overrun(const std::string& symbol) const;

  std::string library_, symbol_ = "umat_", name_ = "UMAT";
  int components_ = 6, state_count_ = 0;
  std::vector<double> properties_, initial_state_, tensor_state_;
  std::vector<int> tensors_;         // first components, from 0
  double bulk_ = 0.0, shear_ = 0.0;  // [Pa]
  double k0_ = -1.0;
  double temperature_ = 0.0;  // [degC]
  enum class StressUnit { pa, kpa, mpa } unit_ = StressUnit::pa;
  double scale_ = 1.0;  // [Pa] the stress unit
  int dimension_ = 3;
  std::vector<StateVariable> variables_;
  std::vector<int> source_;  // component of the state (behind the strain) -> index in STATEV
  void *routine_ = nullptr, *sdvini_ = nullptr, *sigini_ = nullptr;
  std::shared_ptr<Arguments> arguments_;
};

}  // namespace mudline
