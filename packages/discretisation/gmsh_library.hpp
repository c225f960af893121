#pragma once

#include <string>
#include <vector>

#include "discretisation/cad_curve.hpp"
#include "discretisation/gmsh_file.hpp"
#include "discretisation/source_position.hpp"
#include "discretisation/tagged_mesh.hpp"
#include "discretisation/triangulation.hpp"

namespace mudline {

/// What the program asks of Gmsh. The one class that does it is in a library of its own, mudline_gmsh.so, which is
/// loaded when it is first needed: loading Gmsh takes longer than most commands, and a program without Gmsh is one
/// without that file. Every function runs Gmsh in a process of its own.
class GmshLibrary {
 public:
  virtual ~GmshLibrary() = default;
  virtual TaggedMesh read_mesh(const GmshFile& file, int dimension, int order,
                               const SourcePosition& position) const = 0;
  virtual std::vector<CadCurve> read_curves(const GmshFile& file, const CurveSelection& selection,
                                            const SourcePosition& position) const = 0;
  virtual Triangulation triangulate(const std::vector<Vec<double, 2>>& vertices,
                                    const std::vector<OutlinedRegion>& regions,
                                    const std::function<double(double x, double y)>& size, double time_limit) const = 0;
  virtual Tetrahedra tetrahedra_in(const std::vector<Point>& vertices, const std::vector<EnclosedRegion>& regions,
                                   const std::function<double(const Point&)>& size, double time_limit) const = 0;
};

/// Whether the program has the library. It is not loaded for that.
bool has_gmsh();

/// Says that something needs Gmsh, for a program without it.
std::string needs_gmsh(const std::string& what);

/// The library, loaded where that is not done yet; null: there is none, and `why` is the reason.
const GmshLibrary* find_gmsh_library(std::string& why);

/// The same for a file of the deck: throws InputError at its entry "file" where there is no library.
const GmshLibrary& gmsh_library(const SourcePosition& position);

/// Refuses a type that needs Gmsh, where it stands in the deck, in a program that was built without.
void refuse_without_gmsh(const Parameters& p);

/// The library calls this when it is loaded.
void offer_gmsh_library(const GmshLibrary& library);

}  // namespace mudline
