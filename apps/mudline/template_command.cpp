#include <algorithm>
#include <fstream>
#include <iostream>

#include "commands.hpp"
#include "core/documentation.hpp"

namespace mudline::cli {

namespace {

// A complete deck: a column under load. %S% lines are for saturated soil only, %D% ones for a single-phase solid.
constexpr const char* column_deck =
    R"deck(<!-- A column under load, to be turned into your own model. Units are SI. `mudline list` names what a "type"
     may be, `mudline explain TYPE` its parameters, `mudline template TYPE` a section to copy from. -->
<ParameterList name="deck">
  <ParameterList name="mesh">
    <Parameter name="type" type="string" value="box"/>                    <!-- or gmsh: a .geo or .msh file -->
    <Parameter name="geometry" type="string" value="plane strain"/>       <!-- or axisymmetric -->
    <Parameter name="cell" type="string" value="quad9"/>                  <!-- or tri6 -->
    <Parameter name="cells" type="Array(int)" value="{2, 20}"/>
    <Parameter name="upper" type="Array(double)" value="{1.0, 10.0}"/>    <!-- sides: left right bottom top -->
  </ParameterList>
  <ParameterList name="materials">
    <ParameterList name="soil">                                       <!-- any name; "regions" picks mesh regions -->
%S%      <Parameter name="void ratio" type="double" value="0.8"/>
%S%      <Parameter name="grain density" type="double" value="2700"/>
%D%      <Parameter name="density" type="double" value="2000"/>
      <ParameterList name="skeleton">
        <Parameter name="type" type="string" value="linear elastic"/>     <!-- or modified cam clay -->
        <Parameter name="Young's modulus" type="double" value="1e7"/>
        <Parameter name="Poisson's ratio" type="double" value="0.3"/>
      </ParameterList>
%S%      <ParameterList name="fluid">
%S%        <Parameter name="type" type="string" value="water"/>
%S%      </ParameterList>
%S%      <ParameterList name="permeability">
%S%        <Parameter name="type" type="string" value="constant"/>           <!-- or kozeny-carman, log-linear -->
%S%        <Parameter name="hydraulic conductivity" type="double" value="1e-5"/>
%S%      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="physics">
    <ParameterList name="ground">
      <Parameter name="type" type="string" value="%P%"/>
      <Parameter name="gravity" type="Array(double)" value="{0.0, 0.0}"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="boundary conditions">
    <ParameterList name="base">
      <Parameter name="type" type="string" value="fixed"/>
      <Parameter name="set" type="string" value="bottom"/>
    </ParameterList>
    <ParameterList name="left side">
      <Parameter name="type" type="string" value="fixed"/>
      <Parameter name="set" type="string" value="left"/>
      <Parameter name="components" type="string" value="x"/>
    </ParameterList>
    <ParameterList name="right side">
      <Parameter name="type" type="string" value="fixed"/>
      <Parameter name="set" type="string" value="right"/>
      <Parameter name="components" type="string" value="x"/>
    </ParameterList>
%S%    <ParameterList name="drained surface">
%S%      <Parameter name="type" type="string" value="pore pressure"/>
%S%      <Parameter name="set" type="string" value="top"/>
%S%    </ParameterList>
    <ParameterList name="load">
      <Parameter name="type" type="string" value="pressure"/>
      <Parameter name="set" type="string" value="top"/>
      <Parameter name="value" type="string" value="1e4*min(t, 1)"/>   <!-- a number, a formula, or a function's name -->
    </ParameterList>
  </ParameterList>
  <ParameterList name="stages">
    <ParameterList name="loading">
      <Parameter name="type" type="string" value="quasi-static"/>         <!-- or geostatic, dynamic -->
      <Parameter name="duration" type="double" value="100.0"/>
      <ParameterList name="time step">
        <Parameter name="initial" type="double" value="0.1"/>
        <Parameter name="growth" type="double" value="1.2"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="output">
    <Parameter name="field interval" type="double" value="20.0"/>
    <ParameterList name="probes">
      <Parameter name="top" type="Array(double)" value="{0.5, 10.0}"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
)deck";

std::string deck_of(const std::string& physics) {
  const std::string keep = physics == "biot" ? "%S%" : "%D%", text = column_deck;
  std::string result, line;
  for (char c : text) {
    line += c;
    if (c != '\n') continue;
    const std::string mark = line.substr(0, 3);
    if (mark == keep) line.erase(0, 3);
    if (mark != "%S%" && mark != "%D%" ? true : mark == keep) result += line;
    line.clear();
  }
  return result.replace(result.find("%P%"), 3, physics);
}

}  // namespace

int print_template(const std::string& name) {
  const std::vector<EntryDoc> docs = documentation("");
  if (name == "biot" || name == "solid") {
    if (rank() == 0) std::cout << deck_of(name);
    return 0;
  }
  std::vector<std::string> names = base_decks();
  if (std::find(names.begin(), names.end(), name) != names.end()) {
    if (rank() == 0) std::cout << std::ifstream(base_deck_file(name)).rdbuf();
    return 0;
  }
  for (const EntryDoc& entry : docs) {
    names.push_back(entry.name);
    if (entry.name != name) continue;
    if (rank() == 0) std::cout << xml_template(entry);
    return 0;
  }
  throw InputError("nothing is called '" + name + "'" + suggestion(name, names));
}

}  // namespace mudline::cli
