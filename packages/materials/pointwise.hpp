#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>

#include "core/caught_in_kernel.hpp"
#include "core/compiles.hpp"
#include "core/errors.hpp"
#include "materials/numbers_of_place.hpp"
#include "materials/skeleton.hpp"
#include "materials/small_strain.hpp"

namespace mudline {

/// Input of a law's point function. Signs and order as in SkeletonWorkset.
struct SkeletonPoint {
  double stress[6];   // [Pa] committed, rotated
  double strain[6];   // [-] increment
  double void_ratio;  // [-] committed
  double time, dt;    // [s]
  bool want_tangent;
  bool plane = false;  // no shear yz and xz: their rows and columns of the tangent are not read
};

/// Output of a law's point function.
struct SkeletonResponse {
  double stress[6];    // [Pa]
  double tangent[36];  // [Pa] row-major, written when want_tangent
};

// clang-format off
/// Turns a trivially copyable law into a Skeleton: the only loop over points. The law has these members:
///     KOKKOS_FUNCTION bool operator()(const SkeletonPoint&, const double* state_old, double* state,
///                                     SkeletonResponse&) const;
///     static std::vector<StateVariable> state();
///     std::string initialise(const InitialPoint&, double* state) const;
///     ElasticModuli moduli(const double* stress, double void_ratio, const double* state) const;
///     void parameters(Parameters&);
/// It may have these too:
///     void check(const Section&);                          rules across parameters; changes no member
///     static constexpr bool volume_apart = true;           see Skeleton
///     static constexpr bool hardens_with_volume = true;    see Skeleton
///     void prepare();                                      computes constants from the parameters
///     void reduce_strength(double factor);                 divides strengths, before prepare(): Strengths::reducible
///     static constexpr bool no_strength = true;            Strengths::none
///     static constexpr bool small_strain = true;           takes a section "small-strain stiffness"
///     double k0(double ocr) const;
///     double void_ratio(const InitialPoint&) const;
///     SoilState soil_state(const double* stress, double void_ratio, const double* state) const;
///     EarthPressures earth_pressures(double vertical, double height) const;
/// If the operator returns false, the point has failed; the step is then cut.
/// Each number (double) among the parameters may be a function of the place in the deck. Then every member is called
/// with the numbers of its point, after check() and prepare() with them; the law knows nothing of it. Nor does it of
/// small-strain stiffness, which stands between it and its strain, and whose numbers may be functions too.
// clang-format on
template <class Law>
class PointwiseSkeleton : public Skeleton {
  static_assert(std::is_trivially_copyable_v<Law>, "a law is captured by value in kernels");

