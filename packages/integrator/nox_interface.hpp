#pragma once

// The only file that names NOX classes besides newton.cpp, which includes it.

#include <NOX.H>
#include <NOX_Abstract_Group.H>
#include <NOX_Abstract_Vector.H>
#include <NOX_StatusTest_Generic.H>

#include "integrator/newton.hpp"

namespace mudline {

/// NOX's vector interface over one Tpetra vector.
class NoxVector : public NOX::Abstract::Vector {
 public:
  explicit NoxVector(const RCP<const Map>& map) : v_(map) {}
  explicit NoxVector(const mudline::Vector& source) : v_(source, Teuchos::Copy) {}
  mudline::Vector& get() { return v_; }
  const mudline::Vector& get() const { return v_; }
  static const mudline::Vector& of(const NOX::Abstract::Vector& v) { return dynamic_cast<const NoxVector&>(v).v_; }

  NOX::Abstract::Vector& init(double gamma) override {
    v_.putScalar(gamma);
    return *this;
  }
  NOX::Abstract::Vector& random(bool, int) override {
    v_.randomize();
    return *this;
  }
  NOX::Abstract::Vector& abs(const NOX::Abstract::Vector& y) override {
    v_.abs(of(y));
    return *this;
  }
  NOX::Abstract::Vector& operator=(const NOX::Abstract::Vector& y) override {
    Tpetra::deep_copy(v_, of(y));
    return *this;
  }
  NOX::Abstract::Vector& reciprocal(const NOX::Abstract::Vector& y) override {
    v_.reciprocal(of(y));
    return *this;
  }
  NOX::Abstract::Vector& scale(double gamma) override {
    v_.scale(gamma);
    return *this;
  }
  NOX::Abstract::Vector& scale(const NOX::Abstract::Vector& a) override {
    v_.elementWiseMultiply(1.0, mudline::Vector(of(a), Teuchos::Copy), v_, 0.0);
    return *this;
  }
  NOX::Abstract::Vector& update(double alpha, const NOX::Abstract::Vector& a, double gamma) override {
    v_.update(alpha, of(a), gamma);
    return *this;
  }
  NOX::Abstract::Vector& update(double alpha, const NOX::Abstract::Vector& a, double beta,
                                const NOX::Abstract::Vector& b, double gamma) override {
    v_.update(alpha, of(a), beta, of(b), gamma);
    return *this;
  }
  RCP<NOX::Abstract::Vector> clone(NOX::CopyType type) const override {
    if (type == NOX::DeepCopy) return rcp(new NoxVector(v_));
    return rcp(new NoxVector(v_.getMap()));
  }
  double norm(NormType type) const override {
    if (type == MaxNorm) return v_.normInf();
    if (type == OneNorm) return v_.norm1();
    return v_.norm2();
  }
  double norm(const NOX::Abstract::Vector& weights) const override {
    mudline::Vector squared(v_.getMap());
    squared.elementWiseMultiply(1.0, v_, v_, 0.0);
    return std::sqrt(squared.dot(of(weights)));
  }
  double innerProduct(const NOX::Abstract::Vector& y) const override { return v_.dot(of(y)); }
  NOX::size_type length() const override { return static_cast<NOX::size_type>(v_.getGlobalLength()); }

