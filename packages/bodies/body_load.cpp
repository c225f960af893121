#include "bodies/body_load.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

const char* direction_name(int dimension, int direction) {
  static const char* const in_plane[] = {"x", "y", "rotation"};
  static const char* const in_space[] = {"x", "y", "z", "rotation x", "rotation y", "rotation z"};
  return dimension == 2 ? in_plane[direction] : in_space[direction];
}

BodyNumber at(const Function& f, double time, const BodyVector& x, int dimension) {
  const Point here = plain_vector(x);
  BodyNumber result(f(time, here));
  if (f.is_constant()) return result;
  for (int j = 0; j < dimension; ++j) {  // an expression has no derivative: differenced
    const double h = 1e-6 * std::max(1.0, std::abs(here[j]));
    Point above = here, below = here;
    above[j] += h;
    below[j] -= h;
    const double slope = (f(time, above) - f(time, below)) / (2 * h);
    for (int k = 0; k < body_directions; ++k) result.d[k] += slope * x[j].d[k];
  }
  return result;
}

void PointLoad::parameters(Parameters& p) {
  p.required("point", point, "m", "where it acts, in the body's frame, from the reference point");
  const bool space = p.dimension() == 3;
  for (int i = 0; i < p.dimension(); ++i)
    p.add(std::string("force ") + axis_names[i], force[i], "N",
          "force along the axis, a function of time and of the reference point's position");
  if (!space || p.documenting()) p.add("moment", moment[2], "N m", "in the plane: moment, counter-clockwise");
  if (space)
    for (int i = 0; i < 3; ++i)
      p.add(std::string("moment ") + axis_names[i], moment[i], "N m", "in space: moment about the axis, right-handed");
  p.add("turns with the body", turns, "whether the axes are those of the body, which turn with it, or the model's");
}

}  // namespace mudline
