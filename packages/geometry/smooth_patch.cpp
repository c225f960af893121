#include "geometry/smooth_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// A function of a and b with its first and second derivatives.
struct Jet {
  double f = 0, a = 0, b = 0, aa = 0, ab = 0, bb = 0;
};

Jet operator*(const Jet& p, const Jet& q) {
  return {p.f * q.f,
          p.a * q.f + p.f * q.a,
          p.b * q.f + p.f * q.b,
          p.aa * q.f + 2 * p.a * q.a + p.f * q.aa,
          p.ab * q.f + p.a * q.b + p.b * q.a + p.f * q.ab,
          p.bb * q.f + 2 * p.b * q.b + p.f * q.bb};
}
Jet operator+(const Jet& p, const Jet& q) {
  return {p.f + q.f, p.a + q.a, p.b + q.b, p.aa + q.aa, p.ab + q.ab, p.bb + q.bb};
}
Jet inverse(const Jet& p) {
  const double f = 1 / p.f, ff = f * f, fff = 2 * ff * f;
  return {
      f, -ff * p.a, -ff * p.b, fff * p.a * p.a - ff * p.aa, fff * p.a * p.b - ff * p.ab, fff * p.b * p.b - ff * p.bb};
}

void add(const Jet& weight, double factor, const Point& x, PatchPoint& sum) {
  sum.x += factor * weight.f * x;
  sum.da += factor * weight.a * x;
  sum.db += factor * weight.b * x;
  sum.daa += factor * weight.aa * x;
  sum.dab += factor * weight.ab * x;
  sum.dbb += factor * weight.bb * x;
}

/// A quadratic function of (a, b): its gradient and its matrix at a point of the triangle.
struct Quadratic {
  double ga, gb, aa, ab, bb;
  double change(double da, double db) const {
    return ga * da + gb * db + 0.5 * (aa * da * da + 2 * ab * da * db + bb * db * db);
  }
};

/// Moves (a, b) to the minimum of the function in the triangle; its matrix is positive definite.
void descend(const Quadratic& q, double& a, double& b) {
  const double det = q.aa * q.bb - q.ab * q.ab;
  const double da = (q.ab * q.gb - q.bb * q.ga) / det, db = (q.ab * q.ga - q.aa * q.gb) / det;
  if (a + da >= 0 && b + db >= 0 && a + da + b + db <= 1) {
    a += da;
    b += db;
    return;
  }
  constexpr double from[3][2] = {{0, 0}, {1, 0}, {0, 1}}, along[3][2] = {{1, 0}, {-1, 1}, {0, -1}};
  double best = std::numeric_limits<double>::infinity(), best_a = a, best_b = b;
  for (int edge = 0; edge < 3; ++edge) {
    const double *d = along[edge], fa = from[edge][0] - a, fb = from[edge][1] - b;
    const double slope = (q.ga + q.aa * fa + q.ab * fb) * d[0] + (q.gb + q.ab * fa + q.bb * fb) * d[1];
    const double bend = q.aa * d[0] * d[0] + 2 * q.ab * d[0] * d[1] + q.bb * d[1] * d[1];
    const double t = std::min(1.0, std::max(0.0, -slope / bend));
    const double value = q.change(fa + t * d[0], fb + t * d[1]);
    if (value >= best) continue;
    best = value;
    best_a = from[edge][0] + t * d[0];
    best_b = from[edge][1] + t * d[1];
  }
  a = best_a;
  b = best_b;
}

}  // namespace

SmoothPatch::SmoothPatch(const std::array<Point, 3>& corner, const std::array<Point, 3>& normal)
    : edge_a_(corner[1] - corner[0]), edge_b_(corner[2] - corner[0]) {
  for (int edge = 0; edge < 3; ++edge) set_edge(edge, corner, normal);
  for (int edge = 0; edge < 3; ++edge) set_inside(edge, normal);
  bounds_ = Bounds::nothing();
  const auto reach = [&](const Point& x, const std::array<int, 3>& m) {
    bounds_.enclose(x);
    const Point flat = corner[0] + 0.25 * m[1] * edge_a_ + 0.25 * m[2] * edge_b_;
    bulge_ = std::max(bulge_, length(x - flat));
  };
  for (int j = 0; j <= 4; ++j)
    for (int k = 0; j + k <= 4; ++k) reach(control_[number({4 - j - k, j, k})], {4 - j - k, j, k});
  for (int c = 0; c < 3; ++c) {
    std::array<int, 3> m{1, 1, 1};
    m[c] = 2;
    reach(control_[number(m)] + twist_[c], m);
  }
}

