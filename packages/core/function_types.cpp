#include "core/function_types.hpp"

#include <optional>

#include "core/csv_columns.hpp"
#include "core/text.hpp"
#include "core/unit.hpp"

namespace mudline {

namespace {

class TableDefinition : public FunctionDefinition {
 public:
  void parameters(Parameters& p) {
    p.required("times", times_, "s", any(), "Times of the table, strictly increasing");
    p.required("values", values_, "of the use", any(),
               "Values at these times; constant before the first and after the last");
    p.choice("interpolation", kind_, {{"linear", Interpolation::linear}, {"smooth", Interpolation::smooth}},
             "Straight lines, or cubics with zero slope at every time");
  }
  void check(const Section& section) const {
    try {
      make();
    } catch (const InputError& error) {
      section.fail(error.what(), times_.size() == values_.size() ? "times" : "values");
    }
  }
  Function make() const override { return make_table(times_, values_, kind_); }

 private:
  std::vector<double> times_, values_;
  Interpolation kind_ = Interpolation::linear;
};

/// A table over the depth, which is counted down from a height along the last coordinate.
class Profile : public FunctionBase {
 public:
  Profile(Function over_depth, double surface, int dimension)
      : over_depth_(std::move(over_depth)), surface_(surface), axis_(dimension - 1) {}
  double value(double, const Point& x) const override { return over_depth_(surface_ - x[axis_], x); }
  bool steady() const override { return true; }

 private:
  Function over_depth_;  // its "time" is the depth [m]
  double surface_;
  int axis_;
};

class ProfileDefinition : public FunctionDefinition {
 public:
  void parameters(Parameters& p) {
    dimension_ = p.dimension();
    p.add("depths", depths_, "m", any(), "Depths below the surface, strictly increasing; or give a file");
    p.add("values", values_, "of the use", any(),
          "Values at these depths, straight lines between them; constant above the first and below the last");
    p.file("file", file_, "CSV file whose first line names its columns, instead of depths and values");
    p.add("depth column", depth_column_,
          "Name of the file's column of depths [m]; another unit of length that the name ends with, such as [cm], "
          "counts");
    p.add("value column", value_column_, "Name of the file's column of values");
    p.add("factor", factor_, "-", any(),
          "Factor of all values, such as 1000 for a column in kPa; a column whose name ends with such a unit, [kPa], "
          "needs it");
    p.add("surface", surface_, "m", any(),
          "Height of the surface from which depths are counted, down the last coordinate");
  }
  void check(const Section& section) {
    const bool lists = section.has_parameter("depths") || section.has_parameter("values");
    if (lists == !file_.empty())
      section.fail("give either 'depths' and 'values' or a 'file' with its two columns", lists ? "file" : "type");
    for (const std::string column : {"depth column", "value column"}) {
      const bool given = section.has_parameter(column);
      if (given && file_.empty()) section.fail("without 'file' there are no columns", column);
      if (!given && !file_.empty()) section.fail("a file needs a '" + column + "'", "file");
    }
    if (!file_.empty()) {
      read_file(section);
      convert_depths(section);
    }
    if (depths_.size() != values_.size() || depths_.empty())
      section.fail(std::to_string(depths_.size()) + " depths and " + std::to_string(values_.size()) +
                       " values; as many of each are needed, at least one",
                   "values");
    for (std::size_t i = 1; i < depths_.size(); ++i)
      if (!(depths_[i] > depths_[i - 1]))
        section.fail("depths must increase strictly: " + number_text(depths_[i]) + " after " +
                         number_text(depths_[i - 1]) + " (row " + std::to_string(i + 1) + ")" +
                         (depths_[i] < 0 ? "; they are counted down from the surface, as positive numbers" : ""),
                     file_.empty() ? "depths" : "file");
    if (depths_.front() < 0 && depths_.back() <= 0)
      section.fail("depths are counted down from the surface, as positive numbers; given " +
                       number_text(depths_.front()) + " to " + number_text(depths_.back()) + ", all above it",
                   file_.empty() ? "depths" : "file");
    if (!file_.empty()) check_factor(section);
    for (double& value : values_) value *= factor_;
  }
  Function make() const override {
    const Function table = make_table(depths_, values_, Interpolation::linear);
    return Function(std::make_shared<Profile>(table, surface_, dimension_), "");
  }