 public:
  PointwiseSkeleton() : variables_(Law::state()) {}
  explicit PointwiseSkeleton(const Law& law) : law_(law), variables_(Law::state()) { prepare(law_); }
  void parameters(Parameters& p) {
    p.let_vary(&numbers_.collected());
    law_.parameters(p);
    p.let_vary(nullptr);
    numbers_.settle(&law_, sizeof law_, variables_);
    if constexpr (compiles<SmallStrain, Law>)
      if (p.documenting() || p.deck().has_section("small-strain stiffness")) {
        Varying strings{small_strain_, small_numbers_};
        p.section("small-strain stiffness", strings,
                  "shear stiffness at small strain, above that of the law, and its hysteresis");
      }
    if (!small_strain_.acts()) return;
    small_numbers_.settle(&small_strain_, sizeof small_strain_, variables_, "small-strain ");
    strings_ = state_size();
    for (const StateVariable& variable : small_strain_.state()) variables_.push_back(variable);
  }
  void check(const Section& section) {
    if (!numbers_.empty()) return numbers_.keep(section);  // each point is checked at its start
    check(law_, section);
    prepare(law_);
  }
  const std::vector<StateVariable>& state_variables() const override { return variables_; }
  std::string number_out_of_range(const Point& place) const override {
    std::vector<double> values(numbers_.size() + small_numbers_.size());
    const std::string reason = numbers_.at(place, values.data());
    return reason.empty() ? small_numbers_.at(place, values.data()) : reason;
  }
  std::string initialise(const InitialPoint& point, double* state) const override {
    if (small_strain_.acts()) {
      const std::string reason = small_numbers_.at(point.position, state + small_numbers_.members().first);
      if (!reason.empty()) return reason;
      small_strain_of(state).start(state + strings_);
    }
    if (numbers_.empty()) return law_.initialise(point, state);
    double* values = state + numbers_.members().first;
    if (const std::string reason = numbers_.at(point.position, values); !reason.empty()) return reason;
    Law own = law_of(state);
    try {
      check(own, numbers_.section());
    } catch (const InputError& error) {
      return error.what();
    }
    return own.initialise(point, state);
  }
  ElasticModuli moduli(const double* stress, double void_ratio, const double* state) const override {
    ElasticModuli found = law_of(state).moduli(stress, void_ratio, state);
    if (small_strain_.acts()) found.shear *= small_strain_of(state).ratio();
    return found;
  }
  bool volume_apart() const override {
    if constexpr (compiles<VolumeApart, Law>)
      return Law::volume_apart;
    else
      return Skeleton::volume_apart();
  }
  bool hardens_with_volume() const override { return compiles<HardensWithVolume, Law>; }
  Strengths strengths() const override {
    if constexpr (compiles<ReduceStrength, Law>)
      return Strengths::reducible;
    else
      return compiles<NoStrength, Law> ? Strengths::none : Strengths::unknown;
  }
  double k0(const InitialPoint& point) const override {
    if constexpr (compiles<K0, Law>)
      return law_at(point).k0(point.overconsolidation_ratio);
    else
      return Skeleton::k0(point);
  }
  double void_ratio(const InitialPoint& point) const override {
    if constexpr (compiles<VoidRatio, Law>)
      return law_at(point).void_ratio(point);
    else
      return Skeleton::void_ratio(point);
  }
  SoilState soil_state(const double* stress, double void_ratio, const double* state) const override {
    if constexpr (compiles<SoilStateOf, Law>)
      return law_of(state).soil_state(stress, void_ratio, state);
    else
      return Skeleton::soil_state(stress, void_ratio, state);
  }
  std::optional<EarthPressures> earth_pressures(double vertical, const InitialPoint& point) const override {
    if constexpr (compiles<EarthPressuresOf, Law>)
      return law_at(point).earth_pressures(vertical, point.height);
    else
      return Skeleton::earth_pressures(vertical, point);
  }
  int evaluate(const SkeletonWorkset& w) const override {
    const NumbersOfPlace::Members numbers = numbers_.members();
    const double factor = w.strength_factor;
    const Law law = numbers.none() && factor != 1.0 ? with_strength_over(factor, law_) : law_;
    const SmallStrainStiffness small_strain = small_strain_;
    const NumbersOfPlace::Members small_numbers = small_numbers_.members();
    const int strings = strings_;
    int failures = 0;
    CaughtInKernel thrown, *caught = &thrown;
    Kokkos::parallel_reduce(
        "skeleton", Kokkos::RangePolicy<>(0, w.points),
        KOKKOS_LAMBDA(int i, int& sum) {
          SkeletonPoint in;
          for (int c = 0; c < 6; ++c) in.stress[c] = w.stress_old(i, c);
          for (int c = 0; c < 6; ++c) in.strain[c] = w.strain(i, c);
          in.void_ratio = w.void_ratio_old(i, 0);
          in.time = w.time;
          in.dt = w.dt;
          in.want_tangent = w.want_tangent;
          in.plane = w.plane;
          SkeletonResponse out;
          const double* state_old = w.state_old.data() + i * w.state_old.extent(1);
          double* state = w.state.data() + i * w.state.extent(1);
          numbers.keep(state_old, state);
          double by_strain[36];  // derivative of the law's strain
          if (small_strain.acts()) {
            double* const derivative = w.want_tangent ? by_strain : nullptr;
            const double *strain = &w.strain(i, 0), *old = state_old + strings;
            small_numbers.keep(state_old, state);
            if (small_numbers.none())
              small_strain.amplify(strain, old, state + strings, in.strain, derivative);
            else
              with_numbers(small_strain, small_numbers, state_old)
                  .amplify(strain, old, state + strings, in.strain, derivative);
          }
          const bool ok = CaughtInKernel::run(caught, [&] {
            return numbers.none() ? law(in, state_old, state, out)
                                  : with_numbers(law, numbers, state_old, factor)(in, state_old, state, out);
          });
          if (small_strain.acts() && w.want_tangent) chain_rule(by_strain, w.plane, out.tangent);
          if (!ok) {  // a failed point gets its old state, so that nothing undefined spreads
            for (int c = 0; c < 6; ++c) out.stress[c] = in.stress[c];
            for (int c = 0; c < 36; ++c) out.tangent[c] = 0.0;
            for (std::size_t c = 0; c < w.state.extent(1); ++c) state[c] = state_old[c];
          }
          for (int c = 0; c < 6; ++c) w.stress(i, c) = out.stress[c];
          if (w.want_tangent)
            for (int c = 0; c < 36; ++c) w.tangent(i, c) = out.tangent[c];
          w.failed(i) = ok ? 0 : 1;
          sum += ok ? 0 : 1;
        },
        failures);
    thrown.rethrow();
    return failures;
  }
  const Law& law() const { return law_; }

