#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/term_faces.hpp"
#include "physics/biot/water_dilatation.hpp"
#include "physics/soil.hpp"

namespace mudline {

class StressUpdate;

/// R_u = int B^T (sigma' - alpha p m) dv on the configuration at n+1: the history term of the soil. Runs the stress
/// update (Hughes-Winget rotation around the skeleton law) and writes effective stress, law state and void ratio of the
/// trial state. Consistent tangent incl. geometric stiffness and the variation of the rotation (exact for isotropic
/// laws).
class StressDivergence : public Term, public History, public Completes, public Foresees, public Reports {
 public:
  explicit StressDivergence(std::shared_ptr<Soil> soil) : soil_(std::move(soil)) {}
  std::string name() const override { return "stress divergence"; }
  bool may_relax() const override { return true; }
  void declare_state(StateStore& store) override { soil_->declare_state(store); }
  void sparsity(Assembler& assembler) override { soil_->sparsity(assembler); }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  /// In saturated soil the laws see the volume strain of the water (WaterDilatation).
  int complete(const StepView& view, const NodalView& forces) override;
  void foresee_jacobian(bool likely) override { keeps_ = likely; }
  void forget_foreseen() override { kept_ = false; }
  /// The failure of a law in the last evaluation.
  std::string hint(const StepView& view) const override;

 private:
  /// Runs the laws of a block and keeps the first failure; returns the number of failed points.
  int run(StressUpdate& update, const SoilBlock& block);

  std::shared_ptr<Soil> soil_;
  std::unique_ptr<WaterDilatation> dilatation_;  // if there is saturated soil whose laws see it
  std::string failure_;                          // failure in the last evaluation on this rank
  bool keeps_ = false, kept_ = false;
  std::vector<PointView> tangents_;  // by block: tangents of all points at the last evaluation, if stored
};

}  // namespace mudline
