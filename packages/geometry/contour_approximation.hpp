#pragma once

#include <string>

#include "geometry/contour.hpp"

namespace mudline {

/// Approximation of a contour for contact. facets: chords between points on it, with corners between them; bezier:
/// smooth cubic pieces through the same points, whose tangents are those of the neighbouring points, as a contour known
/// by its points only would be smoothed.
enum class Approximation { exact, facets, bezier };

/// The contour with every curved piece replaced; chords are at most `chord` [m] long. Straight pieces stay.
Contour approximated(const Contour& contour, Approximation kind, double chord);

/// Reason why a contour cannot bound a body: it is inverted (the body on its right) or crosses itself; "" if it can.
std::string contour_fault(const Contour& contour);

}  // namespace mudline
