#pragma once

#include <string>
#include <vector>

namespace mudline {

/// Columns of numbers of a CSV file, by the names in its first line, in the order of `names`. Cells are separated by
/// commas, semicolons or tabs, by the one that the first line has most of; empty lines and lines that begin with # are
/// skipped, and so is a byte order mark. InputError with file and line where a name is missing or stands twice, where a
/// line has another number of cells, or where a cell of these columns is not a finite number.
std::vector<std::vector<double>> csv_columns(const std::string& file, const std::vector<std::string>& names);

}  // namespace mudline
