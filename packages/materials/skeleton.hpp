#pragma once

#include <Kokkos_Core.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/function.hpp"
#include "core/parameters.hpp"

namespace mudline {

/// How a variable goes to another mesh, or to the same mesh after it has moved.
enum class Transfer {
  value,    // as a field: linear ones are exact, and values stay near those around
  mass,     // void ratio of quadrature points: as a field, then the grains that were lost by it are put back
  total,    // every row holds a part of a sum, and the sum is kept
  nearest,  // that of the nearest old row: flags, numbers of things
};

/// A named state variable of a law or of another array, for transfer and output.
struct StateVariable {
  std::string name;
  int components;  // of a law 1, or 6 for a symmetric tensor (xx yy zz yz xz xy) that rotates with the material
  std::string unit;
  Transfer transfer = Transfer::value;
  double low = -1e300, high = 1e300;  // physical bounds
  bool in_fixed_axes = false;         // a component along fixed axes, which is not invariant under rotation
  bool hidden = false;                // not written to output
};

/// Point data: one row per quadrature point. Rows are contiguous on the host.
using PointView = Kokkos::View<double**, Kokkos::LayoutRight>;
using ConstPointView = Kokkos::View<const double**, Kokkos::LayoutRight>;

/// The next increment from a state, with the counters of other programs' laws.
struct Increment {
  int stage = 1, number = 1;  // both from 1; the number within its stage
  double stage_start = 0;     // [s]
};

/// Columns of SkeletonWorkset::surroundings: data of a point besides its strain, for laws that ask for them. Unknown
/// values are NaN.
struct Surroundings {
  static constexpr int place = 0,  // [m] x, y, z at the end of the step; 0 out of the plane
      deformation = 3,             // [-] row-major 3 x 3: deformation gradient of the step
      rotation = deformation + 9,  // [-] row-major 3 x 3: rotation that was applied to stress and state tensors
      temperature = rotation + 9,  // [degC] at the start of the step, and its change
      length = temperature + 2,    // [m] element length: root of its area or cube root of its volume, over the order
      element = length + 1,        // number from 1, the same on any number of ranks
      point = element + 1,         // number from 1 within the element
      size = point + 1;
};

/// Input and output of a skeleton law for a batch of points. Stress and strain: tension positive, order xx yy zz yz xz
/// xy, engineering shear strain. Plane strain: zz out of plane. Axisymmetric: xx = rr, yy = axial, zz = hoop.
struct SkeletonWorkset {
  int points;
  double time;  // [s] end of the step
  double dt;    // [s] 0 in a geostatic stage or after a transfer to another mesh
  bool want_tangent;
  ConstPointView stress_old;  // (points, 6) [Pa] committed effective stress, already rotated into the new configuration
  ConstPointView strain;      // (points, 6) [-] objective strain increment of the step
  ConstPointView void_ratio_old;  // (points, 1) [-] committed
  ConstPointView state_old;       // (points, n) committed, tensors already rotated
  PointView stress;               // (points, 6) [Pa] out
  PointView state;                // (points, n) out
  PointView tangent;              // (points, 36) [Pa] out, row-major d stress_i / d strain_j, if want_tangent
  Kokkos::View<int*> failed;      // (points) out: 1 where the law found no admissible state
  bool plane = false;             // no shear yz and xz: their rows and columns of the tangent are not read
  Increment increment = {};
  ConstPointView surroundings = {};  // (points, Surroundings::size) if Skeleton::wants_surroundings(), else empty
  double strength_factor = 1;        // [-] by which a law with Strengths::reducible divides its strengths
};

/// Bulk and shear modulus [Pa] of the elastic response: wave speeds, penalties, preconditioners.
struct ElasticModuli {
  double bulk, shear;
};

/// State of a point in terms of soil mechanics; empty where the law has no such quantity.
struct SoilState {
  /// s_u [Pa], at present: half the largest stress difference, or the shear stress in simple shear of a law that has
  /// one strength in all directions.
  std::optional<double> undrained_strength;
  std::optional<double> overconsolidation_ratio;  // [-] size of the yield surface over that through the stress
};

/// The horizontal effective stresses [Pa], compression positive, between which the strength allows a point at rest.
struct EarthPressures {
  double active, passive;
};

/// Initial data of a material point.
struct InitialPoint {
  Point position;                        // [m]
  std::array<double, 6> stress;          // [Pa] effective, tension positive
  double void_ratio;                     // [-]
  double overconsolidation_ratio = 1.0;  // [-] scales the yield surface through the initial stress
  double height = 0.0;                   // [m] of the position, counted against gravity
  int element = 0, number = 0;           // of the element and of the point in it, from 1; 0: not known
};

/// Whether a law has strengths, and can divide them by a factor (SkeletonWorkset::strength_factor).
enum class Strengths { unknown, none, reducible };

/// Effective-stress law of the soil skeleton; works on whole batches of points, pure: old in, new out, no memory.
class Skeleton {
 public:
  virtual ~Skeleton() = default;
  virtual const std::vector<StateVariable>& state_variables() const = 0;
  /// Total number of state components.
  int state_size() const {
    int n = 0;
    for (const auto& v : state_variables()) n += v.components;
    return n;
  }
  /// "" or which number of the law, a function of the place, is out of its range here.
  virtual std::string number_out_of_range(const Point&) const { return ""; }
  /// Whether the law itself says with which effective stress a point starts (find_stress).
  virtual bool gives_stress() const { return false; }
  /// Sets the effective stress of a point at the start, if gives_stress(). Returns "" or the problem.
  virtual std::string find_stress(InitialPoint&) const { return ""; }
  /// Fills `state` (state_size values). Returns "" or the reason why the law cannot start from this point.
  virtual std::string initialise(const InitialPoint& point, double* state) const = 0;
  /// Whether volume and shear are apart: the mean stress follows the volume strain alone, does not act on stiffness and
  /// strength in shear, and yielding does not change the volume.
  virtual bool volume_apart() const { return false; }
  /// Whether its volume strain hardens the soil for good, so that an error of it stays in strength and stress.
  virtual bool hardens_with_volume() const { return false; }
  virtual Strengths strengths() const { return Strengths::unknown; }
  /// Whether the law reads SkeletonWorkset::surroundings, which cost time to fill.
  virtual bool wants_surroundings() const { return false; }
  /// Updates all points; returns the number of failed ones (flags in workset.failed).
  virtual int evaluate(const SkeletonWorkset& workset) const = 0;
  virtual ElasticModuli moduli(const double* stress, double void_ratio, const double* state) const = 0;
  /// Earth pressure coefficient at rest that the law itself implies for the point's overconsolidation ratio, without
  /// reading its stress; negative: none.
  virtual double k0(const InitialPoint&) const { return -1.0; }
  virtual SoilState soil_state(const double* stress, double void_ratio, const double* state) const { return {}; }
  /// Earth pressures at a vertical effective stress [Pa] (compression positive), the same in all horizontal directions,
  /// without reading the point's stress; empty for a law without strength.
  virtual std::optional<EarthPressures> earth_pressures(double vertical, const InitialPoint& point) const { return {}; }
  /// Void ratio [-] that the law itself implies for a start with this stress and overconsolidation ratio (the point's
  /// void ratio is not read), or `no_void_ratio`.
  virtual double void_ratio(const InitialPoint&) const { return no_void_ratio; }
  static constexpr double no_void_ratio = -1e300;
};

}  // namespace mudline
