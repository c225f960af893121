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

/// Fingerprints of the files of meshes and steps, by name ("mesh", "000000"), as a checkpoint keeps them.
using FieldMarks = std::map<std::string, std::uint64_t>;

/// The fields of a run are continued after `steps` steps. `accept_loss`: after those up to `time` [s] that are left,
/// changed or not.
struct FieldRestart {
  long long steps = 0;
  double time = 0;
  bool accept_loss = false;
  FieldMarks marks{};
  bool own = false;  // the files are those of this process and are not checked again
};

/// The texts that set_metadata gave to the fields of this stem, by name with "_" in place of any other character than
/// letters, digits, "." and "-"; empty where there are none, or no steps. Not collective.
std::optional<std::map<std::string, std::string>> metadata_of(const std::string& path_stem);

/// The fields of a run: an HDF5 file for the mesh and one for every step, written by all ranks together in a folder,
/// and beside it an HDF5 file of links to them and files for ParaView (VTKHDF, XDMF). Every file is written under a
/// temporary name and renamed when it is complete, so they can be looked at while the run goes on, and a killed run
/// leaves every step that was written. (HDF5 changes a growing file in place: a program killed in the middle of that
/// leaves a file that cannot be read.) Rows are ordered by global ids: nothing depends on the number of ranks.
/// docs/output_format.md has the layout.
///
/// Every member is collective and wants the same names, times and texts on every rank. Errors are thrown alike:
/// RunError for a value that is not finite or a disk that refuses, std::invalid_argument for a wrong call.
class FieldFile {
 public:
  /// Writes path_stem + ".h5", the folder path_stem + ".fields" and, from the first step on, path_stem + ".vtkhdf" and
  /// ".xdmf".
  /// Without `restart` old files are replaced. With it the steps that it counts stay and later ones are removed.
  /// InputError when the old file cannot be continued: it is no result of mudline, is of another mesh, or files are
  /// missing or changed. `number`: number of the remeshed mesh of the steps from now on; only with a restart.
  FieldFile(const Mesh& mesh, const std::string& path_stem, std::optional<FieldRestart> restart = {}, int number = 0);
  ~FieldFile();
  FieldFile(const FieldFile&) = delete;
  FieldFile& operator=(const FieldFile&) = delete;

  /// Stores a text under a name ("program", "deck", ...), replacing an earlier one; on disk with the next step.
  void set_metadata(const std::string& name, const std::string& text);

  /// Adds a rigid body, drawn with the soil; to be called before the first write, after a restart too.
  void add_body(const std::string& name, const BodyOutline& outline);

  /// Appends a step. `coordinates`: (owned node, axis) current [m]; `poses` by body, bodies without a pose rest.
  void write(double time, int step, const std::string& stage, const std::vector<double>& coordinates,
             const std::vector<OutputField>& nodal, const std::vector<OutputField>& cell,
             const std::map<std::string, BodyPose>& poses = {});

  /// Brings the files for VTK, which are written now and then, up to the last step.
  void complete();

  /// Number of steps written so far, those of before a restart included.
  int num_steps() const;
  /// Fingerprints of the files of these steps and of their meshes.
  const FieldMarks& marks() const;
  /// The files that should be there and are not, or "". For rank 0; not collective.
  std::string missing() const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace mudline
