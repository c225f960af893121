#include "core/csv_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

const std::string byte_order_mark = "\xef\xbb\xbf";  // with which spreadsheets begin a file in UTF-8

std::string trimmed(const std::string& text) {
  constexpr const char* blanks = " \t\r\"";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> cells(const std::string& line, char separator) {
  std::vector<std::string> result{""};
  for (const char c : line) {
    if (c == separator)
      result.emplace_back();
    else
      result.back() += c;
  }
  for (std::string& cell : result) cell = trimmed(cell);
  return result;
}

char separator_of(const std::string& line) {
  const std::string candidates = ",;\t";
  return *std::max_element(candidates.begin(), candidates.end(), [&](char a, char b) {
    return std::count(line.begin(), line.end(), a) < std::count(line.begin(), line.end(), b);
  });
}

}  // namespace

std::vector<std::vector<double>> csv_columns(const std::string& file, const std::vector<std::string>& names) {
  std::ifstream in(file);
  if (!in) throw InputError("the file '" + file + "' cannot be read");
  std::vector<std::vector<double>> result(names.size());
  std::vector<std::string> header;
  std::vector<std::size_t> places;
  char separator = ',';
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (number == 1 && line.compare(0, byte_order_mark.size(), byte_order_mark) == 0)
      line.erase(0, byte_order_mark.size());
    if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
    const auto fail = [&](const std::string& why) {
      throw InputError(file + ":" + std::to_string(number) + ": " + why);
    };
    if (header.empty()) {
      separator = separator_of(line);
      header = cells(line, separator);
      for (const std::string& name : names) {
        const auto place = std::find(header.begin(), header.end(), name);
        if (const std::string bad = unfit(line, true); place == header.end() && !bad.empty())
          fail("the file holds " + bad + "; a CSV file is plain text in UTF-8, not the spreadsheet itself");
        if (place == header.end()) fail("there is no column '" + name + "'" + suggestion(name, header));
        if (std::count(header.begin(), header.end(), name) > 1) fail("two columns are called '" + name + "'");
        places.push_back(place - header.begin());
      }
      continue;
    }
    const std::vector<std::string> row = cells(line, separator);
    if (row.size() != header.size())
      fail(std::to_string(row.size()) + " cells, the first line has " + std::to_string(header.size()) +
           (separator == ',' && row.size() > header.size() ? "; decimals need a point" : ""));
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string& cell = row[places[k]];
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      if (cell.empty() || *end != '\0' || !std::isfinite(value))
        fail("'" + cell + "' in column '" + names[k] + "' is not a number" +
             (cell.find(',') == std::string::npos ? "" : "; decimals need a point"));
      result[k].push_back(value);
    }
  }
  if (result.empty() || result[0].empty()) throw InputError("the file '" + file + "' has no rows of numbers");
  return result;
}

}  // namespace mudline
