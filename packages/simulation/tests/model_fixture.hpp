#pragma once

#include <Tpetra_Core.hpp>

#include <functional>
#include <memory>
#include <string>

#include "core/deck.hpp"
#include "simulation/model.hpp"

namespace mudline::testing {

/// A model built from deck text, with everything it refers to.
struct ModelFixture {
  /// `more`: registers further types of a test.
  explicit ModelFixture(const std::string& xml, const std::function<void(Registries&)>& more = {}) {
    deck.overlay(xml, "test.xml");
    register_all(registries);
    if (more) more(registries);
    root = std::make_unique<Section>(deck.root());
    model = std::make_unique<Model>(Tpetra::getDefaultComm(), *root, registries);
  }
  Deck deck;
  Registries registries;
  std::unique_ptr<Section> root;
  std::unique_ptr<Model> model;
};

/// Text of "<ParameterList name=...>body</ParameterList>" and of parameters, to keep decks in tests short.
inline std::string list(const std::string& name, const std::string& body) {
  return "<ParameterList name=\"" + name + "\">" + body + "</ParameterList>\n";
}
inline std::string par(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}
inline std::string text(const std::string& name, const std::string& value) { return par(name, "string", value); }
inline std::string number(const std::string& name, double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return par(name, "double", buffer);
}

}  // namespace mudline::testing
