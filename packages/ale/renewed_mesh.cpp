#include "ale/renewed_mesh.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "discretisation/mesh_stream.hpp"

namespace mudline {

namespace {

void transfer(ByteStream& s, RenewedMesh& made) {
  s(made.number)(made.step)(made.focus)(made.faces)(made.source);
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

std::vector<char> RenewedMesh::bytes() const {
  RenewedMesh copy = *this;
  ByteStream written;
  transfer(written, copy);
  return written.bytes();
}

RenewedMesh RenewedMesh::from_bytes(std::vector<char> bytes) {
  RenewedMesh result;
  ByteStream stream(std::move(bytes));
  transfer(stream, result);
  return result;
}

RenewedMesh of_first_rank(const Teuchos::Comm<int>& comm, RenewedMesh made) {
  GlobalMesh mesh = std::move(made.mesh);
  made.mesh = {};
  std::vector<char> bytes = made.bytes();
  int length = static_cast<int>(bytes.size());
  Teuchos::broadcast(comm, 0, 1, &length);
  bytes.resize(length);
  Teuchos::broadcast(comm, 0, length, bytes.data());
  made = RenewedMesh::from_bytes(std::move(bytes));
  if (comm.getRank() == 0) made.mesh = std::move(mesh);
  return made;
}

}  // namespace mudline
