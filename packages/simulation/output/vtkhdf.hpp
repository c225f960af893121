#pragma once

// Includes hdf5.h; included by the .cpp files of this folder only.
#include <string>
#include <vector>

#include "geometry/surface_triangles.hpp"
#include "simulation/output/hdf5_tools.hpp"
#include "simulation/output/xdmf.hpp"

/// Files of VTK's own format, VTKHDF 2.0: an unstructured grid with a table of times. They hold no values but link to
/// the files of meshes and steps through virtual datasets, so that they stay small.
/// Source: docs.vtk.org, VTKHDF format specification.
namespace mudline::vtkhdf {

/// Writes the soil of all steps; after a remeshing steps have grids of their own. `regions`: names by number.
void write_soil(hid_t file, const xdmf::Model& model, const std::vector<xdmf::Step>& steps,
                const std::vector<std::string>& regions);

/// Writes a body of all steps, under its link name, for a file in the folder of the steps: its triangles, or where it
/// has none, in the plane, a line through its points.
void write_body(hid_t file, const std::string& link, const SurfaceTriangles& outline,
                const std::vector<xdmf::Step>& steps);

}  // namespace mudline::vtkhdf
