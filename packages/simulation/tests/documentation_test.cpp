// What the commands `explain` and `template` say about every name that is registered.
#include "core/documentation.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include "simulation/registries.hpp"

namespace mudline {
namespace {

std::vector<EntryDoc> documentation() {
  Registries registries;
  register_all(registries);
  return document_all(registries);
}

TEST(Documentation, EveryNameIsExplained) {
  const std::vector<EntryDoc> entries = documentation();
  EXPECT_GT(entries.size(), 35u);
  for (const EntryDoc& entry : entries) {
    EXPECT_EQ(explain(entry).rfind(entry.name + " (" + entry.kind + ")", 0), 0u) << explain(entry);
    EXPECT_FALSE(entry.summary.empty()) << entry.name;
  }
}

TEST(Documentation, EveryTemplateIsWellFormedAndNamesAllParameters) {
  for (const EntryDoc& entry : documentation()) {
    const std::string text = xml_template(entry);
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.Parse(text.c_str()), tinyxml2::XML_SUCCESS) << entry.name << "\n" << text;
    for (const auto& parameter : entry.parameters)
      EXPECT_NE(text.find('"' + parameter.name + '"'), std::string::npos) << entry.name << ": " << parameter.name;
  }
}

}  // namespace
}  // namespace mudline
