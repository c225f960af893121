#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checks/check.hpp"
#include "simulation/model.hpp"

namespace mudline {

/// Smallest and largest of some values.
struct Span {
  double low = 1e300, high = -1e300;
  void add(double value);
  bool known() const { return high >= low; }
  double length() const { return known() ? high - low : 0; }
  /// Both values; one where they are equal, none where nothing is known.
  std::vector<double> ends() const;
  /// The value that is farther from zero.
  double largest() const { return -low > high ? low : high; }
};

/// A model before its first step, for plausibility checks: entries as the deck gives them, and means over the mesh.
class Setup {
 public:
  /// Collective.
  Setup(Model& model, const Section& deck);

  /// Figures of one material at the start, means over its points; zero where it has none.
  struct SoilMeans {
    double points = 0;
    double shear = 0, modulus = 0;  // [Pa] G, drained constrained modulus
    double wave = 0;                // [m/s] undrained pressure wave
    double density = 0;             // [kg/m3]
    double void_ratio = 0;          // [-]
    double conductivity = 0;        // [m/s]
    double consolidation = 0;       // [m2/s] c_v; 0 without pore fluid
  };
  /// Place and shape of a set of the mesh.
  struct SetFigures {
    std::array<Span, 3> box;  // [m]
    int sides = 0;            // number of sides; 0: a set of nodes
    Point side{};             // [m] mean extent of a side along each axis
    int order = 1;            // of the cells at its sides: 1 linear, 2 quadratic
    Point normal{};  // mean outward normal, of length 1 where the sides lie in a plane; shorter where they do not
  };
  /// One entry of "boundary conditions".
  struct ConditionEntry {
    std::string name, type, set;
    Section entry;
  };

  Model& model() const { return model_; }
  const Section& deck() const { return deck_; }
  const Mesh& mesh() const { return model_.mesh(); }
  int dimension() const { return mesh().dimension(); }
  /// Number of the vertical axis: the last one.
  int vertical() const { return dimension() - 1; }
  double extent(int axis) const { return mesh().bounds().high[axis] - mesh().bounds().low[axis]; }
  /// Largest extent [m] along any axis.
  double longest_extent() const;
  bool porous() const { return model_.soil()->pressure >= 0; }

  std::vector<Section> materials() const { return entries("materials"); }
  std::vector<Section> physics() const { return entries("physics"); }
  const std::vector<ConditionEntry>& conditions() const { return conditions_; }
  std::vector<ConditionEntry> conditions(const Stage& stage) const;
  /// Whether a condition acts in a stage.
  static bool acts(const std::string& condition, const Stage& stage);
  /// Times [s] at which a stage begins and the run ends.
  double begin(std::size_t stage) const { return begins_[stage]; }
  double end() const { return begins_.back(); }

  /// The values of an entry that the deck gives, as a number, a list, or a function over the box of a set, or of the
  /// mesh, and the time from `from` to `to`; not known() where it gives none.
  Span given(const Section& section, const std::string& name, double from, double to,
             const SetFigures* where = nullptr) const;
  Span given(const Section& section, const std::string& name) const { return given(section, name, 0, end()); }
  /// The function of an entry; empty where the deck gives none.
  static std::optional<Function> function(const Section& section, const std::string& name);
  /// Whether a physics of the deck starts from the soil's weight.
  static bool starts_geostatic(const Section& deck);
  /// The word or text of an entry, or the fallback.
  static std::string word(const Section& section, const std::string& name, const std::string& fallback = "");

  /// Whether stresses and loads in another unit would only scale the answer: no weight, no law with a strength.
  bool scales() const;
  /// Means by name of the material.
  const std::map<std::string, SoilMeans>& soils() const { return soils_; }
  /// Means over all soil.
  const SoilMeans& soil() const { return all_; }
  /// Largest size of gravity [m/s2] over the run, with its factor.
  double gravity() const { return gravity_; }
  const Point& gravity_vector() const { return gravity_vector_; }
  /// The deck's entry that gives gravity; empty: none.
  const std::optional<Section>& gravity_entry() const { return gravity_entry_; }
  /// Collective at the first call for a set.
  const SetFigures& set(const std::string& name) const;

 private:
  std::vector<Section> entries(const std::string& collection) const;
  void find_soil();
  void find_gravity();

  Model& model_;
  Section deck_;
  std::vector<double> begins_;
  std::vector<ConditionEntry> conditions_;
  std::map<std::string, SoilMeans> soils_;
  SoilMeans all_;
  double gravity_ = 0;
  Point gravity_vector_{};
  std::optional<Section> gravity_entry_;
  mutable std::map<std::string, SetFigures> sets_;
};

/// The checks of a group; a new one is a line in its list.
std::vector<Check<Setup>> material_checks();
std::vector<Check<Setup>> parameter_checks();
std::vector<Check<Setup>> load_checks();
std::vector<Check<Setup>> domain_checks();
/// The checks of all groups, in the order of their doubts.
std::vector<Check<Setup>> setup_checks();

}  // namespace mudline
