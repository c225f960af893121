"""Plugins as their authors meet them: install mudline, build the examples out of tree with find_package, run their decks.

From the environment: MUDLINE_BUILD, the build folder to install from; MUDLINE_CXX, its compiler.
"""
import concurrent.futures
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import h5py
import mudline_case
import numpy as np
from mudline_case import ROOT, History, MudlineCase, program
from references import heat

LAUNCHER = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []

OTHER_ABI = """extern "C" const char* mudline_plugin_abi() { return "interface 0; gcc 4; Trilinos 12.0; debug"; }
namespace mudline { struct Registries; }
extern "C" void mudline_plugin_register(mudline::Registries&) { __builtin_trap(); }
"""
TAG = """
#include "framework/physics.hpp"
#include "physics/soil.hpp"
#include "simulation/plugin.hpp"
namespace {
using namespace mudline;
class Paint : public Term {
 public:
  Paint(const Space& space, std::shared_ptr<Soil> soil) : space_(space), soil_(std::move(soil)) {}
  std::string name() const override { return "paint"; }
  Role role() const override { return Role::none; }
  void declare_state(StateStore& store) override {
    for (const SoilBlock& b : soil_->blocks)
      handles_.push_back(store.declare(ArrayInfo::at_points("tag", {{"origin", 1, "m"}}, space_.mesh(), b.block, b.points)));
  }
  int residual(const StepView& view, const ResidualView&) override {
    for (int h : handles_) Kokkos::deep_copy(view.trial->arrays[h], view.committed->arrays[h]);
    return 0;
  }
  void jacobian(const StepView&, Assembler&, double) override {}
  void start(StateStore& store) const {
    for (std::size_t i = 0; i < handles_.size(); ++i)
      for (int row = 0; row < static_cast<int>(store.committed().arrays[handles_[i]].extent(0)); ++row) {
        const SoilBlock& b = soil_->blocks[i];
        double y = 0;
        for (int a = 0; a < b.u.nodes; ++a)
          y += b.u.N(row % b.points, a) * space_.mesh().coordinates()(b.nodes(row / b.points, a), 1);
        store.committed().arrays[handles_[i]](row, 0) = y;
      }
  }
 private:
  const Space& space_;
  std::shared_ptr<Soil> soil_;
  std::vector<int> handles_;
};
class Tag : public Physics {
 public:
  void parameters(Parameters&) {}
  std::vector<Field> fields() const override { return {}; }
  void build(PhysicsContext& context, const Section&) override {
    auto term = std::make_unique<Paint>(context.space, context.shared.find<Soil>());
    paint_ = term.get();
    context.terms.push_back(std::move(term));
  }
  void initialise(StateStore& store, const Section&) override { paint_->start(store); }
 private:
  const Paint* paint_ = nullptr;
};
}
MUDLINE_PLUGIN(registries) { registries.physics.add<Tag>("tag", "the height that soil comes from"); }
"""
ALARM = """
#include "simulation/model.hpp"
#include "simulation/observer.hpp"
#include "simulation/output/field_file.hpp"
#include "simulation/output/history_file.hpp"
#include "simulation/plugin.hpp"
#include "simulation/results/result_table.hpp"
namespace {
using namespace mudline;
class Alarm : public Observer {
 public:
  void parameters(Parameters& p) {
    p.add("objects at", objects_at_, "-", non_negative(), "Step from which it objects; 0: never");
    p.add("throws at", throws_at_, "-", non_negative(), "Step in which it throws, on the last rank; 0: never");
  }
  void declare_state(Model& model) override { model.store().declare(ArrayInfo::of_model("alarm", {{"steps", 1, "-"}})); }
  void step(const RunView& run) override {
    run.state.arrays[run.model.store().find("alarm")](0, 0) += 1;
    const auto& comm = *run.model.mesh().comm();
    if (run.step == throws_at_ && comm.getRank() == comm.getSize() - 1) throw 7;
  }
  std::string objection(const RunView& run) override {
    return objects_at_ > 0 && run.step >= objects_at_ ? "enough after step " + std::to_string(run.step) : "";
  }
  void columns(const RunView& run, std::vector<HistoryValue>& to) override {
    to.push_back({"alarm/half", "-", 0.5 * run.state.arrays[run.model.store().find("alarm")](0, 0)});
  }
  void results(const RunView& run, ResultTable& to) override { to.set(run.stage.name, "alarm", "rings", "-", run.step); }
  void cell_fields(const RunView& run, std::vector<OutputField>& to) override {
    std::vector<double> ids;
    for (const ElementBlock& block : run.model.mesh().blocks()) ids.insert(ids.end(), block.global_ids.begin(), block.global_ids.end());
    to.push_back({"alarm/id", "-", 1, ids});
  }
 private:
  int objects_at_ = 0, throws_at_ = 0;
};
}
MUDLINE_PLUGIN(registries) { registries.observers.add<Alarm>("alarm", "counts steps"); }
"""
NO_PLUGIN = 'extern "C" int something_else() { return 1; }\n'


