#include "contact/faces/face_contact.hpp"

#include "core/pi.hpp"

namespace mudline {

void FaceParameters::parameters(Parameters& p) {
  TwoSurfaceParameters::parameters(p);
  declare_corner_angle(p);
  p.add("quadrature degree", quadrature_degree, "-", closed(1, 8),
        "Polynomial degree up to which the forces on a slave side are integrated exactly; more points see the edges of "
        "the master's faces better");
  declare_rest(p);
}

void FaceContact::check(const Section& section) {
  const Mesh& mesh = context_.space.mesh();
  check_entries(section, 3);
  const ContactSurface slave(mesh, deck_.slave);
  bind(section, std::make_unique<MasterFaces>(mesh, deck_.master, deck_.corner_angle * pi / 180), SideRule::At::gauss,
       deck_.quadrature_degree, deck_.reach > 0 ? deck_.reach : 3 * slave.longest(mesh.coordinates()));
}

}  // namespace mudline
