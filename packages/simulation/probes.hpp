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
  /// it. `error`: of the pore pressure [Pa], by element of this rank; null: not asked for. Collective.
  std::vector<HistoryValue> values(const State& state, const std::function<NodalView()>& excess,
                                   const std::vector<double>* error) const;

 private:
  struct NodeProbe {
    std::string name;
    std::vector<int> dof;     // by field: component 0 of the nearest node where this rank owns it, -1
    std::vector<int> around;  // elements of this rank at the nearest node with pore pressure
  };
  /// Of the pore pressure at a node: the mean of the elements around; at an element. Collective.
  double mean_error(const std::vector<int>& elements, const std::vector<double>& error) const;
  /// Of this rank, block after block, in which a node lies.
  std::vector<int> elements_at(long long node) const;
  NodeProbe nearest_node(const ProbeSettings& settings) const;
  Point place(const ProbeSettings& probe, const State& state) const;
  /// One field as the histories name it.
  struct Values {
    std::string name, unit;
    int components;
    bool at_vertices, by_element;  // where its numbers are, if not at all nodes
    std::vector<double> numbers;   // (node or element of mesh_, component)
  };
  /// [m] from a point; of no place far away.
  double distance(const MeshPlace& place, const Point& at, const Positions& x) const;
  /// In this rank's part of the soil: the place nearest to a point that some element surrounds.
  MeshPlace place_in_soil(const Point& at, const PointLocator& locator, const Positions& x) const;
  /// The element that a point lies in, or the nearest place on the boundary: on one rank, none on the others.
  /// Collective.
  MeshPlace find(const Point& at, const Positions& x) const;
  /// Collective.
  void interpolated(const ProbeSettings& probe, const State& state, const std::vector<Values>& fields,
                    const Positions& x, std::vector<HistoryValue>& row) const;
  /// One number for each element, of those for each of this rank. Collective.
  std::vector<double> by_element(const std::vector<double>& own) const;

  const Model& model_;
  double extent_;  // of the mesh [m]
  std::vector<NodeProbe> nodes_;
  std::vector<ProbeSettings> moving_;
  std::unique_ptr<GhostedMesh> mesh_;  // for the moving ones
};

}  // namespace mudline
