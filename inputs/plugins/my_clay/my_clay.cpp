// A user-defined skeleton law: hypoelastic, with stiffnesses that grow with the square root of the mean effective
// stress,
//
//     K = K_ref sqrt(p'/p_ref),   G = K 3 (1 - 2 nu) / (2 (1 + nu)),
//
// as small-strain measurements on sands and silts suggest. Along a straight strain path sqrt(p') is linear in the
// volume strain, so that the update below is the exact integral: any step size gives the same stress.
#include <cmath>

#include "materials/pointwise.hpp"
#include "simulation/plugin.hpp"

namespace {

struct MyClay {
  double bulk_modulus = 1e7;        // [Pa] at the reference stress
  double poisson = 0.25;            // [-]
  double reference_stress = 100e3;  // [Pa]

  void parameters(mudline::Parameters& p) {
    p.required("bulk modulus", bulk_modulus, "Pa", mudline::positive(), "Drained bulk modulus at the reference stress");
    p.add("Poisson's ratio", poisson, "-", mudline::half_open(0, 0.5),
          "Constant drained ratio, gives the shear modulus");
    p.add("reference stress", reference_stress, "Pa", mudline::positive(),
          "Mean effective stress at which the bulk modulus was measured");
  }
  static std::vector<mudline::StateVariable> state() { return {}; }  // stress and void ratio are stored anyway

  std::string initialise(const mudline::InitialPoint& point, double*) const {
    return mean(point.stress.data()) > 0 ? "" : "my clay needs a compressive initial stress";
  }
  mudline::ElasticModuli moduli(const double* stress, double, const double*) const {
    const double bulk = bulk_modulus * std::sqrt(std::fmax(mean(stress), 0.0) / reference_stress);
    return {bulk, bulk * shear_ratio()};
  }

  /// Tension positive, order xx yy zz yz xz xy, engineering shear strains. Returning false makes the step fail, and it
  /// is cut.
  KOKKOS_FUNCTION bool operator()(const mudline::SkeletonPoint& in, const double*, double*,
                                  mudline::SkeletonResponse& out) const {
    const double p_old = mean(in.stress), compression = -(in.strain[0] + in.strain[1] + in.strain[2]);
    if (p_old <= 0) return false;
    const double slope = 0.5 * bulk_modulus / std::sqrt(reference_stress);  // d sqrt(p') / d volume strain
    const double root_old = std::sqrt(p_old), root = root_old + slope * compression;
    if (root <= 0) return false;
    const double p = root * root;
    const double two_g = shear_ratio() * 2 * slope * (root_old + root);  // twice the mean shear modulus of the step
    double deviator[6];                                                  // deviatoric strain, tensor shear components
    for (int i = 0; i < 6; ++i) {
      const bool normal = i < 3;
      deviator[i] = normal ? in.strain[i] + compression / 3 : 0.5 * in.strain[i];
      out.stress[i] = in.stress[i] + (normal ? p_old - p : 0.0) + two_g * deviator[i];
    }
    if (!in.want_tangent) return true;
    const double bulk = 2 * root * slope, stiffening = shear_ratio() * 2 * slope * slope;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        double d = i == j ? (i < 3 ? two_g : 0.5 * two_g) : 0.0;
        if (j < 3) d -= stiffening * deviator[i];  // compression stiffens in shear
        if (i < 3 && j < 3) d += bulk - two_g / 3;
        out.tangent[6 * i + j] = d;
      }
    return true;
  }

 private:
  KOKKOS_FUNCTION static double mean(const double* s) { return -(s[0] + s[1] + s[2]) / 3; }
  KOKKOS_FUNCTION double shear_ratio() const { return 1.5 * (1 - 2 * poisson) / (1 + poisson); }
};

}  // namespace

MUDLINE_PLUGIN(registries) {
  registries.skeletons.add<mudline::PointwiseSkeleton<MyClay>>(
      "my clay", "Hypoelastic, stiffness with the root of the mean stress");
}
