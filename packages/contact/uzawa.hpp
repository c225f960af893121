#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contact/contact_surface.hpp"
#include "framework/term_faces.hpp"

namespace mudline {

enum class Enforcement { penalty, augmented_lagrangian };

/// Deck entries for the enforcement of a contact's condition; each contact has its own default.
struct EnforcementParameters {
  Enforcement enforcement;
  double penalty = 0, penalty_factor = 10;  // [Pa/m] 0: automatic; [-]
  double gap_tolerance = 0;                 // [m] 0: automatic
  int most_augmentations = 50;
  bool augmented() const { return enforcement == Enforcement::augmented_lagrangian; }
  void parameters(Parameters& p);
  /// Declares the penalties of a surface, "<prefix>penalty" with a row per side: the penalty, and the factor that made
  /// it automatically (0: it is the deck's). Returns the handle.
  static int declare_penalties(StateStore& store, const std::string& prefix, const Mesh& mesh,
                               const std::string& surface);
  /// Sets the rows. An automatic penalty stays as it was when the contact first started a step, unless a restart has
  /// another factor. `stiffness`: of the soil by block and element [Pa].
  void start_penalties(const ContactSurface& surface, const std::function<double(int, int)>& stiffness,
                       const PointView& rows) const;
  /// InputError for two penalties, and for entries that have no meaning with the penalty method.
  void check(const Section& section) const;
};

/// Sums over a rank's sides for Misfit, by local node: stresses less multipliers [N/m], lengths [m], and lengths times
/// penalties [Pa].
struct MisfitSums {
  /// `shears`: components of a shear stress.
  explicit MisfitSums(const Mesh& mesh, int shears = 1)
      : normal(mesh.num_nodes()), lengths(normal), stiffnesses(normal), shear(shears, normal) {}
  void add(int node, double length, double penalty, double normal_sum, const Point& shear_sum);
  std::vector<double> normal, lengths, stiffnesses;
  std::vector<std::vector<double>> shear;  // (component, node)
  double spring = 0;
};

/// Differences between stresses and their multipliers [Pa], by local node of a surface, weighted by the multipliers'
/// shapes. Divided by the penalties they are the gap, and the stretch of the stick springs [m]. Without friction shear
/// and stretch are empty.
struct Misfit {
  std::vector<double> normal, gap, stretch;
  std::vector<std::vector<double>> shear;  // (component, node)
  double spring;  // [m] the deepest penetration that this rank's pressures would need without multipliers

  /// `tangential_factor`: tangential over normal penalty; 0: no friction. Collective.
  Misfit(const ContactSurface& surface, MisfitSums sums, double tangential_factor);
  struct Largest {
    double gap, stretch, spring;  // [m]
  };
  /// Largest values over all ranks. Collective.
  Largest largest(const Comm& comm) const;
};

/// Result of Uzawa's method after `count` augmentations: accepted within the tolerance, refused at the largest allowed
/// number. Empty: the multipliers are to grow by the misfit, and the step is to be solved again. Where the deck gives
/// no tolerance, that of the stretch follows the load: points at the edge of the sticking part alternate between stick
/// and slip, and the misfit that they leave grows with the pressure. Collective.
std::optional<Augmentation> end_of_augmentation(const std::string& contact, const EnforcementParameters& deck,
                                                double gap_tolerance, const Misfit& misfit, int count,
                                                const Comm& comm);

/// Adds to `product` and `lengths`, by local node, the mass matrix of the multipliers' shapes on this rank's sides
/// times `values`, and its row sums.
using ShapeMass =
    std::function<void(const std::vector<double>& values, std::vector<double>& product, std::vector<double>& lengths)>;

/// Nodal values whose field, in the multipliers' shapes, has these weighted means. Collective.
std::vector<double> in_shapes(const ContactSurface& surface, const std::vector<double>& weighted,
                              const ShapeMass& mass);

}  // namespace mudline
