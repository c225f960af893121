#pragma once

#include <Kokkos_Core.hpp>
#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/function.hpp"
#include "core/registry.hpp"
#include "discretisation/shapes.hpp"

namespace mudline {

/// The meaning of a mesh's coordinates. The vertical is y in the plane and z in space.
enum class Geometry { plane_strain, axisymmetric, space };
/// The geometry's name in decks and result files.
const char* name(Geometry geometry);
/// Dimension of a mesh of this geometry: 2 or 3.
int dimension(Geometry geometry);

/// Lowest and highest coordinates [m]; in the plane the third ones are 0.
struct Bounds {
  Point low{}, high{};
  /// Empty bounds, to be widened by enclose().
  static Bounds nothing();
  void enclose(const Point& place);
  /// Longest edge of the box [m].
  double extent() const;
};

/// Pairs of side sets that act on each other (contact): a rank with sides of the first set also gets all nodes of the
/// second.
using SetPairs = std::vector<std::pair<std::string, std::string>>;

/// The side sets that a deck's contacts use, for the distribution of the mesh. Sets that the mesh lacks are ignored.
struct ContactSets {
  SetPairs pairs;
  std::vector<std::string> surfaces;  // side sets that contact works on: their elements cost more
};

/// A whole mesh as a source delivers it, on rank 0 only and only until it is distributed.
struct GlobalMesh {
  struct Block {
    std::string region;  // physical group or "soil"
    CellShape shape;
    std::vector<long long> nodes;  // (element, node) zero-based
  };
  struct Side {
    int block;
    long long element;  // in its block
    int side;
  };
  std::vector<Point> coordinates;
  std::vector<Block> blocks;
  std::map<std::string, std::vector<Side>> side_sets;
  std::map<std::string, std::vector<long long>> node_sets;  // nodes of zero-dimensional groups
  ContactSets contacts;
  /// Dimension of its cells, 2 or 3 (that of the first block; check_mesh() makes sure that all are the same).
  int dimension() const { return blocks.empty() ? 2 : mudline::dimension(blocks.front().shape); }
};

/// Makes a mesh on rank 0. Throws InputError; the caller makes the other ranks throw alike. Every source declares the
/// entry "geometry" of its section by declare_geometry().
class MeshSource {
 public:
  virtual ~MeshSource() = default;
  virtual GlobalMesh generate() const = 0;
  /// The files that the source reads.
  virtual std::vector<std::string> files() const { return {}; }
};

/// The elements of one region and shape on this rank.
struct ElementBlock {
  std::string region;
  CellShape shape;
  int num_elements = 0;
  Kokkos::View<int**, Kokkos::LayoutRight> nodes;  // (element, node) local node numbers
  std::vector<long long> global_ids;               // (element) numbering over all blocks, independent of the rank count
};

struct MeshPart;

/// One side of an element on the boundary.
struct Side {
  int block, element, side;
};

/// This rank's part of the mesh: its elements (each element lives on exactly one rank), and their nodes, owned ones
/// first. Coordinates are those of the source, immutable; the moving geometry is part of the state.
class Mesh {
 public:
  /// Distributes `global` (rank 0's; ignored elsewhere) by METIS. Checks orphan nodes, how elements fit together,
  /// Jacobians at quadrature points and corners, and on an axisymmetric mesh r >= 0. Throws InputError on every rank
  /// alike. Collective.
  Mesh(Teuchos::RCP<const Teuchos::Comm<int>> comm, Geometry geometry, GlobalMesh global);
  /// Builds the mesh from this rank's part of a mesh that has been checked and cut before.
  Mesh(Teuchos::RCP<const Teuchos::Comm<int>> comm, Geometry geometry, MeshPart part);

  const Teuchos::RCP<const Teuchos::Comm<int>>& comm() const { return comm_; }
  Geometry geometry() const { return geometry_; }
  /// Number of coordinates of a node: 2 or 3.
  int dimension() const { return mudline::dimension(geometry_); }

  int num_nodes() const { return static_cast<int>(node_ids_.size()); }
  int num_owned_nodes() const { return num_owned_nodes_; }
  long long num_global_nodes() const { return num_global_nodes_; }
  long long num_global_elements() const { return num_global_elements_; }
  /// Global ids 0..N-1 in the source's numbering, owned nodes first.
  const std::vector<long long>& node_ids() const { return node_ids_; }
  /// (node, dimension) [m]
  const Kokkos::View<double**, Kokkos::LayoutRight>& coordinates() const { return coordinates_; }
  /// Coordinates of one node [m]; in the plane the third one is 0.
  Point place(int node) const;
  /// True for corner nodes, which carry the linear fields. By local node.
  const std::vector<char>& is_vertex() const { return is_vertex_; }