 private:
  void read_file(const Section& section) {
    try {
      std::vector<std::vector<double>> columns = csv_columns(file_, {depth_column_, value_column_});
      depths_ = std::move(columns[0]);
      values_ = std::move(columns[1]);
    } catch (const InputError& error) {
      section.fail(error.what(), "file");
    }
  }

  /// Depths in the unit that their column's name ends with; InputError where it is none of length.
  void convert_depths(const Section& section) {
    const auto word = unit_word(depth_column_);
    if (!word) return;
    const auto unit = parse_unit(*word);
    if (!unit)
      section.fail("[" + *word + "] is no unit; a column of depths is in [m], [cm], [mm] or [km]", "depth column");
    try {
      for (double& depth : depths_) depth = number_in("m", {depth, *unit, depth_column_});
    } catch (const InputError& error) {
      section.fail(error.what(), "depth column");
    }
  }

  /// InputError where the column's name ends with a unit that is not the program's own, and no factor is given.
  void check_factor(const Section& section) const {
    const auto word = unit_word(value_column_);
    if (!word || section.has_parameter("factor")) return;
    const auto unit = parse_unit(*word);
    if (!unit)
      section.fail("[" + *word + "] is no unit that is known: give a 'factor', 1 for numbers as they are",
                   "value column");
    const double factor = ValueWithUnit{1, *unit, value_column_}.plain();
    if (factor != 1)
      section.fail("'" + value_column_ + "' needs a 'factor', " + number_text(factor) + " by this unit",
                   "value column");
  }

  /// What stands in brackets at the end of a column's name, as in "s_u [kPa]".
  static std::optional<std::string> unit_word(const std::string& column) {
    const std::size_t begin = column.rfind('[');
    if (begin == std::string::npos || column.back() != ']') return std::nullopt;
    return column.substr(begin + 1, column.size() - begin - 2);
  }

  std::vector<double> depths_, values_;
  std::string file_, depth_column_, value_column_;
  double factor_ = 1, surface_ = 0;
  int dimension_ = 2;
};

class ExpressionDefinition : public FunctionDefinition {
 public:
  void parameters(Parameters& p) {
    dimension_ = p.dimension();
    p.required("value", text_,
               "Expression in t, x, y (axisymmetric: t, r, z; in space: t, x, y, z) and pi, such as 10*sin(2*pi*t)");
  }
  void check(const Section& section) const {
    try {
      make();
    } catch (const InputError& error) {
      section.fail(error.what(), "value");
    }
  }
  Function make() const override { return make_expression(text_, dimension_); }

 private:
  std::string text_;
  int dimension_ = 2;
};

class ConstantDefinition : public FunctionDefinition {
 public:
  void parameters(Parameters& p) { p.required("value", value_, "of the use", any(), "The constant value"); }
  Function make() const override { return Function(value_); }

 private:
  double value_ = 0.0;
};

/// Whether a name already has a meaning: a function called "t" or "3" could never be used.
bool reserved(const std::string& name) {
  try {
    FunctionLibrary().resolve(name);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// The first value of a function that has a unit; nothing where none has. InputError where another measures something
/// else.
std::optional<ValueWithUnit> measured(const Section& function) {
  std::optional<ValueWithUnit> first;
  for (const char* entry : {"value", "values"}) {
    const auto* const quantities = function.quantities(entry);
    if (!quantities) continue;
    for (const auto& quantity : *quantities) {
      if (!quantity) continue;
      if (!first) first = quantity;
      if (quantity->unit.powers != first->unit.powers)
        function.fail("'" + quantity->text + "' measures something else than '" + first->text + "'", entry);
    }
  }
  return first;
}

}  // namespace

void register_functions(Registry<FunctionDefinition>& functions) {
  functions.add<TableDefinition>("table", "Values at given times, interpolated linearly or smoothly.");
  functions.add<ProfileDefinition>("profile", "Values over the depth, given here or in a CSV file.");
  functions.add<ExpressionDefinition>("expression", "A formula of time and position.");
  functions.add<ConstantDefinition>("constant", "A named number.");
}

FunctionLibrary read_functions(const Section& functions, const Registry<FunctionDefinition>& types) {
  functions.allow_parameters({});
  FunctionLibrary library(functions.dimension());
  for (const std::string& name : functions.section_names()) {
    const Section section = functions.section(name);
    if (reserved(name)) section.fail("a function cannot be called '" + name + "', which is a number or an expression");
    library.add(name, types.create(section)->make(), measured(section));
  }
  return library;
}

}  // namespace mudline
