#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "framework/closed_sides.hpp"
#include "framework/condition.hpp"
#include "framework/nodal_exchange.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Number of the field on which the condition of `section` acts. One that the model lacks is reported at the parameter
/// `field`, or at the `type` where that says the field.
int conditioned_field(const Space& space, const Section& section, const std::string& name);

/// Conditions that prescribe nodal unknowns on a set.
class Prescribed : public Condition, public HoldsOnOpenSides {
 public:
  void set_closed(const ClosedSides& closed) override;
  void bind(const ConditionContext& context, const Section& section) override;
  void reactions(const NodalView& reaction, Report& shares) const override;
  std::string holds() const override { return field_name() == "displacement" ? set_ : ""; }

 protected:
  /// Name of the prescribed field, which must exist.
  virtual std::string field_name() const { return "displacement"; }
  /// Declares the parameter "set".
  void declare_set(Parameters& p);
  /// Calls f(dof of component 0, node, initial position) for the bound nodes.
  template <class F>
  void for_each_node(F&& f) const {
    for (int node : nodes_) {
      const int dof = space_->node_dof(field_)(node);
      if (dof < 0) continue;
      f(dof, node, space_->mesh().place(node));
    }
  }
  /// Prescribes an unknown at a node or, at an open boundary, the pressure of the water outside.
  void give(const Constraints& to, int dof, int node, double value) const {
    if (!opens_.empty() && opens_[node] != 0)
      to.open_to(dof, value);
    else
      to.prescribe(dof, value);
  }
  /// Like for_each_node(), but leaves out nodes whose sides in the set are all closed to water by bodies. Only a pore
  /// pressure on a set of sides has such nodes.
  template <class F>
  void for_each_open_node(F&& f) const {
    for_each_node([&](int dof, int node, const Point& x) {
      if (open_.empty() || open_[node]) f(dof, node, x);
    });
  }
  std::string set_;
  const Space* space_ = nullptr;
  int field_ = -1;
  std::vector<int> nodes_;

 private:
  std::unique_ptr<const NodalExchange> exchange_;  // for a pore pressure on sides, else null
  /// By local node: whether bodies may seal all of its sides in the set, none leaks there, and the soil around sees
  /// the volume strain of the water (SoilBlock::sees_water). Collective.
  std::vector<char> nodes_that_bodies_may_seal() const;
  std::shared_ptr<const Soil> soil_;                // whose pore pressure is prescribed; null: it is no such condition
  std::set<std::string> may_be_sealed_, may_leak_;  // see ClosedSides
  std::vector<char> opens_;  // (local node) whether its pore pressure is that of the water outside; empty: none
  std::vector<char> open_;   // (local node) whether it has an open side in the set; empty: all nodes are open
};

/// Prescribes the total displacement [m] since the last reset (a geostatic stage resets it to zero).
class DisplacementCondition : public Prescribed {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  void prescribe(double t_old, double t_end, const State& committed, Constraints& to) const override;
  bool drives() const override { return true; }

 private:
  std::array<Function, axis_names.size()> component_;
  std::array<bool, axis_names.size()> given_{};
};

/// Prescribes a velocity [m/s], integrated over each step; optionally with a smooth ramp from rest.
class VelocityCondition : public Prescribed {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  void prescribe(double t_old, double t_end, const State& committed, Constraints& to) const override;
  bool drives() const override { return true; }

 private:
  double ramp(double time) const;
  std::array<Function, axis_names.size()> component_;
  std::array<bool, axis_names.size()> given_{};
  double ramp_time_ = 0, start_ = 0;
};

/// Prescribes zero displacement from the position at the start of the run or at the last reset.
class FixedCondition : public Prescribed {
 public:
  void parameters(Parameters& p);
  void prescribe(double t_old, double t_end, const State& committed, Constraints& to) const override;

 private:
  /// Sums of 1 << direction.
  enum class Components { x = 1, y = 2, xy = 3, z = 4, xz = 5, yz = 6, xyz = 7 };
  Components components_ = Components::xyz;
};

/// Prescribes the pore pressure [Pa], compression positive.
class PorePressureCondition : public Prescribed {
 public:
  void parameters(Parameters& p);
  void prescribe(double t_old, double t_end, const State& committed, Constraints& to) const override;

 protected:
  std::string field_name() const override { return "pore pressure"; }

 private:
  Function value_;
};

/// Prescribes p = unit weight * (water level - height) [Pa] with the node's current height along the direction against
/// gravity. Above the level it prescribes zero, or the suction, or nothing.
class HydrostaticCondition : public Prescribed {
 public:
  void parameters(Parameters& p);
  void bind(const ConditionContext& context, const Section& section) override;
  void prescribe(double t_old, double t_end, const State& committed, Constraints& to) const override;

 protected:
  std::string field_name() const override { return "pore pressure"; }

 private:
  enum class Above { drained, suction, free };
  double unit_weight_ = 9810;
  Above above_ = Above::drained;
  Point up_{};
  Function level_;
};

/// Prescribes any component of any field, e.g. a plugin's temperature.
class ValueCondition : public Prescribed {
 public:
  void parameters(Parameters& p);
  void bind(const ConditionContext& context, const Section& section) override;
  void prescribe(double t_old, double t_end, const State& committed, Constraints& to) const override;

 protected:
  std::string field_name() const override { return name_; }

 private:
  std::string name_;
  int component_ = 0;
  Function value_;
};

}  // namespace mudline