 private:
  // Members that a law may have, besides OwnCheck.
  template <class T>
  using Prepare = decltype(std::declval<T&>().prepare());
  template <class T>
  using VolumeApart = decltype(T::volume_apart);
  template <class T>
  using HardensWithVolume = std::enable_if_t<T::hardens_with_volume>;
  template <class T>
  using ReduceStrength = decltype(std::declval<T&>().reduce_strength(1.0));
  template <class T>
  using NoStrength = decltype(T::no_strength);
  template <class T>
  using SmallStrain = decltype(T::small_strain);
  template <class T>
  using K0 = decltype(std::declval<const T&>().k0(1.0));
  template <class T>
  using VoidRatio = decltype(std::declval<const T&>().void_ratio(std::declval<const InitialPoint&>()));
  template <class T>
  using SoilStateOf = decltype(std::declval<const T&>().soil_state(nullptr, 1.0, nullptr));
  template <class T>
  using EarthPressuresOf = decltype(std::declval<const T&>().earth_pressures(1.0, 1.0));

  /// Lets the numbers of a section be functions of the place.
  struct Varying {
    SmallStrainStiffness& stiffness;
    NumbersOfPlace& numbers;
    void parameters(Parameters& p) {
      p.let_vary(&numbers.collected());
      stiffness.parameters(p);
      p.let_vary(nullptr);
    }
  };
  static void check(Law& law, const Section& section) {
    if constexpr (compiles<OwnCheck, Law>) law.check(section);
  }
  template <class Any>
  static void prepare(Any& law) {
    if constexpr (compiles<Prepare, Any>) law.prepare();
  }
  /// Turns the derivative by the law's strain into that by the strain.
  static KOKKOS_INLINE_FUNCTION void chain_rule(const double* by_strain, bool plane, double* tangent) {
    for (int row = 0; row < 36; row += 6) {
      double by_law[6];
      for (int k = 0; k < 6; ++k) by_law[k] = plane && (k == 3 || k == 4) ? 0.0 : tangent[row + k];
      for (int c = 0; c < 6; ++c) {
        tangent[row + c] = 0.0;
        for (int k = 0; k < 6; ++k) tangent[row + c] += by_law[k] * by_strain[6 * k + c];
      }
    }
  }
  /// The law with its strengths divided by a factor.
  static Law with_strength_over(double factor, Law law) {
    if constexpr (compiles<ReduceStrength, Law>) law.reduce_strength(factor);
    prepare(law);
    return law;
  }
  /// The law, or small-strain stiffness, with the numbers of a point, which stand in its state, and with its strengths
  /// divided by a factor.
  template <class Any>
  static KOKKOS_INLINE_FUNCTION Any with_numbers(const Any& law, const NumbersOfPlace::Members& numbers,
                                                 const double* state, double factor = 1.0) {
    Any own = law;
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
    Kokkos::abort("numbers of a law that are functions of the place are for the host only");
#else
    numbers.give(own, state);
    if constexpr (std::is_same_v<Any, Law>)
      if (factor != 1.0) return with_strength_over(factor, own);
    prepare(own);
#endif
    return own;
  }
  Law law_of(const double* state) const {
    return numbers_.empty() ? law_ : with_numbers(law_, numbers_.members(), state);
  }
  SmallStrainStiffness small_strain_of(const double* state) const {
    return small_numbers_.empty() ? small_strain_ : with_numbers(small_strain_, small_numbers_.members(), state);
  }
  /// The law of a point that has no state yet. See number_out_of_range().
  Law law_at(const InitialPoint& point) const {
    if (numbers_.empty()) return law_;
    std::vector<double> state(state_size());
    numbers_.at(point.position, state.data() + numbers_.members().first);
    return law_of(state.data());
  }

  Law law_{};
  std::vector<StateVariable> variables_;
  NumbersOfPlace numbers_;
  SmallStrainStiffness small_strain_;
  NumbersOfPlace small_numbers_;
  int strings_ = 0;  // column of its state
};

}  // namespace mudline
