#pragma once

#include <map>
#include <string>
#include <vector>

namespace mudline::xdmf {

/// One attribute as stored in the HDF5 file; components: 1 scalar, 3 vector, 6 symmetric tensor.
struct Field {
  std::string name, unit;
  int components;
};

/// The mesh of a step.
struct StepMesh {
  std::string file = "mesh";  // in the model's folder, without suffix
  long long nodes = 0, elements = 0, topology_length = 0;
};

/// Description of one written step in the XDMF file; the keys are link names in its HDF5 file.
struct Step {
  std::string file;  // in the model's folder, without suffix: "000000"
  double time;
  long long number;
  std::string stage;
  std::map<std::string, Field> nodal, cell;
  StepMesh mesh;
};

struct Body {
  std::string name;
  long long points, triangles;  // triangles 0: a contour in the plane
};

/// Data that stay the same over a run.
struct Model {
  std::string folder;                  // folder of the files of meshes and steps, beside the XDMF file
  std::string index;                   // file beside the XDMF file that holds the triangles of bodies
  StepMesh mesh;                       // the first one
  std::map<std::string, Body> bodies;  // by link name
  /// Path of a file in the folder, relative to the XDMF file.
  std::string path(const std::string& file) const { return folder + "/" + file + ".h5"; }
};

/// The XML of one step.
std::string grid(const Model& model, const Step& step);
/// The whole document around the grids of all steps.
std::string document(const std::string& grids);

}  // namespace mudline::xdmf
