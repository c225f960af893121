#pragma once

#include <array>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "ale/face_locator.hpp"
#include "ale/patch_plane.hpp"
#include "ale/path_curve.hpp"
#include "ale/rounded_places.hpp"

namespace mudline {

/// Wanted lengths of the edges of a surface.
struct SurfaceSizes {
  std::vector<double> relative;                                    // (node) read at vertices; linear between them
  std::function<double(double relative, const Point& at)> wanted;  // [m]
};

/// A vertex of a remeshed surface, and its place on the old one.
struct SurfaceVertex {
  Point place{};        // [m] rounded
  double relative = 0;  // see SurfaceSizes
  int node = -1;        // the old vertex that stayed; -1: it moved or is new
  int curve = -1;       // the curve that it is inside of; -1: none
  double s = 0;         // [m] place there, see PathCurve
  SurfacePlace on{};    // set for a new or moved vertex inside a patch
};

struct RemeshedSurface {
  struct Face {
    std::array<int, 3> vertices;  // as seen from outside, like the old ones
    int patch;
  };
  struct OnCurve {
    int vertex;
    double s;  // [m] as in SurfaceVertex
  };
  std::vector<SurfaceVertex> vertices;
  std::vector<Face> faces;
  std::vector<std::vector<OnCurve>> curves;  // (curve) in order, its ends among them
};

/// Remeshes a surface of triangles, patch by patch within the curves between them, by local operations on its faces
/// (Botsch & Kobbelt 2004): edges longer than 4/3 of the wanted length are split, those shorter than 4/5 collapsed,
/// edges flipped where that raises the lower mean ratio of the two faces, and vertices moved towards the middle of the
/// faces around. Vertices stay on the curved old surface, and those of curves on their curve. Fixed nodes
/// and the faces of material patches do not change; neither do edges and faces that are good already. All decisions are
/// made on rounded places and sizes, so that rounding errors do not change the mesh. Serial.
class SurfaceRemesher {
 public:
  /// `x`: of the nodes.
  SurfaceRemesher(const MeshSurfaces& surfaces, const Positions& x, SurfaceSizes sizes);
  SurfaceRemesher(const SurfaceRemesher&) = delete;
  SurfaceRemesher& operator=(const SurfaceRemesher&) = delete;
  RemeshedSurface remesh();

 private:
  using Corners = std::array<int, 3>;
  using Ends = std::pair<int, int>;  // vertices, ascending
  struct Vertex : SurfaceVertex {
    double size = 0;               // wanted [m]
    bool fixed = false;            // it stays
    bool active = false;           // it may move
    std::map<int, Point> normals;  // by patch: normal of the surface here
    std::vector<int> faces;        // empty: it was removed
  };
  struct Face {
    Corners corners;
    int patch;  // -1: it was removed
  };
  struct CurveEdge {
    int curve;
    double low, high;  // s of the lower and of the higher vertex
  };
  struct Curve {
    PathCurve path;
    std::vector<double> relative;  // (point)
    SharedCoordinates shared;
  };
  /// Shape of the worst of some faces.
  struct Shape {
    double quality = 1;  // mean ratio, of the area that faces outwards
    double facing = 1;   // cosine between normals of face and surface
    void take(const Shape& other) {
      quality = std::min(quality, other.quality);
      facing = std::min(facing, other.facing);
    }
  };

  static Ends ends(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  void take_vertices();
  void take_curves();
  void find_normals();
  void resize(Vertex& vertex) const;
  void put_on_patch(Vertex& vertex, int patch, const Point& at) const;
  void put_on_curve(Vertex& vertex, int curve, double s) const;
  Vertex between(int a, int b, const std::vector<int>& around) const;

  double ratio(int a, int b) const;
  Shape shape(const Corners& corners, int patch) const;
  Shape worst_around(int vertex) const;
  std::vector<int> faces_of(int a, int b) const;
  std::vector<int> neighbours(int vertex) const;
  bool keeps_edge(int a, int b, const std::vector<int>& around) const;
  /// Edges by their ratio, longest first.
  std::vector<Ends> edges() const;
  void replace(int face, const Corners& corners);
  void remove(int face);
  void wake(int vertex);
  void wake_poor();

  bool split(int a, int b);
  /// Merges vertex a into b; returns whether it did.
  bool collapse(int a, int b);
  bool may_collapse(int a, int b, const std::vector<int>& around, Shape& after) const;
  bool flip(int a, int b);
  /// Returns whether it moved by more than a hundredth of its size.
  bool improve(int vertex);
  void move(int vertex, double share);
  Point middle_of_faces(int vertex) const;
  int change_edges();
  void flip_edges();
  void smooth();
  RemeshedSurface result() const;

  const MeshSurfaces& surfaces_;
  SurfaceSizes sizes_;
  Rounding rounded_;
  Positions x_;  // rounded
  FaceLocator locator_;
  std::vector<PatchPlane> planes_;  // (patch)
  std::vector<Curve> curves_;
  std::vector<Vertex> vertices_;
  std::vector<Face> faces_;
  std::map<Ends, CurveEdge> curve_edges_;
};

}  // namespace mudline
