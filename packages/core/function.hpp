#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/range.hpp"
#include "core/unit.hpp"
#include "tensor/vec.hpp"

namespace mudline {

constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};  // in decks and histories; in the plane the first two

constexpr const char* geometry_in_space = "three-dimensional";  // value of the deck's "mesh/geometry"; others: plane

/// A scalar function of time and position; immutable after construction.
class FunctionBase {
 public:
  virtual ~FunctionBase() = default;
  virtual double value(double time, const Point& x) const = 0;
  /// True when value does not depend on time.
  virtual bool steady() const { return false; }
  /// True when value does not depend on the position.
  virtual bool uniform() const { return false; }
};

/// A number, an expression (see make_expression), or the name of an entry of the deck's section "functions".
/// Value semantics: copies share the immutable definition. Default-constructed: the constant 0.
class Function {
 public:
  Function() : Function(0.0) {}
  Function(double constant);  // NOLINT: a number is a function
  Function(double constant, std::string text);
  explicit Function(std::shared_ptr<const FunctionBase> definition, std::string text);

  /// InputError where the value lies outside of within(), or is not finite; without within() any value is returned.
  double operator()(double time, const Point& x) const { return definition_ ? evaluate(time, x) : constant_; }
  bool steady() const { return definition_ ? definition_->steady() : true; }
  bool is_constant() const { return definition_ == nullptr; }
  bool is_zero() const { return is_constant() && constant_ == 0.0; }
  /// The definition as the user wrote it.
  const std::string& text() const { return text_; }
  /// A copy of the function with another text().
  Function with_text(std::string text) const;
  /// A copy that refuses values outside of `range`. `origin` is where the deck gives it: "deck.xml:12: path: ".
  Function within(const Range& range, const std::string& origin, int dimension) const;

 private:
  struct Limits;
  double evaluate(double time, const Point& x) const;

  std::shared_ptr<const FunctionBase> definition_;
  double constant_ = 0.0;
  std::string text_;
  std::shared_ptr<const Limits> limits_;  // null: none
};

/// The deck's named functions; resolves the value of a parameter that is a function.
class FunctionLibrary {
 public:
  /// dimension: that of the deck's mesh, 2 or 3; expressions have that many coordinates.
  explicit FunctionLibrary(int dimension = 2) : dimension_(dimension) {}
  int dimension() const { return dimension_; }
  /// `measured`: a value of the function with its unit; nothing where its values are plain numbers.
  void add(const std::string& name, Function function, std::optional<ValueWithUnit> measured = {});
  std::vector<std::string> names() const;
  bool contains(const std::string& name) const { return functions_.count(name) != 0; }

  /// A number ("3.5"), a quantity ("3 kPa", as ValueWithUnit::plain()), a function's name, or an expression
  /// ("10*sin(5*t)"). Throws InputError without position (the caller adds path and line) with the parser's reason.
  Function resolve(const std::string& text) const;
  /// The same where values in the unit `declared` are wanted: InputError for a named function of another measure.
  Function resolve(const std::string& text, const std::string& declared) const;

 private:
  std::map<std::string, Function> functions_;
  std::map<std::string, ValueWithUnit> measured_;  // by name of a function whose values have a unit
  int dimension_;
};

/// Expression in muParser's syntax: + - * / ^, comparisons, ?:, sin, exp, min, ... and the constant pi. Variables: t
/// [s]; in the plane x and r, the first coordinate, y and z, the second one: plane strain decks thus write (x, y),
/// axisymmetric decks (r, z); in space x, y and z. An expression without variables becomes a constant. May be evaluated
/// from several threads, one at a time. Throws InputError without position, naming the offending part.
Function make_expression(const std::string& text, int dimension = 2);

/// The value of an expression of constants, by name, in the same syntax, without t and position. Throws InputError
/// without position.
double constant_value(const std::string& expression, const std::map<std::string, double>& constants);

/// Whether the name is that of time or of a coordinate: t, x, y, z, r.
bool is_coordinate(const std::string& name);
/// Whether a name has a meaning in expressions already: a coordinate, pi, sin, ...
bool means_something(const std::string& name);

enum class Interpolation { linear, smooth };

/// Table in time, constant outside its range. `smooth`: cubic with zero slope at every table point (monotone between
/// points, C1), the usual smooth ramp. Throws InputError unless times increase strictly and sizes agree.
Function make_table(const std::vector<double>& times, const std::vector<double>& values, Interpolation kind);

}  // namespace mudline
