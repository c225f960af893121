"""Plugins and UMATs with something wrong: one library of each kind, built here, with the fault chosen at run time."""

import json
import os
import pathlib
import random
import re
import shlex
import subprocess
import sys

import fault

TITLE = "plugins and UMATs that throw, exit, crash, or return what is no number"
SAMPLE = 12

HERE = pathlib.Path(__file__).parent

# what PLUGIN_FAULT names, and what must be said of it
AT = r"deck\.xml:\d+: "
CRASHED = r"the library 'faulty_plugin\.so' crashed \("
ENDED = r"the library 'faulty_plugin\.so' ended the program"
DID = r"the library 'faulty_plugin\.so' has "
LAW = r"the law of material 'soil' fails at \(.*\): "
INCREMENT = r".*effective stress xx yy zz yz xz xy = .* strain increment "
PLUGIN = {
    "loading throws a number": "",
    "loading exits": ENDED,
    "loading writes nowhere": CRASHED + ".*SIGSEGV",
    "signature is null": AT + r"plugins/files: .*cannot tell what it was built for",
    "signature throws a number": AT + r"plugins/files: .*cannot tell what it was built for",
    "signature is another": AT + "plugins/files: .*was built for \"interface 0\"",
    "registration throws a text": AT + r"plugins/files: .*cannot register: something that is no std::exception",
    "registration of one name twice": AT + r"plugins/files: .*registered twice",
    "constructor throws a number": AT + r"materials/soil/skeleton/type: .*cannot be made: something that is no std::exception",
    "constructor throws lines": AT + r"materials/soil/skeleton/type: .*: last line$",
    "constructor throws on the second rank": AT + r"materials/soil/skeleton/type: .*: only here$",
    "parameters throws a text": AT + r"materials/soil/skeleton/type: ",
    "parameters declares a name twice": AT + r"materials/soil/skeleton/type: .*bulk modulus",
    "check throws a number": AT + r"materials/soil/skeleton/type: ",
    "check exits": ENDED,
    "state of three components": AT + r"materials/soil/skeleton/type: the state variable 'first' of the law has 3 components",
    "state of one name": AT + r"materials/soil/skeleton/type: two state variables",
    "initialise throws a number": AT + r".*material 'soil' cannot start at .*its law throws: something",
    "initialise gives NaN": AT + r".*material 'soil' cannot start at .*not finite",
    "initialise refuses": AT + r".*material 'soil' cannot start at .*no such soil",
    "moduli are NaN": AT + r".*material 'soil' cannot start at .*bulk modulus of nan Pa",
    "moduli are zero": AT + r".*material 'soil' cannot start at .*bulk modulus of 0 Pa",
    "moduli are negative": AT + r".*material 'soil' cannot start at .*bulk modulus of -2e\+06 Pa",
    "K0 is NaN": AT + r".*the K0 of its law is not finite",
    "update gives a NaN stress": LAW + "it returns a stress that is not finite" + INCREMENT,
    "update gives a NaN state": LAW + "it returns a state that is not finite" + INCREMENT,
    "update gives a NaN tangent": LAW + "it returns a tangent that is not finite" + INCREMENT,
    "update refuses": LAW + "it refuses the increment" + INCREMENT,
    "update throws a number": LAW + "it throws: something" + INCREMENT,
    "update throws on the second rank": LAW + "it throws: only here" + INCREMENT,
    "update exits on the second rank": ENDED,
    "update writes nowhere on the second rank": CRASHED + ".*SIGSEGV",
    "update divides by zero": CRASHED + ".*SIGFPE",
    "update aborts": CRASHED + ".*SIGABRT",
    "update recurses without end": CRASHED + ".*SIGSEGV",
    "loading calls _exit": ENDED + r" \(a call of _exit\)",
    "registration calls quick_exit": ENDED + r" \(a call of quick_exit\)",
    "constructor aborts MPI with 0": ENDED + r" \(a call of MPI_Abort\)",
    "update calls _exit": ENDED + r" \(a call of _exit\)",
    "update calls _Exit": ENDED + r" \(a call of _exit\)",
    "update calls quick_exit": ENDED + r" \(a call of quick_exit\)",
    "update aborts MPI with 0": ENDED + r" \(a call of MPI_Abort\)",
    "residual calls _exit": ENDED + r" \(a call of _exit\)",
    "loading changes the folder": DID + "changed the working folder",
    "constructor changes the folder": DID + "changed the working folder",
    "update changes the folder": DID + "changed the working folder",
    "constructor rounds upward": DID + "changed the rounding mode",
    "update rounds upward": DID + "changed the rounding mode",
    "update closes standard output": DID + "closed the standard output",
    "loading closes all files": DID + "closed a file of the program",
    "registration closes all files": DID + "closed a file of the program",
    "update closes all files": DID + "closed a file of the program",
    "residual closes all files": DID + "closed a file of the program",
    "fluid of NaN density": AT + r"materials/soil/fluid/type: the fluid's density is nan",
    "conductivity is negative": AT + r"materials/soil/permeability/type: .*-0\.001",
    "bind throws a text": AT + r"boundary conditions/top/type: ",
    "prescribe gives NaN": "'top'",
    "residual throws a number": "1 point failed in faulty term, which throws: something that is no std::exception",
    "residual gives NaN": "1 point failed in faulty term, which gives a force or flux that is not finite",
    "jacobian throws a text": "the Jacobian of faulty term: something that is no std::exception",
    "destructor throws a number": r"the library 'faulty_plugin\.so' ended by an exception",
}
UMAT_CRASHED = r"the library 'faulty_umat\.so' crashed \("
UMAT_ENDED = r"the library 'faulty_umat\.so' ended the program"
UMAT = {
    1: ("STOP", UMAT_ENDED),
    2: ("STOP with a text", UMAT_ENDED),
    3: ("ERROR STOP", UMAT_ENDED),
    4: ("CALL EXIT(0)", UMAT_ENDED),
    5: ("CALL ABORT", UMAT_CRASHED + ".*SIGABRT"),
    6: ("an integer division by zero", UMAT_CRASHED + ".*SIGFPE"),
    7: ("a pointer to nowhere", UMAT_CRASHED + ".*SIGSEGV"),
    8: ("a NaN stress", LAW + "it returns a stress that is not finite" + INCREMENT),
    9: ("a NaN state", LAW + "it returns a state that is not finite" + INCREMENT),
    10: ("a NaN tangent", LAW + "it returns a tangent that is not finite" + INCREMENT),
    11: ("PNEWDT", LAW + "it refuses the increment" + INCREMENT),
    12: ("a recursion without end", UMAT_CRASHED + ".*SIGSEGV"),
    13: ("a file that is not there", UMAT_ENDED),
    14: ("STATEV past its end", r"in the library 'faulty_umat\.so' writes past the end of STATEV"),
    15: ("STRESS before its begin", r"in the library 'faulty_umat\.so' writes before the begin of STRESS"),
    16: ("PREDEF, which is no number", LAW + "it returns a stress that is not finite" + INCREMENT),
}
FULL = len(PLUGIN) + len(UMAT)
# In every sample, on two ranks: they would wait without end for each other.
ALWAYS = [("plugin", name) for name in PLUGIN if name.endswith("closes all files")]