 private:
  mudline::Vector v_;
};

/// NOX's group: values at one x. There is one Jacobian for all clones; its owner is the group that linearised last.
/// It holds no constitutive history: the problem's residual is pure in x.
class NoxGroup : public NOX::Abstract::Group {
 public:
  struct Shared {
    NonlinearProblem* problem;
    const NoxGroup* jacobian_owner = nullptr;
    int evaluations = 0;
  };
  NoxGroup(std::shared_ptr<Shared> shared, const Vector& x)
      : shared_(std::move(shared)), x_(x), f_(x.getMap()), newton_(x.getMap()), gradient_(x.getMap()) {}
  NoxGroup(const NoxGroup& other, NOX::CopyType type)
      : shared_(other.shared_),
        x_(other.x_.get()),
        f_(other.f_.get()),
        newton_(other.newton_.get()),
        gradient_(other.gradient_.get()),
        has_f_(other.has_f_),
        has_newton_(other.has_newton_) {
    if (type == NOX::ShapeCopy) has_f_ = has_newton_ = false;
  }
  NOX::Abstract::Group& operator=(const NOX::Abstract::Group& g) override {
    const auto& other = dynamic_cast<const NoxGroup&>(g);
    x_.get().assign(other.x_.get());
    has_f_ = other.has_f_;
    has_newton_ = other.has_newton_;
    if (has_f_) f_.get().assign(other.f_.get());
    if (has_newton_) newton_.get().assign(other.newton_.get());
    if (shared_->jacobian_owner == &other) shared_->jacobian_owner = this;
    return *this;
  }
  void setX(const NOX::Abstract::Vector& y) override {
    forget();
    x_.get().assign(NoxVector::of(y));
  }
  void computeX(const NOX::Abstract::Group& g, const NOX::Abstract::Vector& d, double step) override {
    forget();
    x_.update(1.0, dynamic_cast<const NoxGroup&>(g).x_, step, d, 0.0);
  }
  ReturnType computeF() override {
    if (has_f_) return Ok;
    ++shared_->evaluations;
    if (!shared_->problem->residual(x_.get(), f_.get())) {
      // every rank sees the NaN through the norms, and NOX's finite-value test ends the solve
      f_.init(std::numeric_limits<double>::quiet_NaN());
      has_f_ = true;
      return Failed;
    }
    has_f_ = true;
    return Ok;
  }
  ReturnType computeJacobian() override {
    if (isJacobian()) return Ok;
    if (!shared_->problem->jacobian(x_.get())) return Failed;
    shared_->jacobian_owner = this;
    return Ok;
  }
  ReturnType computeGradient() override { return NotDefined; }
  ReturnType computeNewton(Teuchos::ParameterList&) override {
    if (has_newton_) return Ok;
    if (!has_f_ || !isJacobian()) return BadDependency;
    newton_.init(0.0);
    const bool ok = shared_->problem->solve(f_.get(), newton_.get());
    newton_.scale(-1.0);
    has_newton_ = ok;
    return ok ? Ok : Failed;
  }
  ReturnType applyJacobian(const NOX::Abstract::Vector& v, NOX::Abstract::Vector& jv) const override {
    if (!isJacobian()) return BadDependency;
    shared_->problem->apply_jacobian(NoxVector::of(v), dynamic_cast<NoxVector&>(jv).get());
    return Ok;
  }
  bool isF() const override { return has_f_; }
  bool isJacobian() const override { return shared_->jacobian_owner == this; }
  bool isNewton() const override { return has_newton_; }
  const NOX::Abstract::Vector& getX() const override { return x_; }
  const NOX::Abstract::Vector& getF() const override { return f_; }
  /// Merit of the line searches: the root mean square of the fields' residual ratios, so that units do not mix.
  double getNormF() const override {
    double sum = 0;
    for (double r : shared_->problem->residual_ratios(f_.get())) sum += r * r;
    return std::sqrt(sum);
  }
  /// Work [J] of the residual's forces on a motion, see NonlinearProblem.
  double work(const NOX::Abstract::Vector& direction) const {
    return shared_->problem->work(f_.get(), NoxVector::of(direction));
  }
  const NOX::Abstract::Vector& getGradient() const override { return gradient_; }
  const NOX::Abstract::Vector& getNewton() const override { return newton_; }
  RCP<const NOX::Abstract::Vector> getXPtr() const override { return Teuchos::rcpFromRef(x_); }
  RCP<const NOX::Abstract::Vector> getFPtr() const override { return Teuchos::rcpFromRef(f_); }
  RCP<const NOX::Abstract::Vector> getGradientPtr() const override { return Teuchos::rcpFromRef(gradient_); }
  RCP<const NOX::Abstract::Vector> getNewtonPtr() const override { return Teuchos::rcpFromRef(newton_); }
  RCP<NOX::Abstract::Group> clone(NOX::CopyType type) const override { return rcp(new NoxGroup(*this, type)); }

 private:
  void forget() {
    has_f_ = has_newton_ = false;
    if (shared_->jacobian_owner == this) shared_->jacobian_owner = nullptr;
  }
  std::shared_ptr<Shared> shared_;
  NoxVector x_, f_, newton_, gradient_;
  bool has_f_ = false, has_newton_ = false;
};

}  // namespace mudline
