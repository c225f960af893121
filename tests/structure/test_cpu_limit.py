"""The limits that every test runs under: tests/support/cpu_limit.py."""
import os
import subprocess
import sys
import time
import unittest

import cpu_limit

SPIN = "import time\nend = time.process_time() + {}\nwhile time.process_time() < end: pass"


def python(text):
    return [sys.executable, "-c", text]


class CpuLimit(unittest.TestCase):
    def limited(self, seconds, command):
        return subprocess.run([sys.executable, cpu_limit.__file__, str(seconds)] + command, capture_output=True, text=True)

    def test_the_exit_code_is_the_commands(self):
        self.assertEqual(self.limited(10, python("raise SystemExit(3)")).returncode, 3)
        self.assertEqual(self.limited(10, python("import os; os.kill(os.getpid(), 11)")).returncode, 139)

    def test_waiting_costs_nothing(self):
        start = time.monotonic()
        self.assertEqual(self.limited(1, python("import time; time.sleep(2)")).returncode, 0)
        self.assertGreater(time.monotonic() - start, 2)

    def test_what_it_starts_counts(self):
        # three processes of 0.6 s each: one that is waited for, one beside it, one whose parent has gone
        child = python(SPIN.format(0.6))
        text = f"import subprocess\nsubprocess.run({child})\nsubprocess.Popen({child})\nsubprocess.run({child})\n"
        orphan = python(f"import subprocess\nsubprocess.Popen({python(text)})\nimport time; time.sleep(8)")
        self.assertEqual(self.limited(1, orphan).returncode, cpu_limit.TIMED_OUT)

    def test_all_of_it_is_killed(self):
        start = time.monotonic()
        with self.assertRaises(subprocess.TimeoutExpired):
            cpu_limit.run(python(f"import subprocess\nsubprocess.run({python(SPIN.format(60))})"), 0.5)
        self.assertLess(time.monotonic() - start, 30)
        self.assertEqual(list(cpu_limit.family(os.getpid())), [os.getpid()])


if __name__ == "__main__":
    unittest.main()
