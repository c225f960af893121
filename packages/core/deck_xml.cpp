#include "core/deck_xml.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "core/entry.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

const char* explanation(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "an element is not written correctly";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is not written correctly (name=\"value\") or given twice";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "text that no element closes";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
      return "a CDATA block does not end";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment does not end with -->";
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
      return "a declaration <? ?> stands at a wrong place or does not end";
    case tinyxml2::XML_ERROR_PARSING_UNKNOWN:
      return "a <! > block does not end";
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "the file is empty";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "the element opened here has no matching closing tag";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "the elements are nested too deeply";
    case tinyxml2::XML_ERROR_PARSING:
      return "the file ends inside an element; a closing tag is missing";
    default:
      return "it cannot be parsed";
  }
}

/// Replaces any run of white space by one blank, so that a message that shows the text stays on one line.
std::string one_line(const std::string& text) {
  std::string line;
  for (const char c : trim(text))
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n')
      line += c;
    else if (line.empty() || line.back() != ' ')
      line += ' ';
  return line;
}

/// Replaces line breaks and tabs in an attribute by blanks (XML 1.0, section 3.3.3).
std::string attribute_text(const char* value) {
  std::string text = value;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\r' || c == '\n'; }, ' ');
  return text;
}

/// Line of the first section whose closing tag does not stand below its opening tag but further left, so that it is
/// probably that of the section around it; 0: there is none.
int left_open(const std::string& text) {
  std::vector<std::pair<int, std::size_t>> open;  // line and indentation
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t indentation = line.find_first_not_of(" \t");
    if (indentation == std::string::npos) continue;
    const bool opens = line.compare(indentation, 14, "<ParameterList") == 0;
    const bool alone = line.find('<', indentation + 1) == std::string::npos && line.find("/>") != std::string::npos;
    const bool closes = alone || line.find("</ParameterList>") != std::string::npos;
    if (opens && !closes) open.emplace_back(number, indentation);
    if (opens || line.compare(indentation, 16, "</ParameterList>") != 0) continue;
    if (open.empty()) return 0;
    if (indentation < open.back().second) return open.back().first;
    open.pop_back();
  }
  return 0;
}

class Reader {
 public:
  Reader(std::string file, Sources& sources) : file_(std::move(file)), sources_(sources) {}

