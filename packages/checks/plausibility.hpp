#pragma once

#include <string>
#include <vector>

#include "checks/body_path.hpp"
#include "checks/doubts.hpp"
#include "simulation/model.hpp"

namespace mudline {

/// Summarises the physics of a model in a dozen lines, and warns of what is unusual: likely mistakes in units and signs
/// for which a deck cannot be refused. Reads the state before the first step.
class Plausibility {
 public:
  /// Reads "plausibility". InputError, also for bodies whose prescribed path crosses a boundary of regions. Collective.
  Plausibility(Model& model, const Section& deck);
  static EntryDoc document();
  const std::vector<std::string>& doubts() const { return usual_.lines(); }
  /// The usual ranges of all quantities that checks judge, those during a run among them.
  const Doubts& usual() const { return usual_; }
  /// Prints the facts as information and the doubts as warnings.
  void print() const;

 private:
  struct Element;
  struct Load;
  void tell_materials();
  void tell_mesh();
  void tell_body(const BodyPath& path);
  void tell_stages(const Section& deck);
  void doubt_body(const BodyPath& path, const std::string& name);
  void doubt_shape(const BodyPath& path, const std::string& name);
  void doubt_hole(const BodyPath& path, const Positions& positions, const Section& deck);
  std::vector<Load> loads(const Section& deck, std::size_t stage) const;
  /// Largest consolidation time h^2/(6 c_v) [s] of an element at a surface that the stage drains and loads suddenly.
  double pressure_time(const Section& deck, std::size_t stage) const;
  template <class F>
  void for_each_element(F&& f) const;

  Model& model_;
  Doubts usual_;
  double shortest_wave_ = 1e300;  // [s]
  bool stressed_ = false;         // the soil has stresses at the start
  std::vector<std::string> facts_;
};

}  // namespace mudline