def call(*command):
    # the folder has another name each time: a compiler cache looks at names from there
    environment = dict(os.environ, CCACHE_BASEDIR=SCRATCH, CCACHE_NOHASHDIR="1")
    done = subprocess.run(command, capture_output=True, text=True, timeout=600, env=environment)
    if done.returncode != 0:
        raise RuntimeError(" ".join(command) + "\n" + done.stdout[-2000:] + done.stderr[-4000:])


def build(source):
    call("cmake", "-S", source, "-B", source + "/build", f"-DCMAKE_PREFIX_PATH={PREFIX}",
         "-DCMAKE_CXX_COMPILER=" + os.environ.get("MUDLINE_CXX", "c++"),
         "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG", *LAUNCHER)  # -O0 compiles in less than half the time
    call("cmake", "--build", source + "/build")


def build_plugin(name, code):
    """Builds a plugin of one source in a folder of its own, and returns the folder."""
    source = os.path.join(SCRATCH, name)
    os.makedirs(source, exist_ok=True)
    with open(os.path.join(source, "CMakeLists.txt"), "w") as file:
        file.write(f"cmake_minimum_required(VERSION 3.22)\nproject({name} CXX)\nfind_package(mudline REQUIRED)\nmudline_add_plugin({name} {name}.cpp)\n")
    with open(os.path.join(source, name + ".cpp"), "w") as file:
        file.write(code)
    build(source)
    return source


def changed_plugin(name, old, new):
    """A copy of an example, built with one change of its source; returns the folder."""
    source = os.path.join(SCRATCH, name + "_changed")
    shutil.copytree(os.path.join(SCRATCH, name), source, ignore=shutil.ignore_patterns("build"))
    path = os.path.join(source, name + ".cpp")
    text = text_of(path)
    if old not in text:
        raise ValueError(f"{path} has no '{old}'")
    with open(path, "w") as file:
        file.write(text.replace(old, new))
    build(source)
    return source


def text_of(path):
    with open(path) as file:
        return file.read()


def setUpModule():
    global SCRATCH, PREFIX
    SCRATCH = tempfile.mkdtemp()
    PREFIX = os.path.join(SCRATCH, "prefix")
    call("cmake", "--install", os.environ["MUDLINE_BUILD"], "--prefix", PREFIX)
    sources = []
    for name in ("my_clay", "heat_conduction", "my_interface", "solute", "wall_profile"):
        sources.append(os.path.join(SCRATCH, name))
        shutil.copytree(os.path.join(PREFIX, "share", "mudline", "inputs", "plugins", name), sources[-1])  # as an author has it, away from mudline's tree
    with concurrent.futures.ThreadPoolExecutor(2) as pool:  # as many as the machine that runs the tests has
        list(pool.map(build, sources))
    mudline_case.PROGRAM = os.path.join(PREFIX, "bin", "mudline")  # the installed one


def tearDownModule():
    shutil.rmtree(SCRATCH)


