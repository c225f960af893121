#pragma once

#include "contact/laws/touching_soil.hpp"
#include "core/registry.hpp"

namespace mudline {

/// Arguments of a friction law.
struct FrictionPoint {
  double normal = 0;  // [Pa] traction on the soil, compression positive; effective or total, see Friction::effective
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

/// Friction law of an interface: type of a contact's "friction". A law has also
///     void parameters(Parameters&);       its own, and interface_parameters()
///     void check(const Section&) const;   [optional] rules across parameters
/// A law is pure: several threads may call it at once. The contact does the rest: below the strength the point sticks
/// (an elastic spring along the surface), at the strength it slides.
class Friction {
 public:
  virtual ~Friction() = default;
  virtual ShearStrength strength(const FrictionPoint& at) const = 0;
  /// Quantities of the touching soil that the strength reads besides `normal`; reads_slip(): whether it reads the path
  /// slid. A quantity that a law does not read may be NaN. A contact that does not know a quantity refuses the law.
  virtual SoilQuantities reads() const { return {}; }
  virtual bool reads_slip() const { return false; }
  /// Stiffness along the surface while sticking, as a multiple of the contact's normal penalty.
  double tangential_factor() const { return tangential_factor_; }
  /// Whether FrictionPoint::normal is the total traction less the pore pressure of the soil at the interface.
  bool effective() const { return traction_ == Traction::effective; }
  /// The same where this soil touches.
  virtual bool effective_on(const TouchingSoil&) const { return effective(); }

 protected:
  /// Declares the parameters that all laws share.
  void interface_parameters(Parameters& p);

 private:
  enum class Traction { effective, total };
  double tangential_factor_ = 1;
  Traction traction_ = Traction::effective;
};

/// Declares the entry "friction" of a contact.
void declare_friction(Parameters& p);

/// Registers "coulomb".
void register_friction(Registry<Friction>& registry);

}  // namespace mudline
