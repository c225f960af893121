#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discretisation/mesh.hpp"
#include "geometry/surface_triangles.hpp"
#include "tensor/rotation.hpp"

namespace mudline {

/// One field of one step. `values`: (owned node, component) or (local element, component; the elements of block 0, then
/// of block 1, ...), row-major. Components: 1 scalar, 2 or 3 vector, 6 symmetric tensor xx yy zz yz xz xy.
struct OutputField {
  std::string name, unit;
  int components;
  std::vector<double> values;
};

/// A rigid body in its reference position, as it is drawn: in space its closed surface, in the plane the points of its
/// contour, without facets.
using BodyOutline = SurfaceTriangles;

/// How a body has moved from its reference position: turned about `centre` (of the reference position) by `turn`,
/// then shifted [m].
struct BodyPose {
  Point shift{};
  Rotation turn{};
  Point centre{};
};

/// What a checkpoint keeps of the files of meshes and steps: their fingerprints, by name ("mesh", "000000").
using FieldMarks = std::map<std::string, std::uint64_t>;

/// Where the fields of a run are continued: after so many steps. `accept_loss`: with those up to `time` [s] that are
/// left, changed or not.
struct FieldRestart {
  long long steps = 0;
  double time = 0;
  bool accept_loss = false;
  FieldMarks marks{};
  bool own = false;  // written by this very process: not looked at again
};

/// The texts that set_metadata gave to the fields of this stem, by name with "_" for what is no letter, digit, "." or
/// "-"; nothing where there are none, or no step of them. Not collective.
std::optional<std::map<std::string, std::string>> metadata_of(const std::string& path_stem);

/// The fields of a run: an HDF5 file for the mesh and one for every step, written by all ranks together in a folder,
/// and beside it an HDF5 file of links to them and an XDMF file for ParaView. Every file is written under a temporary
/// name and renamed when it is complete, so they can be looked at while the run goes on, and a killed run leaves every
/// step that was written. (HDF5 changes a growing file in place: a program killed in the middle of that leaves a file
/// that cannot be read.) Rows are ordered by global ids: nothing depends on the number of ranks. docs/output_format.md
/// has the layout.
///
/// Every member is collective and wants the same names, times and texts on every rank. Errors are thrown alike:
/// RunError for a value that is not finite or a disk that refuses, std::invalid_argument for a wrong call.
class FieldFile {
 public:
  /// Writes path_stem + ".h5", the folder path_stem + ".fields" and, from the first step on, path_stem + ".xdmf".
  /// Without `restart` old files are replaced. With it so many steps stay and later ones go. InputError when the old
  /// file cannot be continued: no result of mudline, of another mesh, or with files missing or changed. `number`: of a
  /// mesh that was made on the way, which the steps from now on have; it comes with a restart only.
  FieldFile(const Mesh& mesh, const std::string& path_stem, std::optional<FieldRestart> restart = {}, int number = 0);
  ~FieldFile();
  FieldFile(const FieldFile&) = delete;
  FieldFile& operator=(const FieldFile&) = delete;

  /// Stores a text under a name ("program", "deck", ...), replacing an earlier one; on disk with the next step.
  void set_metadata(const std::string& name, const std::string& text);

  /// A rigid body, drawn with the soil. Before the first write; after a restart it is given again.
  void add_body(const std::string& name, const BodyOutline& outline);

  /// Appends a step. `coordinates`: (owned node, axis) current [m]; `poses` by body, absent ones rest.
  void write(double time, int step, const std::string& stage, const std::vector<double>& coordinates,
             const std::vector<OutputField>& nodal, const std::vector<OutputField>& cell,
             const std::map<std::string, BodyPose>& poses = {});

  /// Number of steps written so far, those of before a restart included.
  int num_steps() const;
  /// Of the files of these steps and of their meshes.
  const FieldMarks& marks() const;
  /// The files that should be there and are not, or "". Rank 0's business; not collective.
  std::string missing() const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace mudline
