#include "discretisation/geometry_commands.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/confinement.hpp"

namespace mudline {
namespace {

class Geometry : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = std::filesystem::path(folder_.path()) / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  std::string command_in(const std::string& text) const { return system_command(write("a.geo", text)); }

  PrivateFolder folder_;
};

TEST_F(Geometry, CommandsThatReachTheSystem) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"SystemCall \"ls\";", "'SystemCall' starts a program"},
      {"NonBlockingSystemCall \"ls\";", "'NonBlockingSystemCall' starts a program"},
      {"System \"ls\";", "'System' starts a program"},
      {"OnelabRun(\"a\", \"ls\");", "'OnelabRun' starts a program"},
      {"Field[1] = ExternalProcess;", "'ExternalProcess' starts a program"},
      {"Field[1].CommandLine = \"ls\";", "'CommandLine' starts a program"},
      {"Save \"a.msh\";", "'Save' writes a file"},
      {"Save View[0] \"a.pos\";", "'Save' writes a file"},
      {"Save\n\"a.msh\";", "'Save' writes a file"},
      {"Print StrCat(\"a\", \".png\");", "'Print' writes a file"},
      {"CreateDir \"a\";", "'CreateDir' makes a folder"},
      {"Printf(\"%g\", (1)) > \"a.txt\";", "'Printf' with '>' writes a file"},
      {"Printf(\"%g\", 1)\n  >>\n\"a.txt\";", "'Printf' with '>' writes a file"},
      {"Error(\"a\") >> \"a.txt\";", "'Printf' with '>' writes a file"},
      {"General.LogFileName = \"a.log\";", "'LogFileName' writes a file"},
      {"Plugin(A).FileName = \"a\";", "the option 'FileName' of a plugin may write a file"},
      {"Solver.Executable0 = \"a\";", "options of 'Solver' start a program"},
      {"Exit;", "'Exit' ends Gmsh"},
      {"If(1) Save \"a\"; EndIf", "'Save' writes a file"},
      {"x = 1e5; Save \"a\";", "'Save' writes a file"},
      {"Merge Sprintf(\"a%g.geo\", 1);", "is worked out, so that its commands cannot be looked at"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string found = command_in("Point(1) = {0, 0, 0};\n" + text + "\n");
    EXPECT_NE(found.find(expected), std::string::npos) << text << ": " << found;
    EXPECT_EQ(found.find("a.geo:"), 0) << text << ": " << found;
  }
}

TEST_F(Geometry, TheLineIsTold) {
  EXPECT_EQ(command_in("// one\n/* two\n three */\r\nx = \"four\";\nCreateDir \"five\";"),
            "a.geo:5: 'CreateDir' makes a folder");
}

TEST_F(Geometry, TextsAndCommentsAreNoCommands) {
  for (const std::string text : {
           "// Save \"a.msh\"; does not happen, don't worry",
           "/* Save \"a.msh\";\n SystemCall \"ls\"; it isn't done */ Point(1) = {0, 0, 0};",
           "Physical Surface(\"Save soil\") = {1}; Physical Curve('Print') = {2};",
           "Printf(\"a > b: %g\", a > b); x = a > b; y = (a) >= b;",
           "Print.Background = 1; Mesh.SaveAll = 1; General.Verbosity = 2; Save = 3; x = Save + 1; Foo(Save);",
           "Plugin(Crack).Dimension = 1; Plugin(Crack).Run;",
           "Field[1] = Structured; Field[1].FileName = \"sizes.txt\";",
           "x = 3; // Returns; EndIf of what stands above",
           "",
       })
    EXPECT_EQ(command_in(text), "") << text;
}

TEST_F(Geometry, WhatGmshReadsInAnotherWayThanItLooks) {
  for (const std::string text : {
           "If(0) \" EndIf\nSave \"a\";\nEndIf",         // the end of a condition in a string
           "If(0) /* EndIf\nSave \"a\"; */\nEndIf",      // and in a comment
           "For i In {0:1} /*\nSave \"a\";\n*/ EndFor",  // read the second time from the line's beginning
           "Include \"b.geo\"; /*\nSave \"a\";\n*/",     // the rest of the line is lost
           "Macro f '\nSave \"a\";\n'\nReturn\nCall f;",
       })
    EXPECT_NE(command_in(text).find("'Save' writes a file"), std::string::npos) << text << command_in(text);
  EXPECT_NE(command_in("x = \"" + std::string(1100, 'a') + " Save 'b'; \";").find("of more than 1000"),
            std::string::npos);
  EXPECT_NE(command_in("// a\rSave \"b\";").find("carriage return"), std::string::npos);
  EXPECT_NE(command_in(std::string("/* \0 */", 7)).find("NUL"), std::string::npos);
}

TEST_F(Geometry, FilesThatItReads) {
  const std::string harm = "\nSave \"a\";\n", harmless = "Point(1) = {0, 0, 0};\n";
  write("parts/b.geo", harm);
  write("parts/c.geo", harmless + "Include \"b.geo\";");
  write("ring.geo", harmless + "Include \"ring.geo\";");
  write("good.geo", harmless);
  write("mesh.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + harm);
  write("model.step", harm);
  write("no_mesh.msh", harm);
  const std::string found = "b.geo:2: 'Save' writes a file";
  EXPECT_EQ(command_in("Include \"parts/b.geo\";"), found);
  EXPECT_EQ(command_in("Merge 'parts/c.geo';"), found);
  EXPECT_EQ(command_in("Merge StrCat[CurrentDirectory, \"parts/\", \"c.geo\"];"), found);
  EXPECT_EQ(command_in("Merge \"no_mesh.msh\";"), "no_mesh.msh:2: 'Save' writes a file");
  EXPECT_EQ(command_in("Include \"mesh.msh\";"), "mesh.msh:5: 'Save' writes a file");  // whatever kind of file it is
  EXPECT_EQ(command_in("Merge \"mesh.msh\"; Merge \"model.step\"; Include \"good.geo\"; Merge \"none.geo\";"), "");
  EXPECT_EQ(system_command(folder_.path() + "/ring.geo"), "");
  EXPECT_EQ(command_in("Include \"good.geo\";\n\n" + harm), "a.geo:4: 'Save' writes a file");
  // options beside any file, which Gmsh reads with it
  write("mesh.msh.opt", harm);
  EXPECT_EQ(system_command(folder_.path() + "/mesh.msh"), "mesh.msh.opt:2: 'Save' writes a file");
  EXPECT_EQ(command_in("Merge \"mesh.msh\";"), "mesh.msh.opt:2: 'Save' writes a file");
}

TEST_F(Geometry, WhatGmshTakesForData) {
  const auto content = [&](const std::string& name, const std::string& text) {
    return gmsh_content(write(name, text));
  };
  EXPECT_EQ(content("a.msh", "$MeshFormat\n4.1 0 8\n"), GmshContent::data);
  EXPECT_EQ(content("b.msh", "$NOD\n1\n"), GmshContent::data);
  EXPECT_EQ(content("c.step", "anything"), GmshContent::data);
  EXPECT_EQ(content("c.STEP", "anything"), GmshContent::data);
  EXPECT_EQ(content("c.Step", "anything"), GmshContent::commands);
  EXPECT_EQ(content("d.msh", "\n$MeshFormat\n"), GmshContent::commands);
  EXPECT_EQ(content("e.msh", ""), GmshContent::commands);
  EXPECT_EQ(content("f.msh.gz", "$MeshFormat\n"), GmshContent::commands);
}

}  // namespace
}  // namespace mudline
