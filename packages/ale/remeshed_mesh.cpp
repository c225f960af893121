#include "ale/remeshed_mesh.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "discretisation/mesh_stream.hpp"

namespace mudline {

namespace {

void transfer(ByteStream& s, RemeshedMesh& made) {
  s(made.number)(made.step)(made.focus)(made.faces)(made.sizes);
  transfer_mesh(s, made.mesh);
  std::size_t paths = made.paths.size();
  s(paths);
  made.paths.resize(paths);
  made.origins.resize(paths);
  for (std::size_t p = 0; p < paths; ++p) {
    MeshPath& path = made.paths[p];
    std::vector<std::string> sets(path.sets.begin(), path.sets.end());
    s(path.nodes)(path.stride)(path.outer)(sets);
    path.sets = {sets.begin(), sets.end()};
    s(made.origins[p].shares)(made.origins[p].total);
  }
}

}  // namespace

std::vector<char> RemeshedMesh::bytes() const {
  RemeshedMesh copy = *this;
  ByteStream written;
  transfer(written, copy);
  return written.bytes();
}

RemeshedMesh RemeshedMesh::from_bytes(std::vector<char> bytes) {
  RemeshedMesh result;
  ByteStream stream(std::move(bytes));
  transfer(stream, result);
  return result;
}

RemeshedMesh broadcast(const Teuchos::Comm<int>& comm, RemeshedMesh made) {
  GlobalMesh mesh = std::move(made.mesh);
  made.mesh = {};
  std::vector<char> bytes = made.bytes();
  int length = static_cast<int>(bytes.size());
  Teuchos::broadcast(comm, 0, 1, &length);
  bytes.resize(length);
  Teuchos::broadcast(comm, 0, length, bytes.data());
  made = RemeshedMesh::from_bytes(std::move(bytes));
  if (comm.getRank() == 0) made.mesh = std::move(mesh);
  return made;
}

}  // namespace mudline
