#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contact/faces/master_faces.hpp"
#include "contact/two_surfaces.hpp"

namespace mudline {

/// Deck entries of a point-to-face contact, besides friction.
struct FaceParameters : TwoSurfaceParameters {
  FaceParameters() : TwoSurfaceParameters(Enforcement::penalty) {}
  void parameters(Parameters& p);

  double corner_angle = 45;   // [deg]
  int quadrature_degree = 4;  // exact for the pressure of a linear gap on quadratic triangles
  PairImpact impact = PairImpact::conserving;
};

/// Contact of two deformable surfaces in space by a penalty: the Gauss points of the slave's sides against the master's
/// faces, whose normals are smoothed, R_u -= (x - y(xi))_{,u} . (t n + s) A at n+1 with the point's area A, see
/// face_force(). Forces on both surfaces cancel to rounding; their moments cancel except for the gap times the
/// friction.
///
/// Parallel: a rank computes its slave sides against the whole master surface, whose nodes it has as ghosts (SetPairs).
/// State arrays, prefix "contact/<name>/": "points", see face_column, a row per point; "penalty", a row per slave side,
/// frozen when the contact first starts a step; "damping" (with damping, one row: its heat so far).
class FaceContact : public PointwisePairContact<FaceParameters> {
 public:
  explicit FaceContact(const ContactContext& context) : PointwisePairContact(context) {}
  /// InputError for unknown, empty, equal or touching sets, deep overlap at the start, multipliers, friction on the
  /// effective traction of surfaces with pore pressure. Collective.
  void check(const Section& section);

  void declare_state(StateStore& store) override;
  void sparsity(Assembler& assembler) override;
  void begin(const StepView& view) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  Augmentation augment(const StepView&, int) override { return {}; }
  void histories(const StepView& view, Report& values) override;
  double step_limit(const State& committed, double dt) const override;
  void relocate(const ConstCoordinateView& x_old, State& committed) override;
  void take_evaluated(const State& evaluated, State& committed) override;
  std::vector<double> nodal_pressure(const State& state) const override;
  std::vector<double> nodal_shear(const State& state) const override;

 private:
  struct Row {
    int side, point;  // side of the slave; point of its rule
    double area = 0;  // [m2] at the start of the step
    Point outward{};  // unit normal of the slave there
  };
  struct Seen {
    int face = -1, place = -1;  // place: in the dof table, -1: none
    FaceProjection projection;
  };
  /// Weights of the slave's nodes, then of the face's nodes: d = sum_k weight_k x_k.
  struct Weights {
    int count;
    double at[2 * max_side_nodes];
  };
  const ContactRule& rule(int row) const { return rules_.at(slave_->sides()[rows_[row].side].shape); }
  Point slave_place(int row, const ConstCoordinateView& x) const;
  Weights weights(int row, int nodes, const double* of_face) const;
  void measure(const ConstCoordinateView& x);
  bool look(int row, const ConstCoordinateView& x, Seen& seen) const;
  int place(int row, int face) const;
  ContactPointLaw law(const StepView& view, int row) const;
  void evaluate(const StepView& view, const Positions& at, int row, const Seen& seen, bool want_tangent,
                FaceForce& out) const;
  void write(const StepView& view, int row, const Seen& seen, const FaceForce& force) const;
  void write_away(const StepView& view, int row) const;
  void remember(int place, const Weights& weights, double factor, const Point& force);
  /// Corrects the old force of a point that pressed at the start of the step: it acts with this share, not with the
  /// integrator's weight.
  void add_old_share(const StepView& view, int row, double share);
  void add_tangent(const StepView& view, const MatrixScatter& to, int row, const Seen& seen, const FaceForce& force,
                   double weight) const;
  /// Weights for the closest point on which the point pressed at the start of the step.
  Weights old_weights(const State& committed, int row) const;
  std::vector<double> nodal_mean(const std::function<double(int row)>& quantity) const;

  std::unique_ptr<ContactSurface> slave_;
  std::unique_ptr<MasterFaces> master_;
  std::map<CellShape, ContactRule> rules_;
  std::vector<Row> rows_;
  std::vector<std::vector<int>> candidates_;     // (slave side)
  std::unordered_map<long long, int> place_of_;  // (slave side, face)
  ElementDofs dofs_;
  int group_ = -1;
  double capture_ = 0;                               // [m]
  int points_ = -1, penalties_ = -1, damping_ = -1;  // state handles
};

/// Columns of the points.
namespace face_column {
enum : int {
  gap,
  pressure,
  slides,
  slip,
  heat,
  area,
  face,
  xi,
  shear = xi + 2,
  normal = shear + 3,
  force = normal + 3
};
}

}  // namespace mudline
