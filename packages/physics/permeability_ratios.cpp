#include "physics/permeability_ratios.hpp"

#include <string>

#include "core/pi.hpp"
#include "tensor/rotation.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

void PermeabilityRatios::parameters(Parameters& p) {
  const std::size_t directions = p.dimension();
  p.add("permeability ratios", ratios_, "-", non_negative(),
        "conductivity along x, y (in space z) over the 'hydraulic conductivity', as many numbers as directions; the "
        "directions turn with the soil. Without it the same in all directions");
  p.add("permeability rotation", rotation_, "deg", any(),
        "how the directions of 'permeability ratios' are turned from the axes at the start: in the plane one number, "
        "counter-clockwise, in space the rotation vector x, y, z (about its direction, right-handed, by its length)");
  if (p.documenting()) return;
  const auto expect = [&](const std::vector<double>& given, std::size_t count, const char* name) {
    if (given.size() != count)
      p.deck().fail("expected " + std::to_string(count) + (count == 1 ? " number" : " numbers") + ", given " +
                        std::to_string(given.size()),
                    name);
  };
  if (p.given("permeability rotation") && !given())
    p.deck().fail("without 'permeability ratios' there are no directions to turn", "permeability rotation");
  if (!given()) return;
  expect(ratios_, directions, "permeability ratios");
  const double along[6] = {ratios_[0], ratios_[1], directions == 3 ? ratios_[2] : 1.0, 0, 0, 0};
  std::copy_n(along, 6, tensor_.begin());
  if (rotation_.empty()) return;
  expect(rotation_, directions == 3 ? 3 : 1, "permeability rotation");
  const Point vector =
      pi / 180 * (directions == 3 ? Point{rotation_[0], rotation_[1], rotation_[2]} : Point{0, 0, rotation_[0]});
  sym6::rotate(&Rotation::by(vector).matrix[0][0], along, tensor_.data());
}

}  // namespace mudline
