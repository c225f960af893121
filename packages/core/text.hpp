#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mudline {

/// `text` without white space at its ends.
std::string trim(const std::string& text);

/// The text with small letters; others than those of ASCII stay.
std::string lower_case(std::string text);

/// The shortest text that reads back as the same number: "0.1", "1e-06".
std::string number_text(double value);
/// "(0.1, -2)": `count` numbers, each written by number_text().
std::string tuple_text(const double* numbers, std::size_t count);

/// The whole of `text` as a number; it may be inf or nan, so that the caller can say so. Independent of the locale.
std::optional<double> parse_number(const std::string& text);
std::optional<int> parse_integer(const std::string& text);
/// Accepts only "true" and "false".
std::optional<bool> parse_bool(const std::string& text);
/// "{a, b}" -> a, b (trimmed); "{}" -> nothing in it. Commas within further braces or parentheses do not separate. No
/// value when the braces are missing or an item is empty.
std::optional<std::vector<std::string>> parse_array(const std::string& text);

/// "materials" + "clay" -> "materials/clay"; the root's path is "".
std::string join_path(const std::string& parent, const std::string& name);

/// The first part of `text` that no name or value may hold: "" or "the byte 0xe9, which is not UTF-8", "the control
/// character 0x1b". `lines`: line breaks and tabs are allowed. `place`, where given, gets the number of bytes before
/// that part.
std::string unfit(const std::string& text, bool lines = false, std::size_t* place = nullptr);

/// The text, cut to its beginning, "abc ...", where it has more than `bytes` bytes.
std::string beginning(const std::string& text, std::size_t bytes);

/// A message that is safe to show in a terminal: control characters and bytes that are not UTF-8 become "\\x1b", and a
/// very long message is cut to its beginning and end.
std::string printable(const std::string& message);

/// The bytes of a file; empty where it cannot be read.
std::optional<std::string> file_content(const std::string& path);

/// `text` as a cell of a CSV (RFC 4180): quoted where its content would break the line.
std::string csv_cell(const std::string& text);

/// `text` as the value or content of an XML element or attribute.
std::string xml_escaped(const std::string& text);

}  // namespace mudline