DECK = """<ParameterList name="deck">
  <ParameterList name="mesh"><Parameter name="type" type="string" value="box"/><Parameter name="cell" type="string" value="quad9"/>
    <Parameter name="cells" type="Array(int)" value="{2, 2}"/><Parameter name="upper" type="Array(double)" value="{1.0, 1.0}"/></ParameterList>
PLUGINS
  <ParameterList name="materials"><ParameterList name="soil"><Parameter name="void ratio" type="double" value="0.8"/>
    <ParameterList name="skeleton">
SKELETON
    </ParameterList>
    <ParameterList name="fluid">
      <Parameter name="type" type="string" value="FLUID"/>
    </ParameterList>
    <ParameterList name="permeability">
      PERMEABILITY
    </ParameterList></ParameterList></ParameterList>
  <ParameterList name="physics"><ParameterList name="ground"><Parameter name="type" type="string" value="biot"/>
    <Parameter name="gravity" type="Array(double)" value="{0.0, -10.0}"/>
    <ParameterList name="initial state"><Parameter name="type" type="string" value="geostatic"/>
      <Parameter name="surcharge" type="double" value="1e4"/>K0</ParameterList></ParameterList></ParameterList>
  <ParameterList name="boundary conditions">
    <ParameterList name="base"><Parameter name="type" type="string" value="fixed"/><Parameter name="set" type="string" value="bottom"/></ParameterList>
    <ParameterList name="top">
      <Parameter name="type" type="string" value="CONDITION"/>
      <Parameter name="set" type="string" value="top"/><Parameter name="y" type="string" value="-0.01*t"/></ParameterList>
    <ParameterList name="drained"><Parameter name="type" type="string" value="pore pressure"/><Parameter name="set" type="string" value="top"/>
      <Parameter name="value" type="string" value="0"/></ParameterList>
  </ParameterList>
  <ParameterList name="stages"><ParameterList name="load"><Parameter name="type" type="string" value="quasi-static"/>
    <Parameter name="duration" type="double" value="1.0"/>
    <ParameterList name="time step"><Parameter name="initial" type="double" value="0.25"/>
      <Parameter name="minimum" type="double" value="0.2"/></ParameterList></ParameterList></ParameterList>
</ParameterList>
"""


