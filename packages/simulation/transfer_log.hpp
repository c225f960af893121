#pragma once

#include <string>

#include "simulation/model.hpp"

namespace mudline {

/// Tells what mesh motions and remeshings changed in a run.
class TransferLog {
 public:
  /// Tells it in a line that starts with `begin`, and in one more what it changed in layers. Warns once, where laws
  /// have started anew. `model`: that on the moved or new mesh.
  void tell(const Model& model, const MeshReceipt& receipt, const std::string& begin, void (*tell)(const std::string&));

 private:
  bool warned_ = false;
};

}  // namespace mudline
