#pragma once

#include <Kokkos_Core.hpp>

#include <cmath>

#include "core/parameters.hpp"
#include "materials/numbers_of_place.hpp"

namespace mudline {

class Permeability;

/// Hydraulic conductivity k of soil as a function of its void ratio e, as a value that a kernel can hold.
struct Conductivity {
  struct Value {
    double k;      // [m/s]
    double dk_de;  // [m/s]
  };
  enum class Form {
    constant,       // k = k0
    kozeny_carman,  // k = k0 c(e)/c(e0) with c(e) = e^3/(1+e); 0 where e is not positive (Carman 1937; Lambe & Whitman
                    // 1969, ch. 19)
    log_linear,     // k = k0 10^((e - e0)/Ck) (Taylor 1948, Fundamentals of Soil Mechanics, ch. 6)
    law             // a law of a plugin, which the host can ask and a device cannot
  };
  Form form = Form::constant;
  double k0 = 1e-9;  // [m/s] at the reference void ratio
  double e0 = 0;     // [-] reference void ratio; 0: the one of the point at the start
  double ck = 0.5;   // [-] change of void ratio for a tenfold conductivity
  const Permeability* asked = nullptr;

  /// Writes the three numbers of the forms: k0, e0, ck.
  void write_numbers(double* values) const {
    values[0] = k0;
    values[1] = e0;
    values[2] = ck;
  }
  /// The same form with other numbers.
  KOKKOS_INLINE_FUNCTION Conductivity with_numbers(const double* values) const {
    Conductivity result = *this;
    result.k0 = values[0];
    result.e0 = values[1];
    result.ck = values[2];
    return result;
  }
  /// `initial_void_ratio`: that of the point at the start.
  KOKKOS_INLINE_FUNCTION Value operator()(double e, double initial_void_ratio) const;
};

/// Hydraulic conductivity k [m/s] of the soil as a function of its void ratio e.
class Permeability {
 public:
  using Value = Conductivity::Value;
  virtual ~Permeability() = default;
  /// `initial_void_ratio`: that of the point at the start, to which reference values refer unless the deck gives one.
  virtual Value conductivity(double void_ratio, double initial_void_ratio) const = 0;
  /// The same law as a value; it is valid as long as this object.
  virtual Conductivity in_kernels() const {
    Conductivity result;
    result.form = Conductivity::Form::law;
    result.asked = this;
    return result;
  }
  /// Whether numbers of the law are functions of the place.
  virtual bool varies() const { return false; }
  /// Writes the numbers of in_kernels() that hold for soil which starts at this place. Returns "" or what is wrong.
  virtual std::string numbers_at(const Point&, double* numbers) const {
    in_kernels().write_numbers(numbers);
    return "";
  }
};

/// A law with one of the forms of Conductivity. Its numbers may be functions of the place.
template <Conductivity::Form form>
class PermeabilityOfForm : public Permeability {
 public:
  PermeabilityOfForm() { law_.form = form; }
  void parameters(Parameters& p) {
    constexpr bool constant = form == Conductivity::Form::constant;
    p.let_vary(&varying_.collected());
    p.required(
        "hydraulic conductivity", law_.k0, "m/s", non_negative(),
        constant ? "Conductivity to the pore fluid at every void ratio" : "Conductivity at the reference void ratio");
    if (form == Conductivity::Form::log_linear)
      p.required("permeability index", law_.ck, "-", positive(), "Ck, change of void ratio for a tenfold conductivity");
    if (!constant)
      p.add("reference void ratio", law_.e0, "-", non_negative(),
            "Void ratio to which the conductivity refers; 0: that of each point at the start");
    p.let_vary(nullptr);
    std::vector<StateVariable> none;
    varying_.settle(&law_, sizeof law_, none);
  }
  bool varies() const override { return !varying_.empty(); }
  std::string numbers_at(const Point& place, double* numbers) const override {
    std::vector<double> values(varying_.size());
    const std::string problem = varying_.at(place, values.data());
    Conductivity here = law_;
    varying_.members().give(here, values.data());
    here.write_numbers(numbers);
    return problem;
  }
  Value conductivity(double void_ratio, double initial_void_ratio) const override {
    return law_(void_ratio, initial_void_ratio);
  }
  Conductivity in_kernels() const override { return law_; }

 private:
  Conductivity law_;
  NumbersOfPlace varying_;
};

KOKKOS_INLINE_FUNCTION Conductivity::Value Conductivity::operator()(double e, double initial_void_ratio) const {
  const double reference = e0 > 0.0 ? e0 : initial_void_ratio;
  switch (form) {
    case Form::constant:
      break;
    case Form::kozeny_carman: {
      if (!(e > 0.0)) return {0.0, 0.0};
      const double factor = k0 * (1.0 + reference) / (reference * reference * reference);
      return {factor * e * e * e / (1.0 + e), factor * e * e * (3.0 + 2.0 * e) / ((1.0 + e) * (1.0 + e))};
    }
    case Form::log_linear: {
      const double rate = std::log(10.0) / ck, k = k0 * std::exp(rate * (e - reference));
      return {k, k * rate};
    }
    case Form::law:
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
      Kokkos::abort("the permeability of a plugin runs on the host only");
#else
      return asked->conductivity(e, initial_void_ratio);
#endif
  }
  return {k0, 0.0};
}

}  // namespace mudline
