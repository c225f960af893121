#pragma once

#include "discretisation/byte_stream.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// Writes a whole mesh to bytes or reads it back, without its `contacts`.
inline void transfer_mesh(ByteStream& s, GlobalMesh& mesh) {
  std::size_t blocks = mesh.blocks.size();
  s(blocks);
  mesh.blocks.resize(blocks);
  for (auto& block : mesh.blocks) s(block.region)(block.shape)(block.nodes);
  s(mesh.coordinates)(mesh.side_sets)(mesh.node_sets);
}

}  // namespace mudline
