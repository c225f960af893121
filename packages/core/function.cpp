#include "core/function.hpp"

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "core/pi.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "core/unit.hpp"
#include "core/written_number.hpp"

namespace mudline {

namespace {

class Expression : public FunctionBase {
 public:
  Expression(const std::string& text, int dimension) {
    parser_.DefineVar("t", &time_);
    parser_.DefineVar("x", &point_[0]);
    parser_.DefineVar("y", &point_[1]);
    parser_.DefineVar("z", &point_[dimension - 1]);
    if (dimension == 2) parser_.DefineVar("r", &point_[0]);
    hint_ = dimension == 3 ? "; variables: t, x, y, z" : "; variables: t, x, y (axisymmetric: t, r, z)";
    hint_ += "; those of the deck stand in braces, {D}";
    read(text);
  }
  Expression(const std::string& text, const std::map<std::string, double>& constants) {
    for (const auto& [name, value] : constants) parser_.DefineConst(name, value);
    read(text);
  }

  double value(double time, const Point& x) const override {
    // The parser reads its variables through pointers into this object.
    const std::lock_guard<std::mutex> lock(mutex_);
    time_ = time;
    point_ = x;
    return parser_.Eval();
  }

  bool steady() const override { return used_.count("t") == 0; }
  bool uniform() const override { return used_.size() == used_.count("t"); }
  bool has_variables() const { return !used_.empty(); }

 private:
  void read(const std::string& text) {
    refuse_assignment(text);
    parser_.DefineConst("pi", pi);
    parser_.SetExpr(text);
    try {
      parser_.Eval();  // muParser reports most mistakes only here
      used_ = parser_.GetUsedVar();
    } catch (const mu::ParserError& error) {
      throw InputError(reason(error));
    }
    if (parser_.GetNumResults() != 1)
      throw InputError("it gives several values separated by ','" + why_no_number(text));
  }

  /// Refuses assignments: muParser would overwrite x at "x = 3".
  static void refuse_assignment(const std::string& text) {
    for (std::size_t i = text.find('='); i != std::string::npos; i = text.find('=', i + 1)) {
      const char before = i > 0 ? text[i - 1] : '=';
      if (before == '<' || before == '>' || before == '!') continue;
      if (i + 1 >= text.size() || text[i + 1] != '=')
        throw InputError("an assignment with '=' is not possible; compare with '=='");
      ++i;
    }
  }

  std::string reason(const mu::ParserError& error) const {
    std::string message = error.GetMsg();
    std::replace(message.begin(), message.end(), '"', '\'');
    std::replace(message.begin(), message.end(), '\n', ' ');
    if (!message.empty() && message.back() == '.') message.pop_back();
    if (!message.empty()) message[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(message[0])));
    const std::string word = misspelt_word(error);
    if (word.empty()) return message;
    const std::string near = nearest(word, known_words());
    return message + (near.empty() ? hint_ : " (did you mean '" + near + "'?)");
  }

  /// The token that muParser rejects may run on ("sinn(t)"): only its leading word can be a misspelt name.
  static std::string misspelt_word(const mu::ParserError& error) {
    const std::string token = error.GetToken();
    const auto end =
        std::find_if(token.begin(), token.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; });
    return std::string(token.begin(), end);
  }

  std::vector<std::string> known_words() const {
    std::vector<std::string> words{"pi"};
    for (const auto& constant : parser_.GetConst()) words.push_back(constant.first);
    for (const auto& function : parser_.GetFunDef()) words.push_back(function.first);
    return words;
  }

  std::string hint_;  // added to an unknown name: those that there are
  mutable mu::Parser parser_;
  mutable std::mutex mutex_;
  mutable double time_ = 0.0;
  mutable Point point_{};
  mu::varmap_type used_;
};

class Table : public FunctionBase {
 public:
  Table(std::vector<double> times, std::vector<double> values, Interpolation kind)
      : times_(std::move(times)), values_(std::move(values)), kind_(kind) {}

  double value(double time, const Point& /*x*/) const override {
    if (std::isnan(time)) return time;
    if (time <= times_.front()) return values_.front();
    if (time >= times_.back()) return values_.back();
    const auto next = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), time) - times_.begin());
    double s = (time - times_[next - 1]) / (times_[next] - times_[next - 1]);
    if (kind_ == Interpolation::smooth) s *= s * (3.0 - 2.0 * s);
    return (1.0 - s) * values_[next - 1] + s * values_[next];
  }

  bool steady() const override {
    return std::all_of(values_.begin(), values_.end(), [this](double value) { return value == values_.front(); });
  }

  bool uniform() const override { return true; }

 private:
  std::vector<double> times_, values_;
  Interpolation kind_;
};

}  // namespace

Function::Function(double constant) : Function(constant, number_text(constant)) {}

Function::Function(double constant, std::string text) : constant_(constant), text_(std::move(text)) {}