// The cubic curve along an edge, which leaves both ends at right angles to their normals, as a quartic.
void SmoothPatch::set_edge(int edge, const std::array<Point, 3>& corner, const std::array<Point, 3>& normal) {
  const int s = edge, t = (edge + 1) % 3;
  const Point chord = corner[t] - corner[s];
  const double size = length(chord);
  const auto handle = [&](const Point& n) {
    const Point d = chord - dot(chord, n) * n;
    const double cosine = length(d) / size;
    // its length makes the curve between two points of a circle an arc of it, to the sixth order of the angle
    return 2 / (3 * cosine * (1 + cosine)) * d;
  };
  const Point cubic[4] = {corner[s], corner[s] + handle(normal[s]), corner[t] - handle(normal[t]), corner[t]};
  for (int j = 0; j <= 4; ++j) {
    std::array<int, 3> m{};
    m[s] = 4 - j;
    m[t] = j;
    Point x{};
    if (j > 0) x += 0.25 * j * cubic[j - 1];
    if (j < 4) x += (1 - 0.25 * j) * cubic[j];
    control_[number(m)] = x;
  }
}

// The derivative across an edge is, along the whole edge, a combination of the edge's own derivative and of a
// transverse vector that the neighbour shares. It is known at the ends, which gives the inner control points next to
// the edge.
void SmoothPatch::set_inside(int edge, const std::array<Point, 3>& normal) {
  const int s = edge, t = (edge + 1) % 3, o = (edge + 2) % 3;
  const auto control = [&](int j, int row) -> Point& {
    std::array<int, 3> m{};
    m[s] = 4 - row - j;
    m[t] = j;
    m[o] = row;
    return control_[number(m)];
  };
  // differences of the cubic's control points, from those of the quartic
  const Point first = 4.0 / 3 * (control(1, 0) - control(0, 0));
  const Point last = 4.0 / 3 * (control(4, 0) - control(3, 0));
  const Point middle = control(4, 0) - control(0, 0) - first - last;
  const Point across_s = unit(cross(normal[s], first)), across_t = unit(cross(normal[t], last));
  const Point across = unit(across_s + across_t);
  const auto split = [&](int j, const Point& along, const Point& side, double& on_along, double& on_side) {
    const Point d = control(j, 1) - 0.5 * (control(j, 0) + control(j + 1, 0));
    on_along = dot(d, along) / dot(along, along);
    on_side = dot(d, side);
  };
  double l0, l1, m0, m1;
  split(0, first, across_s, l0, m0);
  split(3, last, across_t, l1, m1);
  const Point near_s = 1.0 / 3 * (l1 * first + 2 * l0 * middle + m1 * across_s + 2 * m0 * across);
  const Point near_t = 1.0 / 3 * (2 * l1 * middle + l0 * last + 2 * m1 * across + m0 * across_t);
  const Point inner_s = near_s + 0.5 * (control(1, 0) + control(2, 0));
  const Point inner_t = near_t + 0.5 * (control(2, 0) + control(3, 0));
  // at corner c the inner point is B + la / (la + lb) (A - B): A of the edge that starts there, B of the one that ends
  control(2, 1) = inner_t;
  twist_[t] -= inner_t;
  twist_[s] += inner_s;
}

