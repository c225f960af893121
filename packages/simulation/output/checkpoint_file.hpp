#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <map>
#include <string>
#include <vector>

namespace mudline {

class Mesh;

/// What a checkpoint holds. The names are the same on every rank; `arrays` and `integers` differ in length and content
/// from rank to rank, `scalars` and `texts` are the same everywhere.
struct CheckpointData {
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, std::vector<long long>> integers;
  std::map<std::string, double> scalars;
  std::map<std::string, std::string> texts;
  /// Only when read. 0: arrays and integers are those that this rank wrote. Else the mesh was partitioned otherwise
  /// then, and they are those of so many ranks, one after the other.
  int ranks = 0;
  bool moved_nodes = false;  // only when read: the source gives the mesh's nodes other coordinates now
};

/// What must agree between the run that wrote a checkpoint and the one that reads it.
struct MeshSignature {
  long long global_nodes = 0, global_elements = 0;
  long long local_nodes = 0, owned_nodes = 0, local_elements = 0;  // of this rank
  long long numbering = 0;                                         // fingerprint of this rank's global ids
  long long topology = 0, coordinates = 0;  // fingerprints of the whole mesh, the same on any number of ranks
};
/// Collective.
MeshSignature signature_of(const Mesh& mesh);

/// One HDF5 file with the committed state of every rank, bit for bit, under a seal (see seal.hpp).
/// docs/output_format.md has the layout.
class CheckpointWriter {
 public:
  CheckpointWriter(Teuchos::RCP<const Teuchos::Comm<int>> comm, const MeshSignature& mesh);
  /// Writes under a temporary name and renames: `path` is the old checkpoint or the new one, never a part.
  /// Throws RunError on every rank when it cannot be written. Collective.
  void write(const std::string& path, const CheckpointData& data) const;

 private:
  Teuchos::RCP<const Teuchos::Comm<int>> comm_;
  MeshSignature mesh_;
};

class CheckpointReader {
 public:
  CheckpointReader(Teuchos::RCP<const Teuchos::Comm<int>> comm, const MeshSignature& mesh);
  /// The texts alone, whatever the mesh. InputError on every rank alike when the file is missing, is no checkpoint of
  /// this format, or is damaged. Collective.
  std::map<std::string, std::string> texts(const std::string& path) const;
  /// One of the integer arrays as all ranks wrote it, whatever the mesh, on rank 0; elsewhere, and where there is none,
  /// nothing. Of a file whose texts were read. Collective.
  std::vector<long long> first_integers(const std::string& path, const std::string& name) const;
  /// Each rank gets back what it wrote or, where ranks or partition are others, what all wrote. InputError like
  /// texts(), and when the file belongs to another mesh. Collective.
  CheckpointData read(const std::string& path) const;

 private:
  void check_seal(const std::string& path) const;

  Teuchos::RCP<const Teuchos::Comm<int>> comm_;
  MeshSignature mesh_;
};

}  // namespace mudline
