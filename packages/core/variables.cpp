#include "core/variables.hpp"

#include <Teuchos_Array.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "core/entry.hpp"
#include "core/errors.hpp"
#include "core/function.hpp"
#include "core/text.hpp"
#include "core/written_number.hpp"

namespace mudline {

namespace {

constexpr const char* section_name = "variables";

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// The words of a text that may be names of variables.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && in_word(text[end])) ++end;
    if (end > i && std::isdigit(static_cast<unsigned char>(text[i])) == 0) words.push_back(text.substr(i, end - i));
    i = std::max(end, i + 1);
  }
  return words;
}

Formula formula_of(const Teuchos::ParameterEntry& entry) {
  if (entry.isType<Formula>()) return Teuchos::any_cast<Formula>(entry.getAny(false));
  return {entry_type(entry), entry_text(entry)};
}

const Teuchos::ParameterList& list_of(const Teuchos::ParameterEntry& entry) {
  return Teuchos::any_cast<Teuchos::ParameterList>(entry.getAny(false));
}

/// A number within an expression, where a sign must not join what stands before or after it.
std::string in_expression(double number) {
  const std::string text = number_text(number);
  return text[0] == '-' ? "(" + text + ")" : text;
}

/// The text in braces, where these are all.
std::string bare(const std::string& text) {
  const std::string whole = trim(text);
  return whole.size() > 2 && whole.front() == '{' && whole.back() == '}' ? trim(whole.substr(1, whole.size() - 2)) : "";
}

/// Adds the words of all values that may name variables.
void collect_words(const Teuchos::ParameterList& list, std::set<std::string>& words) {
  for (auto it = list.begin(); it != list.end(); ++it) {
    if (list.entry(it).isList()) {
      collect_words(list_of(list.entry(it)), words);
    } else if (list.entry(it).isType<Formula>()) {
      for (const std::string& word : words_of(entry_text(list.entry(it)))) words.insert(word);
    }
  }
}

}  // namespace

Variables::Variables(const Teuchos::ParameterList& deck, const Sources& sources,
                     const Teuchos::ParameterList& elsewhere) {
  collect_words(deck, words_);
  collect_words(elsewhere, words_);
  if (!deck.isSublist(section_name)) {
    const std::string near = nearest(section_name, section_names(deck));
    if (!near.empty()) hint_ = "; is the section '" + near + "' meant to be 'variables'?";
    return;
  }
  given_ = &deck.sublist(section_name);
  for (auto it = given_->begin(); it != given_->end(); ++it) work_out(given_->name(it), sources);
  given_ = nullptr;
}

void Variables::work_out_words(const std::string& text, const Sources& sources) {
  for (const std::string& word : words_of(text))
    if (given_->isParameter(word)) work_out(word, sources);
}

void Variables::work_out(const std::string& name, const Sources& sources) {
  if (numbers_.count(name) + texts_.count(name) > 0) return;
  const std::string path = join_path(section_name, name);
  const auto fail = [&](const std::string& message) {
    throw InputError(sources.at(path) + ": " + path + ": " + message);
  };
  if (given_->isSublist(name)) fail("a section; a variable is a number, a text or a bool");
  if (words_of(name) != std::vector<std::string>{name})
    fail("a variable's name has letters, digits and '_' only, and begins with no digit");
  if (means_something(name)) fail("a variable cannot be called '" + name + "', which expressions know already");
  const bool begun = std::find(begun_.begin(), begun_.end(), name) != begun_.end();
  begun_.push_back(name);
  if (begun) fail("the variable is defined by itself: " + join(begun_, ", by "));
  const Formula formula = formula_of(given_->getEntry(name));
  const bool number = formula.type == "double" || formula.type == "int";
  if (formula.type.rfind("Array", 0) == 0) fail("an array; a variable is a number, a text or a bool");
  const bool names_others = number ? !parse_quantity(formula.text) : formula.text.find('{') != std::string::npos;
  if (names_others) work_out_words(formula.text, sources);
  try {
    const Value worked_out = value(formula);
    const Teuchos::ParameterEntry& entry = worked_out.entry;
    if (!worked_out.quantities.empty()) quantities_.emplace(name, *worked_out.quantities.front());
    if (entry.isType<double>())
      numbers_[name] = Teuchos::any_cast<double>(entry.getAny(false));
    else if (entry.isType<int>())
      numbers_[name] = Teuchos::any_cast<int>(entry.getAny(false));
    else
      texts_[name] = entry_text(entry);
  } catch (const InputError& error) {
    fail(error.what());
  }
  begun_.pop_back();
}

void Variables::check_word(const std::string& word) const {
  if (numbers_.count(word) > 0) return;
  if (texts_.count(word) > 0) throw InputError("the variable '" + word + "' is a text, no number");
  if (is_coordinate(word))
    throw InputError("'" + word +
                     "' has no value here: only functions, which are of the type string, know time and place");
  if (means_something(word)) return;
  std::vector<std::string> names;
  for (const auto& entry : numbers_) names.push_back(entry.first);
  for (const auto& entry : texts_) names.push_back(entry.first);
  throw InputError("there is no variable '" + word + "'" + suggestion(word, names));
}

