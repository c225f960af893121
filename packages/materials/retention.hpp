#pragma once

#include "core/parameters.hpp"
#include "tensor/dual.hpp"

namespace mudline {

/// How much water soil keeps in its pores under a suction, and how well it still conducts it. Pressures are pore
/// pressures, compression positive; a suction is a negative one. Without a suction the soil is saturated. T: double or
/// a dual number. It is a value that a kernel can hold.
/// Sources: van Genuchten 1980, SSSAJ 44 (with Mualem 1976, WRR 12); Gardner 1958, Soil Science 85.
class Retention {
 public:
  void parameters(Parameters& p);
  /// Whether the material has a section of this kind; otherwise it is saturated at all suctions.
  bool acts() const { return acts_; }
  double reference_suction() const { return reference_suction_; }  // [Pa]

  /// Share of the pores that water fills [-].
  template <class T>
  KOKKOS_INLINE_FUNCTION T saturation(const T& pressure) const {
    if (!sucks(pressure)) return T(1.0);
    return residual_ + (1.0 - residual_) * effective_saturation(pressure);
  }
  /// The part of a pore pressure that acts in the total stress [Pa]: S_e p, with Bishop's factor S_e.
  template <class T>
  KOKKOS_INLINE_FUNCTION T acting(const T& pressure) const {
    if (!sucks(pressure)) return pressure;
    return effective_saturation(pressure) * pressure;
  }
  /// Conductivity over that of saturated soil [-].
  template <class T>
  KOKKOS_INLINE_FUNCTION T relative_permeability(const T& pressure) const {
    if (!sucks(pressure)) return T(1.0);
    const T effective = effective_saturation(pressure);
    T result = effective;
    if (form_ == Form::van_genuchten) {
      const T dry = 1.0 - exponential((shape_ - 1.0) * logarithm(suction_ratio(pressure))) * effective;
      result = exponential(connectivity_ * logarithm(effective)) * dry * dry;
    }
    return value(result) > least_permeability_ ? result : T(least_permeability_);
  }

 private:
  enum class Form {
    van_genuchten,  // S_e = (1 + (s/s_0)^n)^-m, m = 1 - 1/n; k_r = S_e^l (1 - (1 - S_e^(1/m))^m)^2
    exponential     // S_e = k_r = exp(-s/s_0)
  };
  template <class T>
  KOKKOS_INLINE_FUNCTION bool sucks(const T& pressure) const {
    return acts_ && value(pressure) < 0;
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION T suction_ratio(const T& pressure) const {
    return pressure * (-1.0 / reference_suction_);
  }
  /// S_e = (S - S_res)/(1 - S_res) [-] under a suction.
  template <class T>
  KOKKOS_INLINE_FUNCTION T effective_saturation(const T& pressure) const {
    const T ratio = suction_ratio(pressure);
    if (form_ == Form::exponential) return mudline::exponential(-1.0 * ratio);
    const T dried = mudline::exponential(shape_ * logarithm(ratio));
    return mudline::exponential((1.0 / shape_ - 1.0) * logarithm(1.0 + dried));
  }

  bool acts_ = false;
  Form form_ = Form::van_genuchten;
  double reference_suction_ = 1e4, shape_ = 2, residual_ = 0, connectivity_ = 0.5, least_permeability_ = 1e-9;
};

}  // namespace mudline
