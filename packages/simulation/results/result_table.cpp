#include "simulation/results/result_table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

Result* ResultTable::at(const std::string& stage, const std::string& of, const std::string& quantity) {
  const auto found = std::find_if(results_.begin(), results_.end(), [&](const Result& result) {
    return result.stage == stage && result.of == of && result.quantity == quantity;
  });
  return found == results_.end() ? nullptr : &*found;
}

const Result* ResultTable::find(const std::string& stage, const std::string& of, const std::string& quantity) const {
  return const_cast<ResultTable*>(this)->at(stage, of, quantity);
}

void ResultTable::set(const std::string& stage, const std::string& of, const std::string& quantity,
                      const std::string& unit, double value) {
  if (!std::isfinite(value))
    throw std::invalid_argument("the result '" + quantity + "' of '" + of + "' is " + number_text(value));
  if (Result* const old = at(stage, of, quantity))
    old->value = value;
  else
    results_.push_back({stage, of, quantity, unit, value});
}

void ResultTable::remove(const std::string& stage, const std::string& of, const std::string& quantity) {
  if (const Result* const old = find(stage, of, quantity)) results_.erase(results_.begin() + (old - results_.data()));
}

std::string ResultTable::csv() const {
  std::string text = "stage,of,quantity,value,unit\n";
  for (const Result& r : results_)
    text += csv_cell(r.stage) + ',' + csv_cell(r.of) + ',' + csv_cell(r.quantity) + ',' + number_text(r.value) + ',' +
            csv_cell(r.unit) + '\n';
  return text;
}

std::string ResultTable::lines() const {
  std::string text;
  for (const Result& r : results_)
    text += r.stage + '\t' + r.of + '\t' + r.quantity + '\t' + r.unit + '\t' + number_text(r.value) + '\n';
  return text;
}

ResultTable ResultTable::from_lines(const std::string& text) {
  ResultTable table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    Result r;
    std::string number;
    for (std::string* cell : {&r.stage, &r.of, &r.quantity, &r.unit, &number}) std::getline(cells, *cell, '\t');
    const auto value = parse_number(number);
    if (!value || !std::isfinite(*value)) throw InputError("the value '" + number + "' of a result is no number");
    r.value = *value;
    table.results_.push_back(r);
  }
  return table;
}

}  // namespace mudline