Variables::Number Variables::number(const std::string& expression) const {
  if (const auto quantity = parse_quantity(expression)) return {quantity->plain(), quantity};
  std::string text = expression;
  std::replace(text.begin(), text.end(), '{', '(');
  std::replace(text.begin(), text.end(), '}', ')');
  if (const std::string why = why_no_number(expression); !why.empty())
    throw InputError("expected a number, given '" + expression + "'" + why);
  for (const std::string& word : words_of(text)) check_word(word);
  const std::string inside = bare(expression);
  const auto named = quantities_.find(inside.empty() ? trim(expression) : inside);
  return {constant_value(trim(text), numbers_),
          named == quantities_.end() ? std::nullopt : std::optional<ValueWithUnit>(named->second)};
}

int Variables::integer(const std::string& expression) const {
  const Number worked_out = number(expression);
  const double found = worked_out.value;
  if (worked_out.quantity) throw InputError("expected an integer (int), given '" + worked_out.quantity->text + "'");
  if (found != std::floor(found) || std::abs(found) > 2e9)
    throw InputError("expected an integer (int), given '" + expression + "', which is " + number_text(found));
  return static_cast<int>(found);
}

std::string Variables::replaced(const std::string& text) const {
  if (!any()) return text;
  std::string result;
  std::size_t begin = 0;
  for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', begin)) {
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) throw InputError("a '{' that no '}' follows, in '" + text + "'");
    const std::string inside = trim(text.substr(open + 1, close - open - 1));
    const auto word = texts_.find(inside);
    result += text.substr(begin, open - begin);
    result += word != texts_.end() ? word->second : in_expression(number(inside).value);
    begin = close + 1;
  }
  return result + text.substr(begin);
}

Variables::Value Variables::strict_value(const Formula& formula) const {
  const std::string& type = formula.type;
  if (type == "int") return {Teuchos::ParameterEntry(integer(formula.text))};
  if (type == "string" || type == "bool") return {make_entry(type, replaced(formula.text))};
  Value result;
  const auto add = [&](const std::string& text) {
    const Number item = number(text);
    result.quantities.push_back(item.quantity);
    return item.value;
  };
  if (type == "double") {
    result.entry = Teuchos::ParameterEntry(add(formula.text));
  } else {
    const auto items = parse_array(formula.text);
    if (!items) return {make_entry(type, formula.text)};  // which throws
    std::vector<std::string> values;
    for (const std::string& item : *items)
      values.push_back(type == "Array(string)" ? replaced(item)
                       : type == "Array(int)"  ? std::to_string(integer(item))
                                               : number_text(add(item)));
    result.entry = make_entry(type, "{" + join(values) + "}");
  }
  if (std::none_of(result.quantities.begin(), result.quantities.end(),
                   [](const auto& item) { return item.has_value(); }))
    result.quantities.clear();
  return result;
}

Variables::Value Variables::value(const Formula& formula) const {
  if (formula.may_differ) return widest_value(formula);
  try {
    return strict_value(formula);
  } catch (const InputError&) {
    if (any()) throw;
  }
  try {
    return {make_entry(formula.type, formula.text)};
  } catch (const InputError& error) {  // it says what is expected instead of what expressions may hold
    const std::string why = why_no_number(formula.text);
    const std::vector<std::string> words = words_of(formula.text);
    const bool names_one =
        why.empty() && hint_.empty() && formula.type != "bool" && !words.empty() && !parse_number(trim(formula.text));
    throw InputError(error.what() + why + hint_ +
                     (names_one ? "; the deck has no 'variables' that define '" + words.front() + "'" : ""));
  }
}

Variables::Value Variables::widest_value(const Formula& formula) const {
  if (formula.type.empty() && texts_.count(bare(formula.text)) > 0) return strict_value({"string", formula.text});
  for (const char* type : {formula.type.c_str(), "int", "double", "Array(int)", "Array(double)", "Array(string)"}) {
    if (*type == '\0') continue;
    try {
      return strict_value({type, formula.text});
    } catch (const InputError&) {
      continue;  // the text does not fit this type; try the next, wider one
    }
  }
  return strict_value({"string", formula.text});
}

void Variables::replace_formulas(Teuchos::ParameterList& deck, const Sources& sources, ValuesWithUnits& quantities,
                                 const std::string& path) const {
  for (auto it = deck.begin(); it != deck.end(); ++it) {
    const std::string& name = deck.name(it);
    const std::string full = join_path(path, name);
    if (deck.entry(it).isList()) {
      replace_formulas(deck.sublist(name), sources, quantities, full);
    } else if (deck.entry(it).isType<Formula>()) {
      try {
        const Value worked_out = value(formula_of(deck.entry(it)));
        deck.getEntry(name).setAnyValue(worked_out.entry.getAny(), false);
        if (!worked_out.quantities.empty()) quantities[full] = worked_out.quantities;
      } catch (const InputError& error) {
        throw InputError(sources.at(full) + ": " + full + ": " + error.what());
      }
    }
  }
}

void Variables::refuse_unused(const Section& root) const {
  const Section variables = root.section(section_name);
  std::vector<std::string> used = variables.parameter_names();
  used.erase(std::remove_if(used.begin(), used.end(), [&](const auto& name) { return words_.count(name) == 0; }),
             used.end());
  for (const std::string& name : variables.parameter_names()) {
    const std::string near = words_.count(name) == 0 ? nearest(name, used) : "";
    if (words_.count(name) == 0)
      variables.fail("no value names this variable" + (near.empty() ? " (texts name it in braces, {" + name + "})"
                                                                    : " (did you mean '" + near + "'?)"),
                     name);
    variables.list().getEntry(name).getAny();  // now it counts as read
  }
}

}  // namespace mudline
