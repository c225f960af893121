#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ale/point_locator.hpp"
#include "simulation/model.hpp"
#include "simulation/output/history_file.hpp"
#include "simulation/probe_settings.hpp"

namespace mudline {

/// Histories of the fields at single points: a node of the mesh, a place in space, or a point that travels with a body.
/// The latter two are interpolated in the element they lie in, or in the nearest one where they lie outside the soil.
class Probes {
 public:
  /// Collective.
  Probes(const Model& model, const std::vector<ProbeSettings>& settings);
  /// `excess`: gives the excess pore pressure by overlap dof; called where there is pore fluid and a probe that shows
  /// it. `error`: error of the pore pressure [Pa] by element of this rank; null: not asked for. Collective.
  std::vector<HistoryValue> values(const State& state, const std::function<NodalView()>& excess,
                                   const std::vector<double>* error) const;

 private:
  struct NodeProbe {
    std::string name;
    std::vector<int> dof;     // by field: dof of component 0 at the nearest node; -1: this rank does not own it
    std::vector<int> around;  // elements of this rank at the nearest node with pore pressure
  };
  /// Mean of the pore pressure's error [Pa] over elements, those of all ranks. Collective.
  double mean_error(const std::vector<int>& elements, const std::vector<double>& error) const;
  /// Elements of this rank, numbered block after block, that have the node as a vertex.
  std::vector<int> elements_at(long long node) const;
  NodeProbe nearest_node(const ProbeSettings& settings) const;
  Point place(const ProbeSettings& probe, const State& state) const;
  /// One field as the histories name it.
  struct Values {
    std::string name, unit;
    int components;
    bool at_vertices, by_element;  // where its numbers stand, if not at all nodes
    std::vector<double> numbers;   // (node or element of mesh_, component)
  };
  /// Distance [m] of a place from a point; very large where there is no place.
  double distance(const MeshPlace& place, const Point& at, const Positions& x) const;
  /// Place nearest to a point in an element of this rank that surrounds it; none where no element does.
  MeshPlace place_in_soil(const Point& at, const PointLocator& locator, const Positions& x) const;
  /// Place of a point in the element that it lies in, or the nearest place on the boundary; one rank gets it, the
  /// others none. Collective.
  MeshPlace find(const Point& at, const Positions& x) const;
  /// Collective.
  void interpolated(const ProbeSettings& probe, const State& state, const std::vector<Values>& fields,
                    const Positions& x, std::vector<HistoryValue>& row) const;
  /// Gathers the numbers of this rank's elements to one for each element of mesh_. Collective.
  std::vector<double> by_element(const std::vector<double>& own) const;

  const Model& model_;
  double extent_;  // [m] extent of the mesh
  std::vector<NodeProbe> nodes_;
  std::vector<ProbeSettings> moving_;
  std::unique_ptr<GhostedMesh> mesh_;  // for the moving probes
};

}  // namespace mudline