  void read(const std::string& text, Teuchos::ParameterList& list) {
    std::size_t place = 0;
    if (const std::string bad = unfit(text, true, &place); !bad.empty()) {
      const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place), '\n');
      throw InputError(file_ + ":" + std::to_string(1 + lines) + ": the deck holds " + bad +
                       "; a deck is plain text in UTF-8");
    }
    tinyxml2::XMLDocument document;
    document.Parse(text.c_str(), text.size());
    if (document.Error()) malformed(document, text);
    const tinyxml2::XMLElement* root = nullptr;
    for (const auto* node = document.FirstChild(); node != nullptr; node = node->NextSibling()) {
      if (node->ToText() != nullptr)
        fail(*node, "", "unexpected text '" + beginning(one_line(node->Value()), 40) + "'");
      if (node->ToElement() == nullptr) continue;  // comment or declaration
      if (root != nullptr) fail(*node, "", "a second root element; a deck has one <ParameterList>");
      root = node->ToElement();
    }
    if (root == nullptr) throw InputError(file_ + ":1: malformed XML: there is no <ParameterList>");
    if (std::string(root->Name()) != "ParameterList")
      fail(*root, "", "the root element must be <ParameterList>, given <" + std::string(root->Name()) + ">");
    check_attributes(*root, "", {"name"});
    sources_[""] = position(*root);
    read_children(*root, "", list);
  }

 private:
  std::string position(const tinyxml2::XMLNode& node) const { return file_ + ":" + std::to_string(node.GetLineNum()); }

  [[noreturn]] void fail(const tinyxml2::XMLNode& node, const std::string& path, const std::string& message) const {
    throw InputError(position(node) + ": " + (path.empty() ? "" : path + ": ") + message);
  }

  [[noreturn]] void malformed(const tinyxml2::XMLDocument& document, const std::string& text) const {
    const int line = std::max(1, document.ErrorLineNum());
    const bool open = document.ErrorID() == tinyxml2::XML_ERROR_PARSING ||
                      document.ErrorID() == tinyxml2::XML_ERROR_MISMATCHED_ELEMENT;
    const int from = open ? left_open(text) : 0;
    throw InputError(file_ + ":" + std::to_string(from > 0 ? from : line) + ": malformed XML: " +
                     (from > 0 ? "by its indentation the section that begins here has no closing tag"
                               : explanation(document.ErrorID())));
  }

  void check_attributes(const tinyxml2::XMLElement& element, const std::string& path,
                        const std::vector<std::string>& allowed) const {
    for (const auto* attribute = element.FirstAttribute(); attribute != nullptr; attribute = attribute->Next()) {
      const std::string name = attribute->Name();
      if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
        fail(element, path, "unknown attribute '" + name + "'" + suggestion(name, allowed));
    }
  }

  void read_children(const tinyxml2::XMLElement& parent, const std::string& path, Teuchos::ParameterList& list) {
    for (const auto* node = parent.FirstChild(); node != nullptr; node = node->NextSibling()) {
      if (node->ToText() != nullptr)
        fail(*node, path, "unexpected text '" + beginning(one_line(node->Value()), 40) + "'");
      const auto* element = node->ToElement();
      if (element == nullptr) continue;  // a comment
      const std::string kind = element->Name();
      if (kind == "ParameterList") {
        read_section(*element, path, list);
      } else if (kind == "Parameter") {
        read_parameter(*element, path, list);
      } else {
        fail(*element, path, "unknown element <" + kind + ">" + suggestion(kind, {"ParameterList", "Parameter"}));
      }
    }
  }

  /// Refuses characters that a reference such as "&#27;" stands for and that the file itself may not hold.
  void check_text(const tinyxml2::XMLElement& element, const std::string& path, const std::string& what,
                  const std::string& text) const {
    const std::string bad = unfit(text);
    if (!bad.empty()) fail(element, path, "the " + what + " holds " + bad);
  }

  /// The name attribute; its path must not be taken by another entry of this file.
  std::string new_name(const tinyxml2::XMLElement& element, const std::string& path, const Teuchos::ParameterList& list,
                       const std::string& what) const {
    const char* attribute = element.Attribute("name");
    const std::string name = attribute == nullptr ? "" : attribute_text(attribute);
    if (trim(name).empty()) fail(element, path, "a <" + std::string(element.Name()) + "> has no name");
    const std::string full = join_path(path, name);
    if (name != trim(name)) fail(element, full, "the name begins or ends with a space");
    check_text(element, full, "name", name);
    if (name.find('/') != std::string::npos)
      fail(element, full,
           std::string("a name cannot contain '/', which separates sections") +
               (path == "settings" ? "; is this a sweep? `mudline sweep` runs it" : ""));
    if (list.isParameter(name))
      fail(element, full, "duplicated " + what + " (first given at " + sources_.at(full) + ")");
    return name;
  }

  void read_section(const tinyxml2::XMLElement& element, const std::string& path, Teuchos::ParameterList& list) {
    check_attributes(element, path, {"name"});
    const std::string name = new_name(element, path, list, "section");
    const std::string full = join_path(path, name);
    sources_[full] = position(element);
    read_children(element, full, list.sublist(name));
  }

  void read_parameter(const tinyxml2::XMLElement& element, const std::string& path, Teuchos::ParameterList& list) {
    const char* known = element.Attribute("name");
    check_attributes(element, join_path(path, known == nullptr ? "" : attribute_text(known)),
                     {"name", "type", "value"});
    const std::string name = new_name(element, path, list, "parameter");
    const std::string full = join_path(path, name);
    if (element.FirstChild() != nullptr && element.FirstChild()->ToComment() == nullptr)
      fail(element, full, "a <Parameter> has no content; its value stands in the attribute 'value'");
    for (const char* attribute : {"type", "value"})
      if (element.Attribute(attribute) == nullptr)
        fail(element, full, "the parameter has no " + std::string(attribute));
    sources_[full] = position(element);
    const std::string value = attribute_text(element.Attribute("value"));
    check_text(element, full, "value", value);
    try {
      list.setEntry(name, make_entry_or_formula(attribute_text(element.Attribute("type")), value));
    } catch (const InputError& error) {
      fail(element, full, error.what());
    }
  }

  std::string file_;
  Sources& sources_;
};

void write_list(const Teuchos::ParameterList& list, const std::string& name, tinyxml2::XMLPrinter& printer) {
  printer.OpenElement("ParameterList");
  printer.PushAttribute("name", name.c_str());
  for (auto it = list.begin(); it != list.end(); ++it) {
    const auto& entry = list.entry(it);
    if (entry.isList()) {
      write_list(Teuchos::any_cast<Teuchos::ParameterList>(entry.getAny(false)), list.name(it), printer);
      continue;
    }
    printer.OpenElement("Parameter");
    printer.PushAttribute("name", list.name(it).c_str());
    printer.PushAttribute("type", entry_type(entry).c_str());
    printer.PushAttribute("value", entry_text(entry).c_str());
    printer.CloseElement();
  }
  printer.CloseElement();
}

}  // namespace

void read_xml(const std::string& text, const std::string& file, Teuchos::ParameterList& list, Sources& sources) {
  Reader(file, sources).read(text, list);
}

std::string write_xml(const Teuchos::ParameterList& list) {
  tinyxml2::XMLPrinter printer;
  write_list(list, list.name(), printer);
  return printer.CStr();
}

}  // namespace mudline
