#include <set>

#include "core/documentation.hpp"
#include "core/entry.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

using Words = std::set<std::string>;

void collect_names(const std::vector<ParameterDoc>& parameters, const std::vector<Parameters::SubsectionDoc>& sections,
                   Words& parameter_names, Words& section_names, Words& values) {
  for (const ParameterDoc& doc : parameters) {
    parameter_names.insert(doc.name);
    values.insert(doc.choices.begin(), doc.choices.end());
  }
  for (const auto& section : sections) {
    section_names.insert(section.name);
    collect_names(section.parameters, section.sections, parameter_names, section_names, values);
  }
}

template <class Container>
std::string enumeration(const Container& words, const std::string& margin) {
  std::string text = margin + "<xs:restriction base=\"xs:string\">\n";
  for (const std::string& word : words) text += margin + "  <xs:enumeration value=\"" + xml_escaped(word) + "\"/>\n";
  return text + margin + "</xs:restriction>\n";
}

/// The union with xs:string lets editors offer the words while any other text stays valid.
std::string open_choice(const std::string& type_name, const Words& words) {
  return "  <xs:simpleType name=\"" + type_name +
         "\">\n    <xs:union memberTypes=\"xs:string\">\n      <xs:simpleType>\n" + enumeration(words, "        ") +
         "      </xs:simpleType>\n    </xs:union>\n  </xs:simpleType>\n";
}

}  // namespace

std::string xsd(const std::vector<EntryDoc>& entries) {
  Words parameter_names{"type"}, section_names, values;
  for (const EntryDoc& entry : entries) {
    values.insert(entry.name);
    collect_names(entry.parameters, entry.sections, parameter_names, section_names, values);
  }
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
  <xs:element name="ParameterList" type="section"/>
  <xs:complexType name="section">
    <xs:choice minOccurs="0" maxOccurs="unbounded">
      <xs:element name="ParameterList" type="section"/>
      <xs:element name="Parameter" type="parameter"/>
    </xs:choice>
    <xs:attribute name="name" type="section_name"/>
  </xs:complexType>
  <xs:complexType name="parameter">
    <xs:attribute name="name" type="parameter_name" use="required"/>
    <xs:attribute name="type" use="required">
      <xs:simpleType>
)" + enumeration(entry_types(), "        ") +
         R"(      </xs:simpleType>
    </xs:attribute>
    <xs:attribute name="value" type="value" use="required"/>
  </xs:complexType>
)" + open_choice("section_name", section_names) +
         open_choice("parameter_name", parameter_names) + open_choice("value", values) + "</xs:schema>\n";
}

}  // namespace mudline
