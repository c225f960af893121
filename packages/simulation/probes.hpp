#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ale/whole_mesh.hpp"
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
  /// it. Collective.
  std::vector<HistoryValue> values(const State& state, const std::function<NodalView()>& excess) const;

 private:
  struct NodeProbe {
    std::string name;
    std::vector<int> dof;  // by field: component 0 of the nearest node where this rank owns it, -1
  };
  NodeProbe nearest_node(const ProbeSettings& settings) const;
  Point place(const ProbeSettings& probe, const State& state) const;
  /// One field of the whole mesh, as the histories name it.
  struct Values {
    std::string name;
    int field;
    std::vector<double> of_nodes;  // (node, component)
  };
  void interpolated(const ProbeSettings& probe, const State& state, const std::vector<Values>& fields,
                    const Positions& x, std::vector<HistoryValue>& row) const;

  const Model& model_;
  std::vector<NodeProbe> nodes_;
  std::vector<ProbeSettings> moving_;
  std::unique_ptr<WholeMesh> mesh_;  // for the moving ones
};

}  // namespace mudline
