"""Prints the numbers of docs/tutorials/calibration.md: laboratory points in, parameters out.

An argument is the program."""

import math

import numpy as np

import laboratory
import sand
from laboratory import STRAIN, STRESS, at

PRESSURE, VOID, GAIN = "mean effective stress [kPa]", "void ratio [-]", "gain per decade [-]"
NORMAL = ("A7", "A8", "F2")  # consolidated normally
TESTS = ("A7", "A7 slow", "D3", "D3 slow", "A7 extension")
SKELETON = "materials/kaolin/skeleton/"
COLUMNS = {STRAIN: ("axial strain", 100), STRESS: ("deviatoric stress", 1e-3)}
PEAK_EXPONENTS, STIFFNESS_EXPONENTS = (0.1, 0.15, 0.2, 0.25, 0.3), (1.0, 1.22, 1.5, 2.0)


def common_slope(samples):
    """Least squares slope of void ratio over ln p of several samples, each with an intercept of its own."""
    x = np.concatenate([np.log(p) - np.log(p).mean() for p, _ in samples])
    y = np.concatenate([e - e.mean() for _, e in samples])
    return -(x @ y) / (x @ x)


def compression_slope(points):
    """That of loading above 150 kPa."""
    samples = []
    for test in points.values():
        p, e = test[PRESSURE], test[VOID]
        loading = slice(0, p.argmax() + 1)
        above = p[loading] > 150
        samples.append((p[loading][above], e[loading][above]))
    return common_slope(samples)


def swelling_slope(points):
    """That of unloading, without the first step, in which the soil hardly swells."""
    samples = []
    for test in points.values():
        p, e = test[PRESSURE], test[VOID]
        first = p.argmax() + 1
        if len(p) - first > 1:
            samples.append((p[first:], e[first:]))
    return common_slope(samples)


def creep_slope(points, compression):
    """At the critical state a decade of the rate multiplies the strength by 10^(mu/lambda)."""
    return compression * math.log10(1 + np.mean([points[test][GAIN][0] for test in NORMAL]))


def kaolin(program, changes=()):
    """Curves of the tests at two rates."""
    return laboratory.computed(program, "kaolin_rate.xml", TESTS, COLUMNS,
                               [f"{SKELETON}{name}={value}" for name, value in changes])


def gain(curves, test):
    """Share of stress at the end of the test that a tenfold rate adds."""
    return curves[test][STRESS][-1] / curves[test + " slow"][STRESS][-1] - 1


def root_mean_square(parts):
    return math.sqrt(np.mean(np.concatenate(parts) ** 2))


def sand_misses(program, exponents):
    """Misses in three drained triaxial tests with exponents (peak, stiffness), as roots of mean squares: that of the
    stress as a share, and that of the volume strain [%]."""
    names = ("peak exponent", "stiffness exponent")
    changes = [f"materials/sand/skeleton/{name}={value}" for name, value in zip(names, exponents)]
    tests = laboratory.measured("sand.csv")
    curves = laboratory.computed(program, "sand.xml", sand.TRIAXIAL, sand.COLUMNS, changes)
    pairs = [(curves[test], tests[test]) for test in sand.TRIAXIAL]
    return (root_mean_square([at(*pair, STRAIN, STRESS) / pair[1][STRESS] - 1 for pair in pairs]),
            root_mean_square([at(*pair, STRAIN, sand.VOLUME) - pair[1][sand.VOLUME] for pair in pairs]))


def main():
    program, points = laboratory.program(), laboratory.measured("kaolin_compression.csv")
    compression = compression_slope(points)
    print(f"compression slope {compression:.4f}, swelling slope {swelling_slope(points):.4f}, "
          f"creep slope {creep_slope(points, compression):.5f}")
    for slope in (0.00125, 0.0025, 0.005):
        curves = kaolin(program, (("creep slope", slope),))
        print(f"| {slope} | {curves['A7'][STRESS][-1]:.0f} | {100 * gain(curves, 'A7'):.2f} | "
              f"{100 * gain(curves, 'D3'):.2f} | {curves['D3'][STRESS].max():.0f} |")
    print("stiffness exponent over peak exponent:", PEAK_EXPONENTS)
    for stiffness in STIFFNESS_EXPONENTS:
        row = [sand_misses(program, (peak, stiffness)) for peak in PEAK_EXPONENTS]
        print(f"| {stiffness} | " + " | ".join(f"{100 * stress:.1f}, {volume:.2f}" for stress, volume in row) + " |")


if __name__ == "__main__":
    main()
