#include "core/function_types.hpp"

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

}  // namespace

void register_functions(Registry<FunctionDefinition>& functions) {
  functions.add<TableDefinition>("table", "Values at given times, interpolated linearly or smoothly.");
  functions.add<ExpressionDefinition>("expression", "A formula of time and position.");
  functions.add<ConstantDefinition>("constant", "A named number.");
}

FunctionLibrary read_functions(const Section& functions, const Registry<FunctionDefinition>& types) {
  functions.allow_parameters({});
  FunctionLibrary library(functions.dimension());
  for (const std::string& name : functions.section_names()) {
    const Section section = functions.section(name);
    if (reserved(name)) section.fail("a function cannot be called '" + name + "', which is a number or an expression");
    library.add(name, types.create(section)->make());
  }
  return library;
}

}  // namespace mudline
