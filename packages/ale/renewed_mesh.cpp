#include "ale/renewed_mesh.hpp"

#include "discretisation/mesh_stream.hpp"

namespace mudline {

namespace {

void transfer(ByteStream& s, RenewedMesh& made) {
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

}  // namespace mudline