PatchPoint SmoothPatch::at(double a, double b) const {
  // de Casteljau's algorithm: the last level but one gives the first derivatives, the level before it the second ones
  const double value[3] = {1 - a - b, a, b};
  std::array<Point, points> level = control_;
  Point six[6], three[3];
  const auto halve = [&](int degree) {
    for (int rest = 0; rest < degree; ++rest)
      for (int k = 0; k <= rest; ++k) {
        const int here = rest * (rest + 1) / 2 + k, next = (rest + 1) * (rest + 2) / 2 + k;
        for (int i = 0; i < 3; ++i)
          level[here][i] = value[0] * level[here][i] + value[1] * level[next][i] + value[2] * level[next + 1][i];
      }
  };
  halve(4);
  halve(3);
  std::copy_n(level.begin(), 6, six);
  halve(2);
  std::copy_n(level.begin(), 3, three);
  halve(1);
  PatchPoint sum{};
  sum.x = level[0];
  for (int i = 0; i < 3; ++i) {
    sum.da[i] = 4 * (three[1][i] - three[0][i]);
    sum.db[i] = 4 * (three[2][i] - three[0][i]);
    sum.daa[i] = 12 * (six[0][i] - 2 * six[1][i] + six[3][i]);
    sum.dab[i] = 12 * (six[0][i] - six[1][i] - six[2][i] + six[4][i]);
    sum.dbb[i] = 12 * (six[0][i] - 2 * six[2][i] + six[5][i]);
  }
  constexpr double slope[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
  Jet at[3];
  for (int c = 0; c < 3; ++c) at[c] = {value[c], slope[c][0], slope[c][1], 0, 0, 0};
  for (int c = 0; c < 3; ++c) {
    const int t = (c + 1) % 3, o = (c + 2) % 3;
    if (value[t] + value[o] < 1e-12) continue;  // value and slope vanish at the corner
    const Jet inner = at[c] * at[t];
    add(inner * inner * at[o] * inverse(at[t] + at[o]), 12, twist_[c], sum);
  }
  return sum;
}

double SmoothPatch::closest_flat(const Point& x, double& a, double& b) const {
  const Point d = control_[0] - x;
  a = b = 0;
  descend({dot(d, edge_a_), dot(d, edge_b_), dot(edge_a_, edge_a_), dot(edge_a_, edge_b_), dot(edge_b_, edge_b_)}, a,
          b);
  return length(d + a * edge_a_ + b * edge_b_);
}

double SmoothPatch::flat_distance(const Point& x) const {
  double a, b;
  return closest_flat(x, a, b);
}

PatchPoint SmoothPatch::closest(const Point& x) const {
  double a, b;
  closest_flat(x, a, b);
  PatchPoint best = closest_from(x, a, b);
  if (bulge_ < 0.05 * std::max(length(edge_a_), length(edge_b_))) return best;
  // a strongly curved patch may have more than one local minimum of the distance
  constexpr double start[4][2] = {{1.0 / 3, 1.0 / 3}, {0.1, 0.1}, {0.8, 0.1}, {0.1, 0.8}};
  for (const auto& from : start) {
    const PatchPoint other = closest_from(x, from[0], from[1]);
    if (length(other.x - x) < length(best.x - x)) best = other;
  }
  return best;
}

PatchPoint SmoothPatch::closest_from(const Point& x, double a, double b) const {
  PatchPoint best = at(a, b);
  Point d = best.x - x;
  double square = dot(d, d);
  for (int i = 0; i < 50; ++i) {
    Quadratic q{dot(d, best.da), dot(d, best.db), dot(best.da, best.da), dot(best.da, best.db), dot(best.db, best.db)};
    const double aa = q.aa + dot(d, best.daa), ab = q.ab + dot(d, best.dab), bb = q.bb + dot(d, best.dbb);
    // far on the hollow side Newton's matrix is not positive definite: the Gauss-Newton matrix is
    if (aa * bb - ab * ab > 1e-6 * (q.aa * q.bb - q.ab * q.ab) && aa + bb > 0) {
      q.aa = aa;
      q.ab = ab;
      q.bb = bb;
    }
    double to_a = a, to_b = b;
    descend(q, to_a, to_b);
    const double step = std::max(std::abs(to_a - a), std::abs(to_b - b));
    double share = 1;
    for (;; share *= 0.5) {
      const double trial_a = a + share * (to_a - a), trial_b = b + share * (to_b - b);
      const PatchPoint trial = at(trial_a, trial_b);
      const Point e = trial.x - x;
      // a short step changes the distance by less than rounding
      if (dot(e, e) > square * (1 + 1e-12) && step > 1e-6) {
        if (share * step < 1e-9) return best;
        continue;
      }
      a = trial_a;
      b = trial_b;
      best = trial;
      d = e;
      square = dot(e, e);
      break;
    }
    if (share * step < 1e-9) break;  // the last step was Newton's: the next one would be about the square of its size
  }
  return best;
}

}  // namespace mudline
