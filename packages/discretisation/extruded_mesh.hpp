#pragma once

#include <string>
#include <vector>

#include "discretisation/sweep.hpp"

namespace mudline {

/// A plane mesh swept along a straight line: a plan drawn upwards, or an upright section drawn across.
class ExtrudedMesh : public MeshSource {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  GlobalMesh generate() const override;
  std::vector<std::string> files() const override { return plane_.files(); }

 private:
  enum class Along { z, y };
  Geometry geometry_ = Geometry::space;
  Along along_ = Along::z;
  double length_ = 0, from_ = 0, grading_ = 1;
  int layers_ = 1;
  PlaneMesh plane_;
};

}  // namespace mudline
