// fuzz_deck SECONDS SEED deck.xml...: mutated decks are either read, and read back the same after they are written, or
// are refused in one line.
#include "core/deck.hpp"
#include "core/errors.hpp"
#include "fuzz.hpp"

namespace {

using namespace mudline;

const std::vector<std::string> words{"<ParameterList name=\"a\">",
                                     "</ParameterList>",
                                     "<Parameter ",
                                     "type=\"Array(int)\"",
                                     "value=\"{1, 2}\"",
                                     "<!--",
                                     "-->",
                                     "<![CDATA[",
                                     "&#x0;",
                                     "&amp;",
                                     "1e999",
                                     "-nan",
                                     "\"",
                                     "'",
                                     "{",
                                     "}",
                                     "/",
                                     "10*sin(t)",
                                     "\xff",
                                     std::string(1, '\0')};

std::string read_and_write(const std::string& text) {
  Deck deck;
  deck.overlay(text, "deck.xml");
  const std::string written = deck.to_xml();
  Deck again;
  again.overlay(written, "again.xml");
  if (again.to_xml() != written) return "the deck that is written is not the one that was read";
  deck.set("stages/push/time step/initial=" + text.substr(0, text.size() % 40));
  deck.root();
  return "";
}

}  // namespace

int main(int argc, char** argv) {
  return mudline::fuzz::run_on_files(argc, argv, "fuzz_deck", ".xml", words, [](const std::string& text) {
    return mudline::fuzz::fault_of([&] { return read_and_write(text); });
  });
}