class Plugins(MudlineCase):
    def example(self, name):
        return os.path.join(SCRATCH, name)

    def library(self, name, source):
        path = self.write(name + ".cpp", source)
        call(os.environ.get("MUDLINE_CXX", "c++"), "-shared", "-fPIC", path, "-o", os.path.join(self.folder, name + ".so"))
        return name + ".so"

    def refused(self, arguments):
        done = program(arguments, folder=self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    # a material
    def test_clay_oedometer(self):
        history = self.run_deck(self.example("my_clay/oedometer.xml"))
        p0, bulk, poisson, reference = 50e3, 2e6, 0.25, 100e3
        strain = -np.log(1 + history["probe/piston/displacement y"])
        slope = bulk / (2 * np.sqrt(reference))
        mean = (np.sqrt(p0) + slope * strain) ** 2
        stress = p0 + (1 + 4 / 3 * 1.5 * (1 - 2 * poisson) / (1 + poisson)) * (mean - p0)
        applied = 50e3 + 150e3 * history.time
        self.assertGreater(strain[-1], 0.03)
        np.testing.assert_allclose(stress[1:], applied[1:], rtol=1e-4)

    def test_clay_is_explained(self):
        library = self.example("my_clay/build/my_clay.so")
        done = program(["explain", "my clay", "--plugin", library], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Drained bulk modulus at the reference stress", done.stdout)
        self.assertIn("my clay", program(["list", "material", "--plugin", library], folder=self.folder).stdout)

    def test_clay_input_errors(self):
        deck = self.example("my_clay/oedometer.xml")
        line = text_of(deck).split('name="bulk modulus"')[0].count("\n") + 1
        self.assertEqual(self.refused(["check", deck, "--set", "materials/silt/skeleton/Poisson's ratio=0.5"]),
                         "error: --set materials/silt/skeleton/Poisson's ratio=0.5: materials/silt/skeleton/Poisson's ratio: "
                         "0.5 is out of range; allowed: [0, 0.5)\n")
        self.write("wrong.xml", text_of(deck).replace('"bulk modulus" type="double"', '"bulk modulus" type="string"')
                   .replace("build/", self.example("my_clay/build/")))
        self.assertEqual(self.refused(["check", "wrong.xml"]),
                         f"error: wrong.xml:{line}: materials/silt/skeleton/bulk modulus: expected a number (double), "
                         "given the string '2e6'\n")

    def test_law_without_k0(self):
        """A law that knows no K0 needs it from the deck."""
        lines = text_of(self.example("my_clay/oedometer.xml")).splitlines(keepends=True)
        text = "".join(line for line in lines if "effective stress" not in line)
        self.write("weight.xml", text.replace("build/", self.example("my_clay/build/")))
        error = self.refused(["check", "weight.xml", "--set", "physics/ground/initial state/type=geostatic",
                              "--set", "physics/ground/gravity={0, -10}"])
        self.assertIn("the skeleton law has no K0 of its own; give 'K0'", error)

    # a friction law
    def test_interface_weakens_with_the_path(self):
        history = self.run_deck(self.example("my_interface/pull.xml"))
        force, drag = history["contact/face/reaction y"], -history["contact/face/reaction x"]
        pulled = history.time > 1 + 1e-9
        ratio = drag[pulled] / force[pulled]
        self.assertGreater(ratio.max(), 0.45)  # of the peak coefficient 0.5
        np.testing.assert_allclose(ratio[-1], 0.2 + 0.3 * np.exp(-10), rtol=1e-3)
        self.assertIn("Path over which the strength falls", program(["explain", "weakening interface", "--plugin", self.example(
            "my_interface/build/my_interface.so")], folder=self.folder).stdout)

    def test_interface_conforms(self):
        """With its slopes; without one, or with another, it is named at the start of a run, and fails the conformance."""
        good = program(["point", "--conformance", self.example("my_interface/pull.xml")], folder=self.folder)
        self.assertEqual(good.returncode, 0, good.stdout + good.stderr)
        self.assertIn("face: friction slopes ok", good.stdout)
        source = changed_plugin("my_interface", "at.normal, coefficient}", "at.normal, 0}")
        said = "d strength / d normal is 0, differences give 0."
        bad = program(["point", "--conformance", source + "/pull.xml"], folder=self.folder)
        self.assertEqual(bad.returncode, 1, bad.stdout + bad.stderr)
        self.assertIn("face: friction slopes FAILED " + said, bad.stdout)
        doubted = program(["check", source + "/pull.xml"], folder=self.folder)
        self.assertEqual(doubted.returncode, 0, doubted.stderr)
        self.assertRegex(doubted.stderr, r"warning: \S*pull\.xml:\d+: contacts/face/friction/type: the law 'weakening interface' does not "
                                         r"conform: " + said)
        self.assertEqual(doubted.stderr.count("does not conform"), 1)
        self.assertNotIn("does not conform", program(["check", self.example("my_interface/pull.xml")], folder=self.folder).stderr)

    # at a material point
    def test_clay_in_the_laboratory(self):
        """The oedometer against its closed form, and against the finite elements."""
        deck = self.example("my_clay/laboratory.xml")
        histories = self.run_point(deck)
        self.assertEqual(list(histories), ["oedometer", "triaxial", "shear"])
        history = histories["oedometer"]
        p0, slope = 50e3, 2e6 / (2 * np.sqrt(100e3))
        mean = (np.sqrt(p0) + slope * history["axial strain"]) ** 2
        np.testing.assert_allclose(history["mean effective stress"], mean, rtol=1e-9)
        np.testing.assert_allclose(history["effective stress yy"], p0 + (1 + 4 / 3 * 0.6) * (mean - p0), rtol=1e-9)
        elements = self.run_deck(self.example("my_clay/oedometer.xml"))
        settlement = -elements.at("probe/piston/displacement y", history.time[1:])
        np.testing.assert_allclose(history["engineering axial strain"][1:], settlement, rtol=1e-3)

    def test_clay_conforms(self):
        done = program(["point", self.example("my_clay/laboratory.xml"), "--conformance"], folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(done.stdout.count(" ok "), 8, done.stdout)
        self.assertNotIn("FAILED", done.stdout)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "results")))

    def test_a_law_that_does_not_conform(self):
        """A slip in the tangent is found, named and makes the exit code 1."""
        source = changed_plugin("my_clay", "two_g : 0.5 * two_g", "two_g : two_g")
        done = program(["point", source + "/laboratory.xml", "--conformance"], folder=self.folder)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(done.stdout.count("FAILED"), 1, done.stdout)
        self.assertRegex(done.stdout, r"silt: tangent +FAILED against differences: median \d")

    def test_point_refuses_like_run(self):
        deck = text_of(self.example("my_clay/laboratory.xml"))
        for library, said in ((self.library("old", OTHER_ABI), "was built for \"interface 0; gcc 4; Trilinos 12.0; debug\""),
                              (self.library("other", NO_PLUGIN), "is no mudline plugin"), ("none.so", "does not exist")):
            self.write("deck.xml", deck.replace("build/my_clay.so", library))
            line = deck.split('name="files"')[0].count("\n") + 1
            for command in (["point"], ["point", "--conformance"], ["check"]):
                error = self.refused(command + ["deck.xml"])
                self.assertTrue(error.startswith(f"error: deck.xml:{line}: plugins/files: "), error)
                self.assertIn(said, error)
        self.write("deck.xml", deck.replace("{build/my_clay.so}", "{}"))
        self.assertIn("materials/silt/skeleton/type: unknown skeleton type 'my clay'", self.refused(["point", "deck.xml"]))

    # a physics
    def test_heat_alone(self):
        history = self.run_deck(self.example("heat_conduction/warm_bar.xml"))
        self.assertFalse([name for name in history.columns if "displacement" in name])
        self.check_series(history, 1e-6, (1e5, 2e5, 5e5, 1e6))
        error = self.refused(["check", self.example("heat_conduction/warm_bar.xml"), "--set", "output/error estimate=true"])
        self.assertIn("output/error estimate: the model has no soil whose stresses could be looked at", error)

    def test_heat_at_rest_off_zero(self):
        """What flows in equilibrium at 10 K is rounding: each step is taken at once."""
        done = program(["run", self.example("heat_conduction/warm_bar.xml"), "--set", "physics/heat/initial temperature=10"],
                       folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(" 0 rejected", done.stdout)
        history = History(os.path.join(self.folder, "results", "warm_bar.csv"))
        self.assertLessEqual(history["step/newton iterations"].max(), 1)
        self.assertLess(abs(history["probe/base/temperature"] - 10).max(), 1e-9)

    def test_heat_beside_biot(self):
        history = self.run_deck(self.example("heat_conduction/warm_ground.xml"))
        self.check_series(history, 1e-3, (100.0, 200.0, 500.0, 800.0))
        # the water knows nothing of it
        cold = self.run_deck(self.example("heat_conduction/warm_ground.xml"),
                             ["boundary conditions/warm top/value=0", "output/name=cold"], name="cold")
        same = ("probe/base/pore pressure", "probe/top/displacement y")
        for name in same:
            at = np.linspace(0, 800, 50)
            np.testing.assert_allclose(history.at(name, at), cold.at(name, at), atol=1e-4 * np.abs(cold[name]).max())
        self.assertGreater(np.abs(history[same[0]]).max(), 9)  # of the 10 Pa

    def check_series(self, history, diffusivity, times):
        for time in times:
            m = np.arange(200)
            series = 1 - np.sum(4 / np.pi * (-1.0) ** m / (2 * m + 1) * np.exp(-((2 * m + 1) * np.pi / 2) ** 2 * diffusivity * time))
            self.assertAlmostEqual(history.at("probe/base/temperature", time), 10 * series, delta=0.005 * 10 * series + 1e-3)

    def test_heat_has_no_work(self):
        """Its balance acts on no displacement: there is no column of its work, not one of zeros."""
        history = self.run_deck(self.example("heat_conduction/warm_ground.xml"), ["stages/consolidation/duration=1"])
        self.assertEqual([name for name in history.columns if name.startswith("balance/energy") and "heat" in name], [])

    # a physics on top of another, with properties by region
    def test_solute_goes_with_the_water(self):
        history = self.run_deck(self.example("solute/column.xml"))
        times = np.array([5e5, 1e6, 2e6])
        speed, diffusivity = 1e-6 / 0.8, 4e-7 / 0.8
        for name, depth in (("one metre", 1.0), ("three metres", 3.0), ("five metres", 5.0)):
            exact = heat.front(1.0, speed, diffusivity, depth, times)
            np.testing.assert_allclose(history.at(f"probe/{name}/concentration", times), exact, atol=2e-3)

    def beside_heat(self, *changes):
        """The solute's column with heat in the ground; what is in the water comes in with a concentration of 35,000."""
        text = text_of(self.example("solute/column.xml")).replace("build/", self.example("solute/build/"))
        inflow = text.index('<ParameterList name="dyed inflow">')
        text = text[:inflow] + text[inflow:].replace('value="1.0"', 'value="35000.0"', 1)
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        return text

    def test_solute_beside_heat_is_no_temperature(self):
        """At one temperature heat changes nothing: the same front as in `biot`, whatever the concentration's size."""
        medium = '<Parameter name="type" type="string" value="biot"/>'
        warm = ('<Parameter name="type" type="string" value="thermo-hydro-mechanical"/><Parameter name="reference temperature" type="double" value="10.0"/>')
        heat_section = ('<ParameterList name="solute">\n        <Parameter name="diff', '<ParameterList name="heat"><Parameter name="conductivity" type="double" value="1.5"/>'
                        '<Parameter name="grain heat capacity" type="double" value="700.0"/><Parameter name="grain expansion" type="double" value="3e-5"/></ParameterList>'
                        '<ParameterList name="solute">\n        <Parameter name="diff')
        self.write("cold.xml", self.beside_heat())
        self.write("beside.xml", self.beside_heat((medium, warm), heat_section))
        self.write("warm.xml", self.beside_heat((medium, warm + '<Parameter name="initial temperature" type="double" value="40.0"/>'
                                                 '<Parameter name="water expansion" type="double" value="0.0"/>'), heat_section))
        cold, beside, warm = (self.run_deck(name) for name in ("cold.xml", "beside.xml", "warm.xml"))
        times = np.array([5e5, 1e6, 2e6])
        thinner = 10 ** (247.8 / (10 + 133.15) - 247.8 / (40 + 133.15))  # viscosity at 10 degC over that at 40 (Vogel)
        for name, depth in (("one metre", 1.0), ("three metres", 3.0), ("five metres", 5.0)):
            column = f"probe/{name}/concentration"
            np.testing.assert_allclose(beside.at(column, times), cold.at(column, times), atol=35000 * 1e-7)
            exact = heat.front(1.0, 1e-6 / 0.8 * thinner, 4e-7 / 0.8, depth, times[:2])
            np.testing.assert_allclose(warm.at(column, times[:2]) / 35000, exact, atol=3e-3)

    def test_solute_in_layers(self):
        """Layers of one kind are as one soil. Where the lower one holds back more, the front is slower there."""
        text = text_of(self.example("solute/column.xml")).replace("build/", self.example("solute/build/"))
        start, end = text.index('<ParameterList name="sand">'), text.index('  </ParameterList>\n  <ParameterList name="plugins">')
        deep = text[start:end].replace('"sand"', '"deep"', 1).replace('name="porosity"', 'name="top" type="double" value="6.0"/>\n<Parameter name="porosity"', 1)
        self.write("one.xml", text)
        self.write("alike.xml", text[:end] + deep + text[end:])
        self.write("slower.xml", text[:end] + deep.replace('name="retardation" type="double" value="2.0"', 'name="retardation" type="double" value="4.0"') + text[end:])
        one, alike = self.run_deck("one.xml"), self.run_deck("alike.xml")
        name = "probe/five metres/concentration"
        np.testing.assert_allclose(alike[name], one[name], atol=1e-9)
        arrives = 4 / 1.25e-6 + 1 / 0.625e-6  # four metres in the upper layer, one in the lower
        stage = re.search(r'<ParameterList name="stages">\s*<ParameterList name="([^"]+)"', text).group(1)
        slower = self.run_deck("slower.xml", [f"stages/{stage}/duration={arrives}"])
        np.testing.assert_allclose(slower[name][-1], 0.5, atol=0.05)

    def test_solute_asks_for_its_properties(self):
        deck = self.example("solute/column.xml")
        self.write("without.xml", re.sub(r'<ParameterList name="solute">.*?</ParameterList>', "", text_of(deck), flags=re.S)
                   .replace("build/", self.example("solute/build/")))
        self.assertIn("materials/sand: required section 'solute' is missing", self.refused(["check", "without.xml"]))
        self.write("unused.xml", re.sub(r'<ParameterList name="dye">.*?</ParameterList>', "", text_of(deck), flags=re.S)
                   .replace("build/", self.example("solute/build/")).replace('"concentration"', '"pore pressure"').replace('"1.0"/>\n    </ParameterList>\n  </ParameterList>\n  <ParameterList name="stages">', '"1000.0"/>\n    </ParameterList>\n  </ParameterList>\n  <ParameterList name="stages">'))
        self.assertIn("materials/sand/solute: no physics of this model uses these properties", self.refused(["check", "unused.xml"]))

    # point data of a plugin's own
    def test_point_data_are_carried_by_the_mesh_motion(self):
        """The height from which a point of the soil comes, painted on it: under the pile the mesh moves against the soil, and the paint
        goes with the soil. Written to the fields, kept through a restart."""
        source = build_plugin("tag", TAG)
        self.write("tag.xml", f"""<ParameterList name="tag">
          <ParameterList name="plugins"><Parameter name="files" type="Array(string)" value="{{{source}/build/tag.so}}"/></ParameterList>
          <ParameterList name="physics"><ParameterList name="paint"><Parameter name="type" type="string" value="tag"/></ParameterList></ParameterList>
        </ParameterList>""")
        decks = [os.path.join(ROOT, "inputs", "pile", "clay.xml"), os.path.join(ROOT, "inputs", "pile", "short_pile.xml"), "tag.xml"]
        # one mesh to the end: the topology below is that of the start
        quick = ["output/field interval=0", "output/field steps=20", "mesh motion/remeshing/when side above=1000"]
        self.run_deck(decks, quick, extra=("--steps", "20"), name="short_pile")
        self.run_deck(decks, quick, extra=("--steps", "80", "--restart"), name="short_pile")
        with h5py.File(os.path.join(self.folder, "results", "short_pile.h5"), "r") as file:
            step = file["steps"][sorted(file["steps"])[-1]]
            cells = file["mesh/topology"][:].reshape(-1, 7)[:, 1:]  # of six-node triangles, after the number of their kind
            height = step["coordinates"][:][:, 1][cells].mean(axis=1)
            fallen = step["nodal"]["displacement"][:][:, 1][cells].mean(axis=1)
            tag = step["cell"]["origin"][:].reshape(-1)
        pushed = -fallen.min()
        self.assertGreater(pushed, 0.2)
        self.assertLess(np.abs(tag - (height - fallen)).max(), 0.15 * pushed)

    def test_heat_on_two_ranks(self):
        deck = self.example("heat_conduction/warm_ground.xml")
        settings = ["stages/consolidation/duration=1"]
        one = self.run_deck(deck, settings)
        two = self.run_deck(deck, settings + ["output/name=two"], ranks=2, name="two")
        self.assert_same_run(one, two, ("probe/base/temperature", "probe/base/pore pressure"), "2 ranks", rounding=1e-5)

    def test_heat_with_block_amg(self):
        """A scalar field gets a multigrid block of its own."""
        deck = self.example("heat_conduction/warm_ground.xml")
        settings = ["stages/consolidation/duration=100", "solver/linear tolerance=1e-10"]
        direct = self.run_deck(deck, settings)
        amg = self.run_deck(deck, settings + ["solver/linear solver/type=block amg"])
        self.assert_same_run(direct, amg, ("probe/base/temperature", "probe/base/pore pressure"), "block amg", rounding=1e-6)

    # an output
    def profile(self, stage, name="wall"):
        """Columns by name, without units, of the wall's profile at the end of a stage."""
        with open(os.path.join(self.folder, "results", f"{name}.wall.{stage}.csv")) as file:
            names = [column.split(" [")[0] for column in file.readline().strip().split(",")]
            return dict(zip(names, np.loadtxt(file, delimiter=",").T))

    def test_wall_profile(self):
        """At the start K0 of the effective stress and the water; later the numbers of the fields, and friction where the wall slides."""
        self.run_deck(self.example("wall_profile/wall.xml"))
        start, lift = self.profile("start"), self.profile("lift")
        z = start["depth"]
        np.testing.assert_allclose(z, np.linspace(0, 5, 21), atol=1e-4)
        water = 1e4 * z
        np.testing.assert_allclose(start["pore pressure"], water, atol=10)
        normal = 0.5 * (10e3 + 0.6 * (2700 - 1000) * 10 * z) + water
        np.testing.assert_allclose(start["normal traction"][1:-1], normal[1:-1], rtol=2e-3)  # the ends have points on one side only
        np.testing.assert_allclose(start["shear traction"], 0, atol=1)
        slides = slice(2, 8)
        effective = lift["normal traction"] - lift["pore pressure"]
        np.testing.assert_allclose(np.abs(lift["shear traction"][slides]), 0.3 * effective[slides], rtol=2e-2)
        with h5py.File(os.path.join(self.folder, "results", "wall.h5"), "r") as file:
            step = file["steps"][sorted(file["steps"])[-1]]
            places = step["coordinates"][:]
            nodes = [np.hypot(places[:, 0] - x, places[:, 1] - y).argmin() for x, y in zip(lift["x"], lift["y"])]
            for column, field in (("normal traction", "contact pressure face"), ("shear traction", "contact shear face"),
                                  ("pore pressure", "pore pressure")):
                np.testing.assert_allclose(lift[column], step["nodal"][field.replace(" ", "_")][:].reshape(-1)[nodes], rtol=1e-10, atol=1e-6)

    def test_wall_profile_on_two_ranks(self):
        deck = self.example("wall_profile/wall.xml")
        self.run_deck(deck)
        self.run_deck(deck, ["output/name=two"], ranks=2, name="two")
        one, two = self.profile("lift"), self.profile("lift", "two")
        for column in one:
            np.testing.assert_allclose(two[column], one[column], atol=1e-6 * max(1.0, np.abs(one[column]).max()))

    def test_wall_profile_is_explained_and_refused(self):
        deck, library = self.example("wall_profile/wall.xml"), self.example("wall_profile/build/wall_profile.so")
        self.assertIn("Height from which depths are counted", program(["explain", "wall profile", "--plugin", library], folder=self.folder).stdout)
        self.assertIn("wall profile", program(["list", "observer", "--plugin", library], folder=self.folder).stdout)
        self.assertIn("wall profile", program(["list", "--xsd", "--plugin", library], folder=self.folder).stdout)
        self.assertIn("output/observers/wall/contact: unknown contact 'fase' (did you mean 'face'?)",
                      self.refused(["check", deck, "--set", "output/observers/wall/contact=fase"]))
        self.assertIn("output/observers/wall/mudlin", self.refused(["check", deck, "--set", "output/observers/wall/mudlin=5"]))
        self.write("without.xml", text_of(deck).replace("{build/wall_profile.so}", "{}"))
        self.assertIn("output/observers/wall/type: unknown observer type 'wall profile'",
                      self.refused(["check", "without.xml"]))

    def test_observers_of_all_kinds(self):
        """A column and a field from an observer that keeps a sum in the state, over a restart; one that objects, and one that throws on one rank."""
        build_plugin("alarm", ALARM)
        libraries = ", ".join(os.path.join(SCRATCH, name, "build", name + ".so") for name in ("wall_profile", "alarm"))
        deck = self.example("wall_profile/wall.xml")
        settings = [f"plugins/files={{{libraries}}}", "output/observers/bell/type=alarm"]
        self.run_deck(deck, settings, extra=("--steps", "4"))
        history = self.run_deck(deck, settings, extra=("--restart",))
        np.testing.assert_array_equal(history["alarm/steps"], np.arange(1, len(history.time) + 1))  # by the array itself
        np.testing.assert_array_equal(history["alarm/half"], 0.5 * history["alarm/steps"])
        with open(os.path.join(self.folder, "results", "wall.results.csv")) as file:
            self.assertIn(f"lift,alarm,rings,{len(history.time)},-\n", file.read())
        with h5py.File(os.path.join(self.folder, "results", "wall.h5"), "r") as file:
            step = file["steps"][sorted(file["steps"])[-1]]
            np.testing.assert_array_equal(step["cell"]["alarm_id"][:].reshape(-1), np.arange(160))
        command = ["run", "-q", deck] + [word for setting in settings for word in ("--set", setting)]
        done = program(command + ["--set", "output/observers/bell/objects at=3"], folder=self.folder)
        self.assertEqual((done.returncode, done.stderr.strip()), (3, "error: observer 'bell': enough after step 3"))
        done = program(command + ["--set", "output/observers/bell/throws at=2"], ranks=2, folder=self.folder)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("error: observer 'bell': ", done.stderr)

    # what is no plugin, or somebody else's
    def with_plugin(self, file):
        deck = text_of(self.example("my_clay/oedometer.xml")).replace("build/my_clay.so", file)
        self.write("deck.xml", deck)
        line = deck.split('name="files"')[0].count("\n") + 1
        return self.refused(["check", "deck.xml"]), f"error: deck.xml:{line}: plugins/files: "

    def test_other_abi(self):
        said, begin = self.with_plugin(self.library("old", OTHER_ABI))
        self.assertTrue(said.startswith(begin + "plugin 'old.so' was built for \"interface 0; gcc 4; Trilinos 12.0; debug\", "
                                        "this program is \"interface "), said)
        self.assertTrue(said.endswith("; rebuild the plugin\n"), said)

    def test_no_plugin(self):
        said, begin = self.with_plugin(self.library("other", NO_PLUGIN))
        self.assertEqual(said, begin + "'other.so' is no mudline plugin: it does not contain MUDLINE_PLUGIN\n")

    def test_plugin_twice(self):
        library = self.example("my_clay/build/my_clay.so")
        said, begin = self.with_plugin(library + ", " + library)
        self.assertEqual(said, begin + f"plugin '{library}' cannot register: the skeleton type 'my clay' is registered twice\n")

    def test_forgotten_plugin(self):
        deck = text_of(self.example("my_clay/oedometer.xml"))
        self.write("deck.xml", deck.replace("{build/my_clay.so}", "{}"))
        self.assertIn("materials/silt/skeleton/type: unknown skeleton type 'my clay'", self.refused(["check", "deck.xml"]))


if __name__ == "__main__":
    unittest.main()