  const std::vector<ElementBlock>& blocks() const { return blocks_; }
  /// The sides of this rank's elements in a named set; sets that are empty here are present.
  const std::map<std::string, std::vector<Side>>& side_sets() const { return side_sets_; }
  const std::map<std::string, std::vector<int>>& node_sets() const { return node_sets_; }
  /// Region names of the whole mesh.
  const std::vector<std::string>& regions() const { return regions_; }

  /// Local nodes (owned and ghost) of a side set or node set, sorted, unique. A node whose side lives only on another
  /// rank is included (the answer is consistent across ranks). Collective at construction, local here.
  const std::vector<int>& nodes_of_set(const std::string& name) const;
  bool has_side_set(const std::string& name) const { return side_sets_.count(name) != 0; }
  bool has_set(const std::string& name) const { return has_side_set(name) || node_sets_.count(name) != 0; }
  /// All side and node set names.
  std::vector<std::string> set_names() const;
  std::vector<std::string> side_set_names() const;

  /// Bounds of the whole mesh and, by name, of each of its regions.
  const Bounds& bounds() const { return bounds_; }
  const std::map<std::string, Bounds>& region_bounds() const { return region_bounds_; }

 private:
  Teuchos::RCP<const Teuchos::Comm<int>> comm_;
  Geometry geometry_;
  std::vector<long long> node_ids_;
  int num_owned_nodes_ = 0;
  long long num_global_nodes_ = 0, num_global_elements_ = 0;
  Kokkos::View<double**, Kokkos::LayoutRight> coordinates_;
  std::vector<char> is_vertex_;
  std::vector<ElementBlock> blocks_;
  std::map<std::string, std::vector<Side>> side_sets_;
  std::map<std::string, std::vector<int>> node_sets_, set_nodes_;
  std::vector<std::string> regions_;
  Bounds bounds_;
  std::map<std::string, Bounds> region_bounds_;
};

/// The mean of a side's corners, in the source's coordinates.
Point middle_of(const Mesh& mesh, const Side& side);

/// Declares the entries that make_mesh reads for every source: "geometry" ("plane strain", "axisymmetric" or
/// "three-dimensional"), which is returned, and "cracks".
Geometry declare_geometry(Parameters& p);

/// Throws InputError "unknown side set 'tpo' (did you mean 'top'?)" at `entry` of `section` unless the mesh has the
/// set.
void require_side_set(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name);
/// The same for a set of sides or points, and for a region.
void require_set(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name);
void require_region(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name);

/// Registers "box", "extruded", "revolved" and, when built with Gmsh, "gmsh".
void register_mesh_sources(Registry<MeshSource>& registry);

/// How to make the mesh, as the deck's section "mesh" says.
class MeshRecipe {
 public:
  /// Throws InputError for wrong entries, on the calling rank only.
  MeshRecipe(const Registry<MeshSource>& sources, const Section& section, ContactSets contacts);
  Geometry geometry() const { return geometry_; }
  const Section& section() const { return section_; }
  const ContactSets& contacts() const { return contacts_; }
  const MeshSource& source() const { return *source_; }
  MeshSource& source() { return *source_; }
  /// Makes and checks the whole mesh; only one rank needs to call it. Throws InputError.
  GlobalMesh make() const;

 private:
  Section section_;
  ContactSets contacts_;
  std::unique_ptr<MeshSource> source_;
  Geometry geometry_ = Geometry::plane_strain;
  std::vector<std::string> cracks_;
};

/// Makes the mesh on rank 0 and distributes it. Throws InputError on every rank alike. Collective.
std::unique_ptr<Mesh> make_mesh(Teuchos::RCP<const Teuchos::Comm<int>> comm, const MeshRecipe& recipe);
/// Makes the mesh that the deck's section "mesh" describes. Throws InputError on every rank alike. Collective.
std::unique_ptr<Mesh> make_mesh(Teuchos::RCP<const Teuchos::Comm<int>> comm, const Registry<MeshSource>& sources,
                                const Section& section, const ContactSets& contacts = {});

}  // namespace mudline
