// The library mudline_gmsh.so: see gmsh_library.hpp.
#include "discretisation/gmsh_curve.hpp"
#include "discretisation/gmsh_library.hpp"
#include "discretisation/gmsh_model.hpp"
#include "discretisation/gmsh_triangulation.hpp"

namespace mudline {

namespace {

struct Gmsh : GmshLibrary {
  Gmsh() { offer_gmsh_library(*this); }
  TaggedMesh read_mesh(const GmshFile& file, int dimension, int order, const SourcePosition& position) const override {
    return read_gmsh_mesh(file, dimension, order, position);
  }
  std::vector<CadCurve> read_curves(const GmshFile& file, const CurveSelection& selection,
                                    const SourcePosition& position) const override {
    return read_gmsh_curves(file, selection, position);
  }
  Triangulation triangulate(const std::vector<Vec<double, 2>>& vertices, const std::vector<OutlinedRegion>& regions,
                            const std::function<double(double x, double y)>& size, double time_limit) const override {
    return triangulate_by_gmsh(vertices, regions, size, time_limit);
  }
  Tetrahedra tetrahedra_in(const std::vector<Point>& vertices, const std::vector<EnclosedRegion>& regions,
                           const std::function<double(const Point&)>& size, double time_limit) const override {
    return tetrahedra_by_gmsh(vertices, regions, size, time_limit);
  }
};

const Gmsh library;

}  // namespace

}  // namespace mudline
