#include "contact/body/penalty_contact.hpp"
#include "contact/contact.hpp"
#include "contact/faces/face_contact.hpp"
#include "contact/mortar/pair_contact.hpp"
#include "contact/nodes/node_contact.hpp"

namespace mudline {

void register_contact(ContactRegistry& registry) {
  registry.add<PenaltyContact>("penalty", "Soil surface against a rigid body, penalty, with or without friction");
  registry.add<FrictionlessPenaltyContact>("frictionless penalty",
                                           "Soil surface against a smooth rigid body, normal penalty, no friction");
  registry.add<NodeContact>(
      "node to segment",
      "Two deformable surfaces, nodes of one against the other, straight or smoothed, with or without friction");
  registry.add<FaceContact>(
      "point to face",
      "In space: two deformable surfaces, points of one against the other's smoothed faces, with or without friction");
  registry.add<PairContact>(
      "mortar", "Two deformable surfaces, segment to segment with linear multipliers, with or without friction");
}

}  // namespace mudline
