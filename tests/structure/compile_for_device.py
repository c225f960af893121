#!/usr/bin/env python3
"""Compiles kernels for a CUDA device with nvcc and reports every host function that device code would call.

    python3 tests/structure/compile_for_device.py [SOURCE ...] [--arch sm_80]

Needs nvcc and a configured build/release. Nothing is run and no device is needed: Trilinos' own headers are used, with
the CUDA backend switched on in a copy of Kokkos' configuration. The sources are by default all that have kernels of
element, side and point loops. Exit code 1 if one does not compile or warns.
"""
import argparse
import json
import pathlib
import re
import resource
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = """
packages/physics/solid/weight.cpp
packages/physics/solid/inertia.cpp
packages/physics/solid/rayleigh_damping.cpp
packages/physics/solid/stress_divergence.cpp
packages/physics/solid/stress_update.cpp
packages/physics/biot/fluid_mass.cpp
packages/physics/biot/drying_water.cpp
packages/physics/biot/pressure_projection.cpp
packages/physics/thm/thermo_hydro_mechanical.cpp
packages/physics/conditions/side_terms.cpp
packages/physics/conditions/absorbing.cpp
packages/physics/conditions/prescribed.cpp
packages/materials/register_materials.cpp
packages/materials/skeleton/drucker_prager.cpp
packages/materials/skeleton/modified_cam_clay.cpp
packages/materials/skeleton/mohr_coulomb.cpp
packages/materials/skeleton/neo_hookean.cpp
packages/materials/skeleton/tresca.cpp
packages/materials/skeleton/von_mises.cpp
packages/integrator/levels.cpp
packages/integrator/stepper.cpp
packages/integrator/stepper_start.cpp
packages/integrator/time_error.cpp
packages/algebra/absolute_product.cpp
packages/contact/body/penalty_contact.cpp
packages/contact/parts/leaky_surface.cpp
inputs/plugins/heat_conduction/heat_conduction.cpp
inputs/plugins/my_clay/my_clay.cpp
inputs/plugins/solute/solute.cpp
""".split()


def kokkos_configuration(folder, includes):
    """Writes Kokkos' configuration with CUDA as the default execution space into a folder."""
    for include in includes:
        config = pathlib.Path(include) / "KokkosCore_config.h"
        if config.exists():
            break
    else:
        sys.exit("KokkosCore_config.h is in none of the include folders of build/release/compile_commands.json")
    text = config.read_text()
    for name in ("CUDA", "CUDA_LAMBDA"):
        text, count = re.subn(rf"/\* #undef KOKKOS_ENABLE_{name} \*/", f"#define KOKKOS_ENABLE_{name}", text)
        if count != 1:
            sys.exit(f"{config} has no line for KOKKOS_ENABLE_{name}")
    (folder / "KokkosCore_config.h").write_text(text)
    for kind, header in (("SetupBackend", "setup/Kokkos_Setup_Cuda.hpp"), ("FwdBackend", "fwd/Kokkos_Fwd_CUDA.hpp"),
                         ("DeclareBackend", "decl/Kokkos_Declare_CUDA.hpp")):
        name = f"KokkosCore_Config_{kind}.hpp"
        text = (config.parent / name).read_text()
        (folder / name).write_text(text.replace("#endif", f"#include <{header}>\n#endif"))


def compile_for_device(source, folder, options, arch):
    """Compiles one source up to the code of nvcc's intermediate machine, without optimisation: the calls are found
    there. Returns the source, CPU seconds, and the lines of errors and of warnings outside Trilinos' headers."""
    # Kokkos' half precision is left out: it calls functions that nvcc 13 has no more.
    command = ["nvcc", "-x", "cu", "-c", str(ROOT / source), "-o", "/dev/null", f"-arch={arch}", "-std=c++17",
               "-Xcicc", "-O0", "--expt-extended-lambda", "--expt-relaxed-constexpr", "-DKOKKOS_CUDA_HALF_HPP_",
               "-I", str(folder), "-I", str(ROOT / "packages"), *options]
    steps = subprocess.run([*command, "--dryrun", "--keep-dir", str(folder)], capture_output=True, text=True).stderr
    steps = [line[3:] for line in steps.splitlines() if line.startswith("#$ ")]
    last = next(k for k, step in enumerate(steps) if step.startswith('"$CICC_PATH/cicc"'))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run(["bash", "-ec", "\n".join(quoted(step) for step in steps[: last + 1])],
                            capture_output=True, text=True, cwd=folder)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    lines = [line for line in result.stderr.splitlines()
             if re.search(r"\berror\b|__host__|host function", line) and "/trilinos/" not in line.split("(")[0]]
    if result.returncode != 0 and not lines:
        lines = result.stderr.splitlines()[-5:]
    return source, after.ru_utime - before.ru_utime, lines


def quoted(step):
    """A step of nvcc's dry run as a line of the shell: values of assignments are quoted."""
    name = re.match(r"([A-Za-z_]+)=(.*)", step)
    return f"export {name[1]}={shlex.quote(name[2].replace(chr(34), ''))}" if name else step


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sources", nargs="*", default=SOURCES)
    parser.add_argument("--arch", default="sm_80")
    args = parser.parse_args()
    commands = ROOT / "build/release/compile_commands.json"
    if not commands.exists():
        sys.exit("build/release is not configured; run ./mudline version first")
    words = next(shlex.split(c["command"]) for c in json.loads(commands.read_text())
                 if c["file"].endswith("biot/fluid_mass.cpp"))
    options, includes = [], []
    for k, word in enumerate(words):
        if word.startswith(("-I", "-D")):
            options.append(word)
        if word == "-isystem":
            options += ["-I", words[k + 1]]
            includes.append(words[k + 1])
    wrong = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        kokkos_configuration(folder, includes)
        for source in args.sources:
            source, seconds, lines = compile_for_device(source, folder, options, args.arch)
            print(f"{source}: {seconds:.0f} s CPU, " + (f"{len(lines)} errors and warnings" if lines else "clean"),
                  flush=True)
            for line in lines[:6]:
                print("   ", line)
            wrong += bool(lines)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
