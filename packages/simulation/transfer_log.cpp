#include "simulation/transfer_log.hpp"

#include <algorithm>
#include <cstdio>

#include "core/log.hpp"
#include "core/told.hpp"

namespace mudline {

namespace {

/// Text on what a transfer changed in the layers.
std::string layers_text(const Model& model, const MeshReceipt& receipt) {
  std::string text = "    layers: points of another material " + std::to_string(receipt.changed) +
                     ", laws started anew " + std::to_string(receipt.started) + "; grains restored";
  const auto& materials = model.soil()->materials;
  for (std::size_t k = 0; k < materials.size(); ++k)
    text += (k > 0 ? ", " : " ") + materials[k]->name +
            told(receipt.restored_grains[k] / std::max(receipt.before.grains[k], 1e-300), " %+.1e");
  return text;
}

}  // namespace

void TransferLog::tell(const Model& model, const MeshReceipt& receipt, const std::string& begin,
                       void (*tell)(const std::string&)) {
  const auto share = [](double before, double after) { return before != 0 ? after / before - 1 : 0.0; };
  char line[240];
  std::snprintf(line, sizeof line,
                "quality %.2f -> %.2f, grains %+.1e, water %+.1e, restored %+.1e, kinetic energy %+.1e, "
                "yield drift %.1e",
                receipt.quality_before, receipt.quality, share(receipt.before.solid, receipt.after.solid),
                share(receipt.before.water, receipt.after.water), receipt.restored_solid,
                share(receipt.before.kinetic, receipt.after.kinetic), receipt.yield_drift);
  tell(begin + line);
  if (model.soil()->layered()) tell(layers_text(model, receipt));
  if (receipt.started == 0 || warned_) return;
  warned_ = true;
  log::warn("laws start anew at " + std::to_string(receipt.started) + " points where the soil has become another " +
            "one, the first of " + receipt.started_where + ", at t " + told(model.store().committed().time, "%.6g s") +
            ": no soil of that material was within an element, so that its state variables (preconsolidation pressure "
            "and the like) follow from stress and void ratio there and its history is lost; doubt them there (smaller "
            "elements across the layers help; 'mesh motion/laws started anew' counts on)");
}

}  // namespace mudline
