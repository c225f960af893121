#include "core/documentation.hpp"

#include <algorithm>

#include "core/text.hpp"

namespace mudline {

namespace {

using Row = std::vector<std::string>;
using Sections = std::vector<Parameters::SubsectionDoc>;

std::string allowed_text(const ParameterDoc& doc) { return doc.choices.empty() ? doc.range : join(doc.choices, " | "); }

Row row_of(const ParameterDoc& doc) {
  return {doc.name,          doc.type + (doc.may_vary ? " or function" : ""), doc.unit,
          allowed_text(doc), doc.required ? "required" : doc.default_text,    doc.doc};
}

std::vector<Row> rows_of(const std::vector<ParameterDoc>& parameters) {
  std::vector<Row> rows{{"parameter", "type", "unit", "range", "default", "meaning"}};
  for (const ParameterDoc& doc : parameters) rows.push_back(row_of(doc));
  return rows;
}

/// The number of characters, not bytes: units hold superscripts in UTF-8.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0U) != 0x80U; }));
}

std::string aligned_table(const std::vector<ParameterDoc>& parameters, const std::string& margin) {
  const auto rows = rows_of(parameters);
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  std::string text;
  for (const Row& row : rows) {
    std::string line = margin;
    for (std::size_t i = 0; i < row.size(); ++i) line += row[i] + std::string(widths[i] - width(row[i]) + 2, ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string passed_on_text(const Parameters::SubsectionDoc& section) {
  return section.passed_on ? " (its entries are documented where they are read)" : "";
}

void explain_body(const std::vector<ParameterDoc>& parameters, const Sections& sections, const std::string& margin,
                  std::string& text) {
  if (!parameters.empty()) text += aligned_table(parameters, margin);
  for (const auto& section : sections) {
    text += "\n" + margin + "section '" + section.name + "': " + section.doc + passed_on_text(section) + "\n";
    explain_body(section.parameters, section.sections, margin + "  ", text);
  }
}

std::string markdown_cell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '_') cell += '\\';
    cell += c == '\n' ? ' ' : c;
  }
  return cell;
}

void markdown_body(const std::vector<ParameterDoc>& parameters, const Sections& sections, const std::string& path,
                   std::string& text) {
  if (!parameters.empty()) {
    const auto rows = rows_of(parameters);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      text += "|";
      for (const std::string& cell : rows[i]) text += " " + markdown_cell(cell) + " |";
      text += i == 0 ? "\n|---|---|---|---|---|---|\n" : "\n";
    }
    text += "\n";
  }
  for (const auto& section : sections) {
    const std::string full = join_path(path, section.name);
    text += "### Section " + full + "\n\n" + section.doc + passed_on_text(section) + "\n\n";
    markdown_body(section.parameters, section.sections, full, text);
  }
}

/// Makes a text fit for an XML comment, which must not hold "--".
std::string comment(std::string text) {
  for (auto i = text.find("--"); i != std::string::npos; i = text.find("--", i)) text.replace(i, 2, "- -");
  return "<!-- " + text + " -->\n";
}

/// The XML type of a documented type: words of a choice, paths and expressions are strings.
std::string xml_type(const ParameterDoc& doc) {
  if (doc.type == "array of doubles") return "Array(double)";
  if (doc.type == "array of strings") return "Array(string)";
  if (doc.type == "function") return !doc.required && parse_number(doc.default_text) ? "double" : "string";
  return doc.type == "choice" || doc.type == "file" ? "string" : doc.type;
}

std::string note(const ParameterDoc& doc) {
  std::string text = doc.required ? "REQUIRED. " : "";
  text += doc.doc;
  if (!doc.unit.empty()) text += " [" + doc.unit + "]";
  const std::string allowed = allowed_text(doc);
  if (!allowed.empty() && allowed != "any") text += "; " + allowed;
  return text;
}

std::string xml_parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + xml_escaped(name) + "\" type=\"" + type + "\" value=\"" + xml_escaped(value) + "\"/>";
}

void xml_body(const std::vector<ParameterDoc>& parameters, const Sections& sections, const std::string& margin,
              std::string& text) {
  for (const ParameterDoc& doc : parameters) {
    text += margin + comment(note(doc));
    const std::string line = xml_parameter(doc.name, xml_type(doc), doc.default_text);
    const bool nothing_to_show = !doc.required && doc.default_text.empty();
    text += margin + (nothing_to_show ? comment(line) : line + "\n");
  }
  for (const auto& section : sections) {
    text += margin + comment(section.doc + passed_on_text(section));
    text += margin + "<ParameterList name=\"" + xml_escaped(section.name) + "\">\n";
    xml_body(section.parameters, section.sections, margin + "  ", text);
    text += margin + "</ParameterList>\n";
  }
}

}  // namespace

std::string explain(const EntryDoc& entry) {
  std::string text = entry.name + " (" + entry.kind + ")\n  " + entry.summary + "\n\n";
  explain_body(entry.parameters, entry.sections, "  ", text);
  return text;
}

std::string markdown(const EntryDoc& entry) {
  std::string text = "## " + entry.name + " (" + entry.kind + ")\n\n" + entry.summary + "\n\n";
  markdown_body(entry.parameters, entry.sections, "", text);
  return text;
}

std::string xml_template(const EntryDoc& entry, int indent, const std::string& name) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  std::string text = margin + "<ParameterList name=\"" + xml_escaped(name.empty() ? entry.kind : name) + "\">\n";
  text += margin + "  " + comment(entry.summary);
  const bool declares_type = std::any_of(entry.parameters.begin(), entry.parameters.end(),
                                         [](const ParameterDoc& doc) { return doc.name == "type"; });
  if (!declares_type) text += margin + "  " + xml_parameter("type", "string", entry.name) + "\n";
  xml_body(entry.parameters, entry.sections, margin + "  ", text);
  return text + margin + "</ParameterList>\n";
}

}  // namespace mudline
