#include "core/guarded.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "core/deck.hpp"
#include "core/registry.hpp"

namespace mudline {
namespace {

TEST(Guarded, LastLineWithSomethingInIt) {
  EXPECT_EQ(last_line("one\n two \n \n"), " two");
  EXPECT_EQ(last_line("one"), "one");
  EXPECT_EQ(last_line(" \n"), "");
}

struct Interface {
  virtual ~Interface() = default;
};

struct Thrower : Interface {
  int kind = 0;
  void parameters(Parameters& p) { p.add("kind", kind, "-", any(), ""); }
  void check(const Section& section) {
    if (kind == 1) throw 1;
    if (kind == 2) throw "text";
    if (kind == 3) throw std::runtime_error("Teuchos says\n\nwhat happened\n");
    if (kind == 4) throw std::logic_error("");
    if (kind == 6) throw std::bad_alloc();
    if (kind == 7) throw std::length_error("cannot create std::vector larger than max_size()");
    if (kind == 5) section.fail("its own words", "kind");
  }
};

std::string refusal(int kind) {
  Registry<Interface> registry("thing");
  registry.add<Thrower>("thrower", "");
  Deck deck;
  deck.overlay(
      "<ParameterList name=\"d\">\n<ParameterList name=\"x\">\n<Parameter name=\"type\" type=\"string\" "
      "value=\"thrower\"/>\n<Parameter name=\"kind\" type=\"int\" value=\"" +
          std::to_string(kind) + "\"/>\n</ParameterList>\n</ParameterList>\n",
      "deck.xml");
  try {
    registry.create(deck.root().section("x"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Guarded, WhateverAnObjectThrowsIsAnErrorOfItsType) {
  const std::string begin = "deck.xml:3: x/type: the thing cannot be made: ";
  EXPECT_EQ(refusal(0), "");
  EXPECT_EQ(refusal(1), begin + "something that is no std::exception");
  EXPECT_EQ(refusal(2), begin + "something that is no std::exception");
  EXPECT_EQ(refusal(3), begin + "what happened");
  EXPECT_EQ(refusal(4), begin + "an exception without a message");
  EXPECT_EQ(refusal(5), "deck.xml:4: x/kind: its own words");
}

TEST(Guarded, ExhaustedMemoryIsNoErrorOfTheDeck) {
  EXPECT_THROW(refusal(6), std::bad_alloc);
  EXPECT_THROW(refusal(7), std::length_error);
  try {
    refusal(6);
  } catch (...) {
    EXPECT_EQ(what_was_thrown().find("not enough memory for this model"), 0u);
  }
}

}  // namespace
}  // namespace mudline
