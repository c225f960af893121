#pragma once

// Index of a run's fields; used by field_file.cpp only.
#include <map>
#include <string>
#include <vector>

#include "geometry/surface_triangles.hpp"
#include "simulation/output/xdmf.hpp"

namespace mudline {

/// The small files through which the steps of a run are found: <stem>.h5, whose links lead to the files of the mesh and
/// of the steps in the folder <stem>.fields; <stem>.xdmf; and <stem>.vtkhdf, with a <body>.vtkhdf in the folder for
/// each body. They are written whole under a temporary name and renamed, so that a killed run leaves the old ones or
/// the new ones. Nothing here is collective: every rank holds an index, and that of rank 0 writes.
struct FieldIndex {
  FieldIndex(const std::string& stem, bool writer);

  /// Paths of the index, of the folder, and of the files in it, by name, mesh or step; and the name of a step,
  /// "000010".
  std::string path() const { return stem + ".h5"; }
  std::string folder() const { return stem + ".fields"; }
  std::string file_path(const std::string& name) const { return folder() + "/" + name + ".h5"; }
  std::string mesh_path(int number) const { return file_path(mesh_name(number)); }
  std::string step_path(std::size_t step) const { return file_path(step_name(step)); }
  static std::string step_name(std::size_t step);
  /// Name of a mesh: "mesh", and "mesh_001" and so on after remeshings.
  static std::string mesh_name(int number);

  /// Reads the index of an earlier run, without its steps. InputError when it is not one or its first mesh is another
  /// than `first` (null: any). Returns the number of steps that it names.
  std::size_t read(const xdmf::StepMesh* first);

  /// Adds a body under its link name, or gives it another outline.
  void add_body(const std::string& link, const std::string& name, const SurfaceTriangles& outline);

  /// Adds a complete step.
  void append(const xdmf::Step& step);

  /// Writes the files, if it is the writer; without steps that of links alone. The time that those for VTK take grows
  /// with the number of steps; they are written when it has grown by a tenth, or where they are to be `complete`.
  /// Returns what went wrong, "" when nothing did.
  std::string write(bool complete = false);

  /// The first missing file, or "": of the index, and of those of the first mesh and of the steps.
  std::string missing() const;

  /// Remove the files of the index and all steps, or the steps from `first` on.
  void remove_files() const;
  void remove_steps(std::size_t first) const;

  std::string stem, geometry;
  xdmf::Model model;
  std::vector<std::string> regions;                  // names by number
  std::map<std::string, std::string> metadata;       // by link name
  std::map<std::string, SurfaceTriangles> outlines;  // by link name, in the reference position; no facets in the plane
  std::size_t steps = 0;

 private:
  std::string vtk_path() const { return stem + ".vtkhdf"; }
  std::string vtk_path(const std::string& body) const { return folder() + "/" + body + ".vtkhdf"; }
  std::string write_for_vtk();
  void remove_for_vtk() const;

  bool writer_, for_vtk_ = true;     // false: a mesh was written by an earlier version, which left no cells for VTK
  std::size_t vtk_steps_ = 0;        // steps in the files for VTK that this object wrote
  std::vector<xdmf::Step> written_;  // kept by the writer, as is the XML of these steps
  std::string grids_;
};

}  // namespace mudline
