#pragma once

#include "contact/laws/pointwise_law.hpp"
#include "contact/laws/touching_soil.hpp"
#include "core/registry.hpp"

namespace mudline {

/// Where and when a friction law is asked.
struct FrictionPoint {
  double normal = 0;  // [Pa] traction on the soil, compression positive; effective or total, as the law wants it
  Point position{};   // [m] of the contact point at the start of the step
  double slip = 0;    // [m] path that it has slid so far, at the start of the step; see Friction::reads_slip
  double time = 0;    // [s] end of the step
  double rate = 0;    // [m/s] mean speed along the surface in the step, >= 0
  TouchingSoil soil;  // see Friction::reads
};

/// Largest shear stress that an interface carries.
struct ShearStrength {
  double value;           // [Pa] >= 0
  double slope;           // [-] d value / d normal
  double rate_slope = 0;  // [Pa s/m] d value / d rate
  double pore_slope = 0;  // [-] d value / d pore pressure, at the same normal
};

/// Friction law of an interface: type of a contact's "friction". Pure. The contact does the rest: below the strength
/// the point sticks (an elastic spring along the surface), at the strength it slides.
class Friction {
 public:
  virtual ~Friction() = default;
  virtual ShearStrength strength(const FrictionPoint& at) const = 0;
  /// The same at many points: on the host, one after the other, unless the law says otherwise as PointwiseFriction
  /// does.
  virtual void strengths(const LawList<FrictionPoint, ShearStrength>& list) const {
    ask_on_host([this](const FrictionPoint& at) { return strength(at); }, list);
  }
  /// What the strength reads of the soil that touches, besides `normal`, and whether it reads the path slid. What a law
  /// does not ask for may be no number; a contact that cannot tell it refuses the law.
  virtual SoilQuantities reads() const { return {}; }
  virtual bool reads_slip() const { return false; }
  /// Stiffness along the surface while sticking, as a multiple of the contact's normal penalty.
  double tangential_factor() const { return tangential_factor_; }
  /// Whether FrictionPoint::normal is the total traction less the pore pressure of the soil at the interface.
  bool effective() const { return traction_ == Traction::effective; }

 protected:
  /// Declares what all laws share.
  void interface_parameters(Parameters& p);

 private:
  enum class Traction { effective, total };
  double tangential_factor_ = 1;
  Traction traction_ = Traction::effective;
};

/// Turns a trivially copyable law with
///     void parameters(Parameters&);
///     KOKKOS_FUNCTION ShearStrength operator()(const FrictionPoint&) const;
///     void check(const Section&) const;        [optional] rules across parameters
///     static constexpr SoilQuantities reads;   [optional]
///     static constexpr bool reads_slip = true; [optional]
/// into a Friction that is asked in kernels.
template <class Law>
class PointwiseFriction : public Friction {
 public:
  void parameters(Parameters& p) {
    law_.parameters(p);
    interface_parameters(p);
  }
  void check(const Section& section) const {
    if constexpr (detail::has_check<const Law>::value) law_.check(section);
  }
  ShearStrength strength(const FrictionPoint& at) const override { return law_(at); }
  void strengths(const LawList<FrictionPoint, ShearStrength>& list) const override { ask_in_kernel(law_, list); }
  SoilQuantities reads() const override { return reads_of<Law>(0); }
  bool reads_slip() const override { return reads_slip_of<Law>(0); }

 private:
  template <class L>
  static auto reads_of(int) -> decltype(SoilQuantities(L::reads)) {
    return L::reads;
  }
  template <class L>
  static SoilQuantities reads_of(...) {
    return {};
  }
  template <class L>
  static auto reads_slip_of(int) -> decltype(bool(L::reads_slip)) {
    return L::reads_slip;
  }
  template <class L>
  static bool reads_slip_of(...) {
    return false;
  }
  Law law_;
};

/// strength = adhesion min(1, <normal> / full adhesion at) + coefficient <normal>, at most the cap. With a kinetic
/// coefficient the coefficient follows the speed, kinetic + (coefficient - kinetic) exp(-rate / decay speed).
struct CoulombStrength {
  double coefficient = 0, adhesion = 0, kinetic = 0;
  double full_adhesion_at = 0;  // [Pa] normal traction; 0: the adhesion is there as soon as the surface touches
  double decay_speed = 0;       // [m/s] 0: one coefficient at all speeds
  double cap = 0;               // [Pa] one for all points
  bool capped = false;
  KOKKOS_FUNCTION ShearStrength operator()(const FrictionPoint& at) const;
};
class CoulombFriction : public Friction {
 public:
  void parameters(Parameters& p);
  void check(const Section& section) const;
  ShearStrength strength(const FrictionPoint& at) const override;
  /// In a kernel, unless the cap is a function that has to be evaluated.
  void strengths(const LawList<FrictionPoint, ShearStrength>& list) const override;

 private:
  CoulombStrength law_;
  Function cap_;
};

/// The entry "friction" of a contact.
void declare_friction(Parameters& p);

/// "coulomb"; a plain list.
void register_friction(Registry<Friction>& registry);

}  // namespace mudline
