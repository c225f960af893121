#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Gravity as a vector times a function of time (a factor to switch it on).
struct Gravity {
  Point vector{};        // [m/s2]
  Function factor{1.0};  // function of time
  /// Unit vector against gravity; for zero gravity the last direction of the mesh.
  Point up(int dimension) const;
  Point at(double time) const {
    const double f = factor(time, {0, 0, 0});
    return {f * vector[0], f * vector[1], f * vector[2]};
  }
};

/// R_u = int N^T rho b dv at the alpha level with b = a (inertia) or b = -g (gravity); rho = n rho_f + (1-n) rho_s
/// follows the deformation. With pore pressures in excess of water at rest, gravity acts on rho - alpha rho_f. Inertia
/// and gravity are two instances so that the balances list them separately.
class BodyForce : public Term {
 public:
  enum class Kind { inertia, gravity };
  BodyForce(std::shared_ptr<Soil> soil, Kind kind, Gravity gravity = {})
      : soil_(std::move(soil)), kind_(kind), gravity_(gravity) {}
  std::string name() const override { return kind_ == Kind::inertia ? "inertia" : "gravity"; }
  Role role() const override { return kind_ == Kind::inertia ? Role::inertia : Role::force; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;

 private:
  bool active(const StepView& view) const;
  /// Calls f(block, law of balance).
  template <class F>
  void for_each_block(const StepView& view, F&& f) const;
  std::shared_ptr<Soil> soil_;
  Kind kind_;
  Gravity gravity_;
};

}  // namespace mudline
