#pragma once

#include <Teuchos_Comm.hpp>

#include <map>
#include <string>
#include <vector>

namespace mudline {

class Mesh;

/// Content of a checkpoint. The names are the same on every rank; `arrays` and `integers` differ in length and content
/// from rank to rank, `scalars` and `texts` are the same everywhere.
struct CheckpointData {
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, std::vector<long long>> integers;
  std::map<std::string, double> scalars;
  std::map<std::string, std::string> texts;
  /// Set only when read. 0: arrays and integers are those that this rank wrote. Otherwise the mesh had another
  /// partition, and they are those of this many ranks, one after the other.
  int ranks = 0;
  bool moved_nodes = false;  // set only when read: the mesh's nodes now have other coordinates
};

/// Figures of a mesh that must agree between the run that wrote a checkpoint and the one that reads it.
struct MeshSignature {
  long long global_nodes = 0, global_elements = 0;
  long long local_nodes = 0, owned_nodes = 0, local_elements = 0;  // of this rank
  long long numbering = 0;                                         // fingerprint of this rank's global ids
  long long topology = 0, coordinates = 0;  // fingerprints of the whole mesh, the same on any number of ranks
};
/// Collective.
MeshSignature signature_of(const Mesh& mesh);

// A checkpoint is one HDF5 file with the committed state of every rank, bit for bit, under a seal (see seal.hpp).
// docs/output_format.md has the layout. `mesh`: that of the run which writes or reads it.

/// Writes under a temporary name and renames: `path` always holds a complete checkpoint, the old one or the new one.
/// Throws RunError on every rank when it cannot be written. Collective.
void write_checkpoint(const Teuchos::Comm<int>& comm, const std::string& path, const MeshSignature& mesh,
                      const CheckpointData& data);
/// Reads the texts alone, whatever the mesh. InputError on every rank alike when the file is missing, is no checkpoint
/// of this format, or is damaged. Collective.
std::map<std::string, std::string> read_checkpoint_texts(const Teuchos::Comm<int>& comm, const std::string& path);
/// Reads one of the integer arrays as all ranks wrote it, whatever the mesh. Rank 0 gets it; the others, and all where
/// there is none, get an empty one. The file's texts must have been read before. Collective.
std::vector<long long> read_checkpoint_integers(const Teuchos::Comm<int>& comm, const std::string& path,
                                                const std::string& name);
/// Reads everything. Each rank gets back what it wrote or, where the ranks or their partition differ, what all ranks
/// wrote. InputError like read_checkpoint_texts(), and when the file belongs to another mesh. Collective.
CheckpointData read_checkpoint(const Teuchos::Comm<int>& comm, const std::string& path, const MeshSignature& mesh);

}  // namespace mudline