def deck(**entries):
    text = DECK
    for name, value in entries.items():
        text = text.replace(name, value)
    return text


def plugin_deck():
    return deck(
        PLUGINS='<ParameterList name="plugins"><Parameter name="files" type="Array(string)" value="{faulty_plugin.so}"/></ParameterList>',
        SKELETON='<Parameter name="type" type="string" value="faulty"/><Parameter name="bulk modulus" type="double" value="2e6"/>',
        FLUID="faulty", PERMEABILITY='<Parameter name="type" type="string" value="faulty"/>', CONDITION="faulty", K0="")


def umat_deck(number):
    return deck(
        PLUGINS="",
        SKELETON=f"""<Parameter name="type" type="string" value="umat"/><Parameter name="library" type="string" value="faulty_umat.so"/>
      <Parameter name="properties" type="Array(double)" value="{{{number}.0}}"/><Parameter name="state variables" type="int" value="1"/>
      <Parameter name="bulk modulus" type="double" value="1.33e6"/><Parameter name="shear modulus" type="double" value="1e6"/>""",
        FLUID="water", CONDITION="displacement",
        PERMEABILITY='<Parameter name="type" type="string" value="constant"/><Parameter name="hydraulic conductivity" type="double" value="1e-3"/>',
        K0='<Parameter name="K0" type="string" value="0.5"/>')


def build_tree():
    """Where the program was built; None where it lies elsewhere."""
    parents = pathlib.Path(fault.program()).resolve().parents
    return next((p for p in parents if (p / "compile_commands.json").exists()), None)


def check():
    if build_tree() is None:
        sys.exit(f"{fault.program()}: plugins are built as the program was; name one in its build tree by MUDLINE")


def build(folder):
    """Both libraries. The plugin takes the compiler and the options of the program's own sources, from its build folder."""
    tree = build_tree()
    commands = json.loads((tree / "compile_commands.json").read_text())
    own = next(c for c in commands if "mudline_simulation.dir" in c["command"])
    words = shlex.split(own["command"])
    words = words[: words.index("-o")] + ["-w", "-fPIC", "-c", str(HERE / "faulty_plugin.cpp"), "-o", str(folder / "faulty_plugin.o")]
    subprocess.run(words, cwd=own["directory"], check=True)
    subprocess.run(["g++", "-shared", folder / "faulty_plugin.o", "-o", folder / "faulty_plugin.so"], check=True)
    subprocess.run(["gfortran", "-O1", "-shared", "-fPIC", HERE / "faulty_umat.f90", "-o", folder / "faulty_umat.so"], check=True)


def without_own_words(ended):
    """Less what Fortran's run-time library prints of a STOP or an error before it calls exit."""
    of_fortran = r"(ERROR )?STOP\b.*|Note: The following floating-point.*|At line \d+ of file.*|Fortran runtime error:.*|\s*"
    ended.stderr = "".join(line + "\n" for line in ended.stderr.splitlines() if not re.fullmatch(of_fortran, line))
    return ended


def judged(name, ended, expected):
    outcome = fault.judge(name, without_own_words(ended))
    if outcome.verdict == "said" and not re.search(expected, outcome.said):
        return fault.Outcome(name, "several lines", f"says '{outcome.said}', not '{expected}'")
    return outcome


def run(count, seed, folder):
    build(folder)
    for text in (plugin_deck(), umat_deck(0)):  # sound without a fault
        (folder / "deck.xml").write_text(text, encoding="utf-8")
        sound = fault.start(["run", "-q", "deck.xml"], folder)
        assert sound.code == 0, sound.stderr
    faults = [("plugin", name) for name in PLUGIN] + [("umat", number) for number in UMAT]
    others = [one for one in faults if one not in ALWAYS]
    for kind, which in ALWAYS + random.Random(seed).sample(others, count - len(ALWAYS)):
        environment = dict(os.environ)
        environment.pop("PLUGIN_FAULT", None)
        if kind == "plugin":
            environment["PLUGIN_FAULT"] = which
            text, name, expected = plugin_deck(), f"plugin: {which}", PLUGIN[which]
        else:
            text, name, expected = umat_deck(which), f"UMAT: {UMAT[which][0]}", UMAT[which][1]
        (folder / "deck.xml").write_text(text, encoding="utf-8")
        ranks = 2 if "second rank" in name or "all files" in name else 1
        yield judged(name, fault.start(["run", "-q", "deck.xml"], folder, ranks, limit=30, env=environment), expected)