Function::Function(std::shared_ptr<const FunctionBase> definition, std::string text)
    : definition_(std::move(definition)), text_(std::move(text)) {}

Function Function::with_text(std::string text) const {
  Function copy = *this;
  copy.text_ = std::move(text);
  return copy;
}

/// What within() allows.
struct Function::Limits {
  Range range;
  std::string origin;
  int dimension;  // of the mesh
};

Function Function::within(const Range& range, const std::string& origin, int dimension) const {
  Function copy = *this;
  copy.limits_ = std::make_shared<const Limits>(Limits{range, origin, dimension});
  return copy;
}

double Function::evaluate(double time, const Point& x) const {
  const double value = definition_->value(time, x);
  if (!limits_ || (std::isfinite(value) && limits_->range.contains(value))) return value;
  const std::string is = std::isfinite(value) ? told(value, "%.6g") : "not finite";
  std::string at = steady() ? "" : told(time, "t = %.6g s");
  if (!definition_->uniform()) at += (at.empty() ? "" : ", ") + place_text(x, limits_->dimension);
  const std::string allowed = limits_->range.describe();
  throw InputError(limits_->origin + "the value of '" + text_ + "' is " + is + " at " + at +
                   "; allowed: " + (allowed == "any" ? "finite numbers" : allowed));
}

void FunctionLibrary::add(const std::string& name, Function function, std::optional<ValueWithUnit> measured) {
  if (!functions_.emplace(name, function.with_text(name)).second)
    throw std::logic_error("the function '" + name + "' is added twice");
  if (measured) measured_.emplace(name, *measured);
}

Function FunctionLibrary::resolve(const std::string& text, const std::string& declared) const {
  const auto measured = measured_.find(trim(text));
  if (measured == measured_.end()) return resolve(text);
  try {
    number_in(declared, measured->second);
  } catch (const InputError& error) {
    throw InputError("function '" + measured->first + "': " + error.what());
  }
  return resolve(text);
}

std::vector<std::string> FunctionLibrary::names() const {
  std::vector<std::string> result;
  for (const auto& named : functions_) result.push_back(named.first);
  return result;
}

Function FunctionLibrary::resolve(const std::string& text) const {
  const std::string word = trim(text);
  if (const auto number = parse_number(word)) {
    if (!std::isfinite(*number)) throw InputError("expected a finite number, given '" + word + "'");
    return Function(*number, word);
  }
  if (const auto quantity = parse_quantity(word)) return Function(quantity->plain(), word);
  const auto named = functions_.find(word);
  if (named != functions_.end()) return named->second;
  try {
    return make_expression(word, dimension_);
  } catch (const InputError& error) {
    if (functions_.empty()) throw;
    const std::string near = nearest(word, names());
    if (!near.empty()) throw InputError("there is no function '" + word + "' (did you mean '" + near + "'?)");
    throw InputError(std::string(error.what()) + "; functions of the deck: " + join(names()));
  }
}

Function make_expression(const std::string& text, int dimension) {
  const std::string expression = trim(text);
  if (expression.empty()) throw InputError("the expression is empty");
  try {
    const auto definition = std::make_shared<Expression>(expression, dimension);
    if (definition->has_variables()) return Function(definition, expression);
    const double constant = definition->value(0.0, {});
    if (!std::isfinite(constant)) throw InputError("its value is not finite");
    return Function(constant, expression);
  } catch (const InputError& error) {
    throw InputError("invalid expression '" + expression + "': " + error.what());
  }
}

double constant_value(const std::string& expression, const std::map<std::string, double>& constants) {
  const double value = Expression(expression, constants).value(0.0, {});
  if (!std::isfinite(value)) throw InputError("the value of '" + expression + "' is not finite");
  return value;
}

bool is_coordinate(const std::string& name) {
  const std::set<std::string> names{"t", "x", "y", "z", "r"};
  return names.count(name) > 0;
}

bool means_something(const std::string& name) {
  const mu::Parser parser;
  return is_coordinate(name) || name == "pi" || parser.GetFunDef().count(name) + parser.GetConst().count(name) > 0;
}

Function make_table(const std::vector<double>& times, const std::vector<double>& values, Interpolation kind) {
  if (times.empty()) throw InputError("a table needs at least one time");
  if (times.size() != values.size())
    throw InputError("'times' and 'values' must be of the same length, given " + std::to_string(times.size()) +
                     " and " + std::to_string(values.size()));
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || !std::isfinite(values[i]))
      throw InputError("entry " + std::to_string(i + 1) + " of the table is not finite");
    if (i > 0 && times[i] <= times[i - 1])
      throw InputError("'times' must increase strictly, but " + number_text(times[i]) + " follows " +
                       number_text(times[i - 1]));
  }
  return Function(std::make_shared<Table>(times, values, kind), "table");
}

}  // namespace mudline
