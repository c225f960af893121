"""On a processor that OpenBLAS does not know the program starts itself with kernels that suit the processor."""
import os
import re
import subprocess
import unittest

from mudline_case import PROGRAM, MudlineCase

FLAGS = set(re.search(r"^flags\s*:(.*)$", open("/proc/cpuinfo").read() + "\nflags:", re.M).group(1).split())
AVX2 = {"avx2", "fma"} <= FLAGS


class BlasKernels(MudlineCase):
    def version(self, **environment):
        start = dict(os.environ, LD_PRELOAD=os.environ["OLD_OPENBLAS"])
        start.pop("OPENBLAS_CORETYPE", None)
        done = subprocess.run([PROGRAM, "version"], env=dict(start, **environment), capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.splitlines()[-1]

    def test_old_kernels_are_replaced(self):
        wanted = "Haswell (in place of Prescott, which OpenBLAS picks here)" if AVX2 else "Prescott"
        self.assertEqual(self.version(), "blas:    OpenBLAS, kernels " + wanted)

    def test_the_user_decides(self):
        for name in ("Prescott", "Nehalem"):
            self.assertEqual(self.version(OPENBLAS_CORETYPE=name), "blas:    OpenBLAS, kernels " + name)


if __name__ == "__main__":
    unittest.main()
